// Functions of machines, states, friction and two-folds.
#include <string.h>

#include "verify/cost/calls.h"
#include "verify/cost/count.h"
#include "verify/cost/inline.h"

#define GENE(n) (s->genes->gene[OWN_GENES + (n)])
#define REAL(n) real_of(GENE(n))
#define K (&s->machine.machine)

#define CALL(function) static uint32_t count_##function(const subject_t *s)

CALL(tyre_is_set_valued) {
  return COUNT(cost_tyre_is_set_valued((tf_tyre_law_t)(GENE(0) % 6)));
}
CALL(tyre_force) {
  const tf_real_t h = REAL(0), g = REAL(1);
  return COUNT(tf_tyre_force(&K->tyre, GENE(2) & 1u ? 1 : -1, h, g));
}

CALL(philox) {
  uint32_t out[2];
  return COUNT(tf_philox(GENE(0), GENE(1), out));
}
CALL(prepare) {
  tf_machine_t machine;
  int offender;
  return COUNT(tf_prepare(&machine, &s->params, &offender));
}
CALL(prepare_compensated) {
  tf_compensated_t machine;
  int offender;
  return COUNT(tf_prepare_compensated(&machine, &s->params, &offender));
}
CALL(input_default) { return COUNT(tf_input_default(K)); }
CALL(slip) {
  return COUNT(tf_slip(K, s->state.r, s->state.v, s->state.w, s->input.omega0));
}
CALL(speed_for_slip) {
  tf_real_t v;
  const tf_real_t h = REAL(0);
  return COUNT(
      tf_speed_for_slip(K, s->state.r, s->state.w, s->input.omega0, h, &v));
}
CALL(energy) { return COUNT(tf_energy(K, &s->state, s->input.r0)); }
CALL(speed_for_slip_compensated) {
  tf_state_t state = s->state;
  tf_compensation_t compensation = s->compensation;
  const tf_real_t h = REAL(0);
  return COUNT(tf_speed_for_slip_compensated(&s->machine, &state, &compensation,
                                             s->input.omega0, h));
}
CALL(begin) {
  tf_state_t state = s->state;
  tf_report_t report;
  state.mode = (uint8_t)(GENE(0) % (TF_MODES + 1));
  return COUNT(tf_begin(K, &state, &s->input, &report));
}
CALL(begin_with_slip) {
  tf_state_t state = s->state;
  tf_report_t report;
  const tf_real_t h = REAL(0);
  return COUNT(tf_begin_with_slip(K, &state, &s->input, h, &report));
}
CALL(step) {
  tf_state_t state = s->state;
  tf_report_t report;
  return COUNT(tf_step(K, &state, &s->input, &report));
}
// The units are the budget.
#define MAX_SEGMENTS 8
CALL(step_located) {
  tf_machine_t machine = *K;
  tf_state_t state = s->state;
  tf_report_t report;
  machine.segments = (uint16_t)s->units;
  return COUNT(tf_step_located(&machine, &state, &s->input, &report));
}
CALL(step_compensated) {
  tf_state_t state = s->state;
  tf_compensation_t compensation = s->compensation;
  tf_report_t report;
  return COUNT(tf_step_compensated(&s->machine, &state, &compensation,
                                   &s->input, &report));
}

// As many equal states as there are units.
#define MAX_STATES (4 * TF_LANES)
CALL(ensemble_step) {
  static tf_state_block_t blocks[TF_BLOCKS(MAX_STATES)];
  static tf_report_block_t reports[TF_BLOCKS(MAX_STATES)];
  for (unsigned i = 0; i < s->units; i++) tf_ensemble_put(blocks, i, &s->state);
  return COUNT(tf_ensemble_step(K, blocks, s->units, &s->input, reports));
}
CALL(ensemble_put) {
  tf_state_block_t blocks[2];
  return COUNT(tf_ensemble_put(blocks, TF_LANES + 3, &s->state));
}
CALL(ensemble_get) {
  tf_state_block_t blocks[1];
  tf_ensemble_put(blocks, 3, &s->state);
  return COUNT(tf_ensemble_get(blocks, 3));
}
CALL(ensemble_report) {
  tf_report_block_t reports[1];
  memset(reports, (int)(GENE(0) & 127u), sizeof reports);
  return COUNT(tf_ensemble_report(reports, 3));
}

// A scene of these parameters, with a profile.
static tf_scene_t scene_of(const subject_t *s) {
  tf_scene_t scene = *tf_scenes[0];
  scene.params = s->params;
  scene.r = s->state.r;
  scene.omega = s->state.w;
  scene.v = s->state.v;
  scene.h = sized_of(GENE(0), -40, 4);
  scene.v_is_given = (GENE(1) & 1u) != 0;
  scene.knots = (uint8_t)(GENE(1) >> 4 & 8u);
  for (unsigned i = 0; i < TF_SCENE_KNOTS; i++)
    scene.profile[i] =
        (tf_knot_t){(tf_real_t)i / 8, s->params.omega0 * (tf_real_t)(i % 3)};
  return scene;
}

CALL(scene_input) {
  const tf_scene_t scene = scene_of(s);
  const tf_real_t t = sized_of(GENE(2), -4, 1);
  return COUNT(tf_scene_input(&scene, K, t));
}
CALL(scene_start) {
  const tf_scene_t scene = scene_of(s);
  tf_state_t state;
  tf_report_t report;
  return COUNT(tf_scene_start(&scene, K, GENE(2), &state, &report));
}
CALL(tally_count) {
  tf_tally_t tally;
  memset(&tally, 0, sizeof tally);
  tally.refused = GENE(2) & 1u;
  const int status = TF_STEP_TOO_LONG + (int)(GENE(3) % 8);
  return COUNT(tf_tally_count(&tally, GENE(4), (tf_status_t)status));
}
CALL(simulation_input) {
  const tf_scene_t scene = scene_of(s);
  tf_simulation_t simulation;
  memset(&simulation, 0, sizeof simulation);
  simulation.machine = *K;
  simulation.state = s->state;
  simulation.state.tick = GENE(2) >> (GENE(3) % 32);
  simulation.source = (tf_input_source_t)(GENE(3) >> 5 & 1u);
  simulation.deadman = simulation.left = GENE(3) >> 6 & 1u;
  return COUNT(tf_simulation_input(&simulation, &scene));
}
CALL(simulation_set_input) {
  tf_simulation_t simulation;
  memset(&simulation, 0, sizeof simulation);
  return COUNT(tf_simulation_set_input(&simulation, &s->input));
}
CALL(simulation_start) {
  const tf_scene_t scene = scene_of(s);
  tf_simulation_t simulation;
  memset(&simulation, 0, sizeof simulation);
  simulation.machine = *K;
  return COUNT(tf_simulation_start(&simulation, &scene, GENE(2)));
}
CALL(simulation_open) {
  const tf_scene_t scene = scene_of(s);
  tf_simulation_t simulation;
  memset(&simulation, 0, sizeof simulation);
  return COUNT(tf_simulation_open(&simulation, &scene, &s->params, GENE(2)));
}

CALL(two_folds) {
  tf_surface_point_t places[TF_TWO_FOLDS];
  tf_absence_t absence;
  int count;
  return COUNT(tf_two_folds(K, &s->input, places, &count, &absence));
}
CALL(normal_form) {
  tf_surface_point_t places[TF_TWO_FOLDS];
  tf_two_fold_t out;
  int count = 0;
  if (tf_two_folds(K, &s->input, places, &count, NULL) != TF_OK || count == 0)
    return 0;
  return COUNT(
      tf_normal_form(K, &s->input, &places[GENE(0) % (unsigned)count], &out));
}
CALL(design_two_fold) {
  tf_design_t out;
  return COUNT(tf_design_two_fold(K, &s->input, s->state.r, s->state.w, &out));
}
CALL(surface_at) {
  tf_surface_t out;
  return COUNT(
      tf_surface_at(K, &s->input, s->state.r, s->state.v, s->state.w, &out));
}

#define WEIGHED(function, weight) \
  { #function, count_##function, NULL, 0, weight }
#define ENTRY(function) WEIGHED(function, 1)
const call_t machine_calls[] = {
    WEIGHED(step, 8),
    WEIGHED(step_compensated, 4),
    {"step_located", count_step_located, "segment", MAX_SEGMENTS, 1},
    {"ensemble_step", count_ensemble_step, "state", MAX_STATES, 1},
    ENTRY(begin),
    ENTRY(begin_with_slip),
    ENTRY(prepare),
    ENTRY(prepare_compensated),
    ENTRY(speed_for_slip_compensated),
    ENTRY(input_default),
    ENTRY(slip),
    ENTRY(speed_for_slip),
    ENTRY(energy),
    ENTRY(tyre_force),
    ENTRY(tyre_is_set_valued),
    ENTRY(philox),
    ENTRY(ensemble_put),
    ENTRY(ensemble_get),
    ENTRY(ensemble_report),
    ENTRY(scene_input),
    ENTRY(scene_start),
    ENTRY(simulation_input),
    ENTRY(tally_count),
    ENTRY(simulation_set_input),
    ENTRY(simulation_start),
    ENTRY(simulation_open),
    ENTRY(two_folds),
    ENTRY(normal_form),
    ENTRY(design_two_fold),
    ENTRY(surface_at),
};
const unsigned machine_call_count =
    sizeof machine_calls / sizeof machine_calls[0];
