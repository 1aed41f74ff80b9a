// Raw bits as parameters, states and inputs; steps of every scheme and the
// analysis of the machine. The input is a program: an operation a byte, its
// operands behind it. Parameters that are refused stay as they were set, so
// that several can change before the machine takes them; it keeps the last that
// it took.
#include "../../../tests/support/same_state.h"
#include "verify/fuzz/fuzz.h"

#define MAX_OPERATIONS 64
#define MAX_STEPS 128
#define LANES (TF_LANES + 3) // a full block, and one that is not

typedef struct {
  fuzz_bytes_t in;
  tf_params_t params;
  tf_compensated_t machine;
  tf_state_t state;
  tf_compensation_t compensation;
  tf_input_t input;
  int steps;
} subject_t;

// The members of a machine between two offsets, all of them reals.
static int finite_between(const tf_machine_t *machine, size_t from, size_t to) {
  for (size_t at = from; at < to; at += sizeof(tf_real_t)) {
    tf_real_t x;
    memcpy(&x, (const char *)machine + at, sizeof x);
    if (!fuzz_finite(x)) return 0;
  }
  return 1;
}

static int finite_machine(const tf_machine_t *machine) {
  return finite_between(machine, 0, offsetof(tf_machine_t, segments)) &&
         finite_between(machine, offsetof(tf_machine_t, contact.tyre.mu),
                        offsetof(tf_machine_t, contact.exit_threshold));
}

static const char *prepare(subject_t *s) {
  tf_compensated_t was;
  tf_machine_t plain;
  int offender = -1, other = -1;
  memcpy(&was, &s->machine, sizeof was);
  memcpy(&plain, &s->machine.machine, sizeof plain);
  const tf_status_t status = tf_prepare(&plain, &s->params, &offender);
  FUZZ_HOLD(tf_prepare_compensated(&s->machine, &s->params, &other) == status);
  FUZZ_HOLD(offender == other);
  if (status != TF_OK) {
    FUZZ_HOLD(status == TF_BAD_PARAMETER);
    FUZZ_HOLD(offender >= 0 && offender <= TF_PARAMETERS);
    FUZZ_HOLD(memcmp(&plain, &was.machine, sizeof plain) == 0);
    FUZZ_HOLD(memcmp(&s->machine, &was, sizeof was) == 0);
    return NULL;
  }
  FUZZ_HOLD(offender == -1);
  FUZZ_HOLD(finite_machine(&plain) && finite_machine(&s->machine.machine));
  FUZZ_HOLD(fuzz_finite(s->machine.low_sin_gamma));
  FUZZ_HOLD(fuzz_finite(s->machine.low_cos_gamma));
  FUZZ_HOLD(fuzz_finite(s->machine.low_inertia));
  return NULL;
}

// What holds for every report of an accepted call.
static const char *judge_report(const tf_report_t *report,
                                const tf_state_t *state, tf_status_t status) {
  FUZZ_HOLD(report->status == status && report->mode == state->mode);
  FUZZ_HOLD(report->mode < TF_MODES && report->set < 1u << TF_MODES);
  FUZZ_HOLD(report->choices == fuzz_popcount(report->set));
  FUZZ_HOLD(status > TF_OK || (report->set & TF_MODE_BIT(report->mode)) != 0);
  FUZZ_HOLD(fuzz_finite(report->force.F) && fuzz_finite(report->force.M));
  FUZZ_HOLD(fuzz_finite(report->slip.h) && fuzz_finite(report->slip.g));
  FUZZ_HOLD(fuzz_finite(report->delassus) && fuzz_finite(report->residual));
  return NULL;
}

// What holds after every step, refused or not.
static const char *judge_step(const tf_state_t *was, const tf_state_t *state,
                              const tf_report_t *report, tf_status_t status) {
  FUZZ_HOLD(report->status == status);
  if (status < 0) {
    FUZZ_HOLD(memcmp(was, state, sizeof *was) == 0);
    return NULL;
  }
  FUZZ_HOLD(status == TF_OK || status == TF_DEGRADED || status >= TF_COARSE ||
            status == TF_FELL_BACK);
  FUZZ_HOLD(fuzz_in_reach(state));
  FUZZ_HOLD(state->tick == was->tick + 1 && state->seed == was->seed);
  // phi is the caller's own: only what was small stays finite.
  if (was->phi >= -TF_STATE_LIMIT && was->phi <= TF_STATE_LIMIT)
    FUZZ_HOLD(fuzz_finite(state->phi));
  return judge_report(report, state, status);
}

static const char *begin(subject_t *s) {
  tf_state_t was;
  tf_report_t report, before;
  memset(&report, 0x5a, sizeof report);
  memcpy(&before, &report, sizeof before);
  memcpy(&was, &s->state, sizeof was);
  memset(&s->compensation, 0, sizeof s->compensation);
  const tf_status_t status =
      tf_begin(&s->machine.machine, &s->state, &s->input, &report);
  if (status != TF_OK) {
    FUZZ_HOLD(status == TF_BAD_STATE);
    FUZZ_HOLD(memcmp(&was, &s->state, sizeof was) == 0);
    FUZZ_HOLD(memcmp(&report, &before, sizeof report) == 0);
    return NULL;
  }
  FUZZ_HOLD(s->state.tick == was.tick && s->state.seed == was.seed);
  // A law of rest may leave no future at h = g = 0.
  if (report.set == 0) {
    FUZZ_HOLD(report.choices == 0 && report.mode == TF_PINNED);
    return NULL;
  }
  return judge_report(&report, &s->state, status);
}

typedef enum { MOREAU, COMPENSATED, LOCATED } scheme_t;

static const char *step_by(subject_t *s, scheme_t scheme) {
  const tf_machine_t *machine = &s->machine.machine;
  tf_compensation_t *carried = &s->compensation, kept;
  tf_state_t was;
  tf_report_t report;
  memset(&report, 0, sizeof report);
  memcpy(&was, &s->state, sizeof was);
  if (scheme != COMPENSATED) memset(carried, 0, sizeof *carried);
  memcpy(&kept, carried, sizeof kept);
  const tf_status_t status =
      scheme == LOCATED
          ? tf_step_located(machine, &s->state, &s->input, &report)
      : scheme == COMPENSATED ? tf_step_compensated(&s->machine, &s->state,
                                                    carried, &s->input, &report)
                              : tf_step(machine, &s->state, &s->input, &report);
  FUZZ_HOLD(scheme == LOCATED || status <= TF_DEGRADED || status >= TF_COARSE);
  if (status < 0) FUZZ_HOLD(memcmp(&kept, carried, sizeof kept) == 0);
  FUZZ_HOLD(fuzz_finite(carried->r) && fuzz_finite(carried->v));
  FUZZ_HOLD(fuzz_finite(carried->w));
  return judge_step(&was, &s->state, &report, status);
}

static const char *step(subject_t *s) { return step_by(s, MOREAU); }

static const char *step_compensated(subject_t *s) {
  return step_by(s, COMPENSATED);
}

static const char *locate(subject_t *s) {
  s->steps += 15; // what it costs more than tf_step
  return step_by(s, LOCATED);
}

// The state in many lanes, each a little different.
static tf_state_t lane_of(const tf_state_t *state, unsigned lane) {
  tf_state_t x = *state;
  x.mode = (uint8_t)(lane < TF_MODES ? lane : x.mode);
  x.tick += lane;
  if (lane & 1u) x.v = -x.v;
  if (lane & 2u) x.r = -x.r;
  if (lane > 8) x.w += x.w * (tf_real_t)lane * TF_R(0.001);
  return x;
}

static const char *ensemble(subject_t *s) {
  tf_state_block_t blocks[TF_BLOCKS(LANES)];
  tf_report_block_t reports[TF_BLOCKS(LANES)];
  memset(blocks, 0, sizeof blocks);
  memset(reports, 0, sizeof reports);
  for (unsigned i = 0; i < LANES; i++) {
    const tf_state_t x = lane_of(&s->state, i);
    tf_ensemble_put(blocks, i, &x);
  }
  s->steps += 2 * LANES;
  FUZZ_HOLD(tf_ensemble_step(&s->machine.machine, blocks, LANES, &s->input,
                             reports) <= LANES);
  for (unsigned i = 0; i < LANES; i++) {
    tf_state_t x = lane_of(&s->state, i);
    tf_report_t report;
    memset(&report, 0, sizeof report);
    const tf_status_t status =
        tf_step(&s->machine.machine, &x, &s->input, &report);
    const tf_state_t got = tf_ensemble_get(blocks, i);
    const tf_report_t told = tf_ensemble_report(reports, i);
    FUZZ_HOLD(same_state(&x, &got));
    FUZZ_HOLD(told.status == status);
    FUZZ_HOLD(status < 0 || same_report(&report, &told));
  }
  return NULL;
}

static const char *take_scene(subject_t *s, unsigned index) {
  const tf_scene_t *scene = tf_scenes[index % TF_SCENES];
  s->params = scene->params;
  memset(&s->state, 0, sizeof s->state);
  memset(&s->compensation, 0, sizeof s->compensation);
  FUZZ_HOLD_ALL(prepare(s));
  s->input = tf_scene_input(scene, &s->machine.machine, 0);
  s->state.r = scene->r;
  s->state.v = scene->v;
  s->state.w = scene->omega;
  s->state.mode = TF_NO_MODE;
  return NULL;
}

// A state on, or at a given distance from, h = 0.
static const char *place(subject_t *s, tf_real_t h) {
  tf_real_t v = s->state.v;
  const tf_status_t status = tf_speed_for_slip(
      &s->machine.machine, s->state.r, s->state.w, s->input.omega0, h, &v);
  FUZZ_HOLD(status == TF_OK || fuzz_same(v, s->state.v));
  s->state.v = v;
  return NULL;
}

static void set_parameter(subject_t *s, unsigned index) {
  const tf_real_t value = fuzz_real(&s->in);
  memcpy((char *)&s->params + tf_parameter_ranges[index].offset, &value,
         sizeof value);
}

static void set_member(subject_t *s, unsigned index) {
  tf_real_t *const members[] = {
      &s->state.r,     &s->state.v,      &s->state.w,
      &s->state.phi,   &s->input.omega0, &s->input.r0,
      &s->input.force, &s->input.torque, &s->input.alpha};
  *members[index % (sizeof members / sizeof members[0])] = fuzz_real(&s->in);
  memset(&s->compensation, 0, sizeof s->compensation);
}

static void set_whole(subject_t *s) {
  s->state.mode = fuzz_byte(&s->in);
  s->state.seed = fuzz_byte(&s->in);
  s->state.tick = fuzz_byte(&s->in) * UINT64_C(0x0101010101010101);
}

static const char *repeat(subject_t *s, unsigned times,
                          const char *(*perform)(subject_t *)) {
  for (unsigned i = 0; i <= times && s->steps < MAX_STEPS; i++) {
    s->steps++;
    FUZZ_HOLD_ALL(perform(s));
  }
  return NULL;
}

// The low half of a byte says what, the high half how often or which.
static const char *operate(subject_t *s, uint8_t operation) {
  const unsigned which = operation >> 4;
  unsigned chance;
  switch (operation & 15u) {
    case 0:
      return repeat(s, which, begin);
    case 1:
    case 2:
      return repeat(s, which, step);
    case 3:
      return repeat(s, which, step_compensated);
    case 4:
      return repeat(s, which, locate);
    case 5:
      return ensemble(s);
    case 6:
    case 7:
      set_parameter(s, (which + 16 * (operation & 1u)) % TF_PARAMETERS);
      return prepare(s);
    case 8:
      s->params.law = (tf_tyre_law_t)which;
      chance = fuzz_byte(&s->in);
      s->params.rule = (tf_rule_t)(chance % (TF_RULES + 1));
      s->params.rest =
          (tf_rest_law_t)(chance / (TF_RULES + 1) % (TF_REST_LAWS + 1));
      s->params.with_angle = (which & 8u) != 0;
      if (which >= 8) s->params.law = (tf_tyre_law_t)(which - 8);
      return prepare(s);
    case 9:
      set_whole(s);
      return NULL;
    case 10:
      return take_scene(s, which);
    case 11:
      return place(s, which ? fuzz_real(&s->in) : 0);
    case 15:
      return fuzz_analysis(&s->machine.machine, &s->input, &s->state);
    default:
      set_member(s, which);
      return NULL;
  }
}

const char *fuzz_machine(const uint8_t *data, size_t size) {
  subject_t s;
  memset(&s, 0, sizeof s);
  s.in = (fuzz_bytes_t){data, data + size};
  FUZZ_HOLD_ALL(take_scene(&s, fuzz_byte(&s.in)));
  for (int i = 0; i < MAX_OPERATIONS && s.in.at < s.in.end; i++)
    FUZZ_HOLD_ALL(operate(&s, fuzz_byte(&s.in)));
  return NULL;
}
