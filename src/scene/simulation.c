// A scene in progress: its start and inputs, steps counted by status.
#include "twofold/simulation.h"

#include <stddef.h>

#include "../num/kernel.h"
#include "../num/rounding.h"

// Steps counted by status.

static uint64_t *count_of(tf_tally_t *tally, tf_status_t status) {
  switch ((int)status) {
    case TF_DEGRADED:
      return &tally->degraded;
    case TF_FELL_BACK:
      return &tally->fell_back;
    case TF_COARSE:
      return &tally->coarse;
    case TF_STALLED:
      return &tally->stalled;
    default:
      return &tally->refused;
  }
}

// Whether nothing has been counted. By bytes, and with one increment below: an
// AVR has no word of 64 bits, and five of them at a time take 300 B of its
// flash.
static bool is_empty(const tf_tally_t *tally) {
  const unsigned char *byte = (const unsigned char *)tally;
  unsigned any = 0;
  for (size_t i = 0; i < offsetof(tf_tally_t, first); i++) any |= byte[i];
  return any == 0;
}

// A function of its own, so that a step that is TF_OK costs one comparison.
TF_RARE void tally_reservation(tf_tally_t *tally, uint64_t tick,
                               tf_status_t status) {
  if (is_empty(tally)) tally->first = tick;
  (*count_of(tally, status))++;
}

TF_API void tf_tally_count(tf_tally_t *tally, uint64_t tick,
                           tf_status_t status) {
  if (status != TF_OK) tally_reservation(tally, tick, status);
}

// How a scene starts, and its inputs over time.

// The time of a tick, by halves: both conversions are of 32 bits, and that of
// 64 takes 2 KB on a processor without floating point. Up to 2^32 it is rounded
// as that.
static tf_real_t time_of(uint64_t tick, tf_real_t dt) {
  const tf_real_t high = (tf_real_t)(uint32_t)(tick >> 32) * TF_R(0x1p32);
  return (high + (tf_real_t)(uint32_t)tick) * dt;
}

// The speed of the turntable at a time, to which knots up to t + off belong.
static tf_real_t speed_at(const tf_scene_t *scene, tf_real_t t, tf_real_t off) {
  const tf_knot_t *knot = scene->profile;
  int i = 0;
  while (i + 1 < scene->knots && knot[i + 1].t <= t + off) i++;
  if (i + 1 == scene->knots || t <= knot[i].t) return knot[i].omega0;
  if (t >= knot[i + 1].t) return knot[i + 1].omega0;
  return knot[i].omega0 + (knot[i + 1].omega0 - knot[i].omega0) *
                              ((t - knot[i].t) / (knot[i + 1].t - knot[i].t));
}

// By how much the speed jumps between two times.
static tf_real_t jumps_between(const tf_scene_t *scene, tf_real_t from,
                               tf_real_t to) {
  const tf_knot_t *knot = scene->profile;
  tf_real_t sum = 0;
  for (int i = 0; i + 1 < scene->knots; i++)
    if (knot[i].t == knot[i + 1].t && knot[i].t > from && knot[i].t <= to)
      sum += knot[i + 1].omega0 - knot[i].omega0;
  return sum;
}

// A knot that belongs to the boundary of two steps but for the rounding of tick
// dt, and of the decimals of both, is neither within the step before nor within
// the one behind: a jump there acts between the two.
TF_API tf_input_t tf_scene_input(const tf_scene_t *scene,
                                 const tf_machine_t *machine, uint64_t tick) {
  tf_input_t input = tf_input_default(machine);
  if (scene->knots == 0) return input;
  const uint64_t first = tick == 0 ? 0 : tick - 1;
  const tf_real_t dt = machine->dt;
  const tf_real_t from = time_of(first, dt), to = time_of(first + 1, dt);
  const tf_real_t rounding = dt * TF_R(0x1p-20) + 4 * TF_REAL_EPSILON * to;
  const tf_real_t off = rounding < dt / 2 ? rounding : dt / 2;
  const tf_real_t start = speed_at(scene, from, off);
  input.omega0 = start + jumps_between(scene, from + off, to - off);
  tf_turntable_to(&input, speed_at(scene, to, -off), dt);
  if (tick == 0) input.omega0 = start;
  return input;
}

TF_API tf_status_t tf_scene_start(const tf_scene_t *scene,
                                  const tf_machine_t *machine, uint32_t seed,
                                  tf_state_t *state, tf_report_t *report) {
  const tf_input_t input = tf_scene_input(scene, machine, 0);
  tf_state_t start = {.r = scene->r,
                      .v = scene->v,
                      .w = scene->omega,
                      .seed = seed,
                      .mode = TF_NO_MODE};
  const tf_status_t status =
      scene->v_is_given
          ? tf_begin(machine, &start, &input, report)
          : tf_begin_with_slip(machine, &start, &input, scene->h, report);
  if (status == TF_OK) *state = start;
  return status;
}

// A running scene: machine, state and inputs tick by tick.

TF_API tf_status_t tf_simulation_start(tf_simulation_t *simulation,
                                       const tf_scene_t *scene, uint32_t seed) {
  const tf_status_t status =
      tf_scene_start(scene, &simulation->machine, seed, &simulation->state,
                     &simulation->report);
  if (status != TF_OK) return status;
  simulation->input = tf_input_default(&simulation->machine);
  simulation->source = TF_INPUT_SCENE;
  simulation->stepped = TF_INPUT_SCENE;
  simulation->left = 0;
  return TF_OK;
}

TF_API tf_status_t tf_simulation_open(tf_simulation_t *simulation,
                                      const tf_scene_t *scene,
                                      const tf_params_t *params,
                                      uint32_t seed) {
  const tf_status_t status = tf_prepare(&simulation->machine, params, NULL);
  if (status != TF_OK) return status;
  simulation->tally = (tf_tally_t){0};
  simulation->deadman = 0;
  simulation->expired = 0;
  simulation->running = true;
  return tf_simulation_start(simulation, scene, seed);
}

TF_API void tf_simulation_set_input(tf_simulation_t *simulation,
                                    const tf_input_t *input) {
  simulation->input = *input;
  simulation->source = TF_INPUT_SET;
  simulation->left = simulation->deadman;
}

// A count of ticks that are left, not a tick at which the inputs end: the tick
// jumps when a state is restored.
static void count_down(tf_simulation_t *simulation) {
  if (simulation->deadman == 0) return;
  if (simulation->left > 0) {
    simulation->left--;
    return;
  }
  simulation->source = TF_INPUT_SAFE;
  simulation->expired++;
}

TF_API tf_input_t tf_simulation_input(tf_simulation_t *simulation,
                                      const tf_scene_t *scene) {
  const tf_machine_t *machine = &simulation->machine;
  if (simulation->source == TF_INPUT_SET) count_down(simulation);
  simulation->stepped = simulation->source;
  if (simulation->source == TF_INPUT_SET) {
    const tf_input_t input = simulation->input;
    simulation->input.alpha = 0;
    return input;
  }
  if (simulation->source == TF_INPUT_SAFE) return tf_input_default(machine);
  return tf_scene_input(scene, machine, simulation->state.tick + 1);
}
