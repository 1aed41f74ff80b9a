// The motion of an instance: how it begins, and its communication steps. Time
// is the number of steps of dt: it cannot drift, and an importer whose own time
// does gets a message.

#include <string.h>

#include "fmu_scene.h"
#include "model.h"
#include "take.h"

// How far, in steps of dt, the length of a communication step may be from a
// whole number. Importers send 0.016666666666666677.
#define LENGTH_ROUNDING 1e-6
// How far, in steps of dt, the importer's time may be from that of the FMU. It
// adds up its roundings.
#define TIME_ROUNDING 0.1
// The most steps of one motion: whole numbers up to here are exact in a double.
#define MAX_STEPS 1e15

static double magnitude_of(double x) { return x < 0 ? -x : x; }

double fmu_time(const fmu_motion_t *motion) {
  if (!motion->begun) return motion->start_time;
  return motion->start_time +
         (double)motion->state.tick * (double)motion->machine.dt;
}

static tf_params_t parameters_of(const fmu_values_t *values) {
  tf_params_t params;
  memset(&params, 0, sizeof params);
  for (size_t i = 0; i < TF_PARAMETERS; i++) {
    const tf_real_t value = (tf_real_t)values->real[i];
    memcpy((char *)&params + tf_parameter_ranges[i].offset, &value,
           sizeof value);
  }
  params.omega0 = (tf_real_t)values->real[FMU_OMEGA0];
  params.r0 = (tf_real_t)values->real[FMU_R0];
  params.law = (tf_tyre_law_t)values->whole[FMU_LAW];
  params.rule = (tf_rule_t)values->whole[FMU_RULE];
  params.rest = FMU_SCENE->params.rest;
  params.with_angle = values->whole[FMU_WITH_ANGLE] != 0;
  return params;
}

// The inputs of the step that ends at a tick. Those of the importer are of the
// communication step, which ends at another one: over it the turntable comes to
// omega0, with the acceleration alpha.
static tf_input_t input_at(const fmu_motion_t *motion, uint64_t tick,
                           uint64_t end) {
  const fmu_values_t *values = &motion->values;
  const tf_scene_t *scene = FMU_SCENE;
  tf_input_t input = {.omega0 = (tf_real_t)values->real[FMU_OMEGA0],
                      .r0 = (tf_real_t)values->real[FMU_R0],
                      .force = (tf_real_t)values->real[FMU_FORCE],
                      .torque = (tf_real_t)values->real[FMU_TORQUE],
                      .alpha = (tf_real_t)values->real[FMU_ALPHA]};
  if (values->whole[FMU_FOLLOW_PROFILE] != 0 && !motion->steered) {
    const tf_input_t driven = tf_scene_input(scene, &motion->machine, tick);
    input.omega0 = driven.omega0;
    input.alpha = driven.alpha;
  } else {
    input.omega0 -=
        input.alpha * ((tf_real_t)(end - tick) * motion->machine.dt);
  }
  return input;
}

static fmu_status_t prepare(fmu_t *fmu) {
  fmu_motion_t *motion = &fmu->motion;
  const fmu_values_t *values = &motion->values;
  const tf_params_t params = parameters_of(values);
  const unsigned located =
      (1u << TF_TYRE_JUMP) | (1u << TF_TYRE_COULOMB) | (1u << TF_TYRE_NONE);
  int offender = TF_PARAMETERS;
  if (values->whole[FMU_FOLLOW_PROFILE] != 0 && FMU_SCENE->knots == 0)
    return fmu_discard(fmu, "follow_profile = true: the scene has no profile");
  if (values->whole[FMU_SCHEME] == FMU_LOCATED &&
      ((located >> params.law) & 1u) == 0)
    return fmu_discard(fmu,
                       "scheme = located: law must be jump, coulomb or none");
  if (tf_prepare(&motion->machine, &params, &offender) == TF_OK) return FMU_OK;
  return fmu_discard(fmu, "%s is out of its range",
                     offender < TF_PARAMETERS
                         ? tf_parameter_ranges[offender].name
                         : "law or rule");
}

fmu_status_t fmu_begin(fmu_t *fmu) {
  fmu_motion_t *motion = &fmu->motion;
  const fmu_values_t *values = &motion->values;
  motion->begun = false;
  if (prepare(fmu) != FMU_OK) return FMU_DISCARD;
  motion->steered =
      (tf_real_t)values->real[FMU_OMEGA0] != FMU_SCENE->params.omega0 ||
      values->real[FMU_ALPHA] != 0;
  const tf_input_t input = input_at(motion, 0, 0);
  const tf_real_t h = (tf_real_t)values->real[FMU_START_H];
  tf_state_t start;
  memset(&start, 0, sizeof start);
  start.r = (tf_real_t)values->real[FMU_START_R];
  start.v = (tf_real_t)values->real[FMU_START_V];
  start.w = (tf_real_t)values->real[FMU_START_OMEGA];
  start.phi = (tf_real_t)values->real[FMU_START_PHI];
  start.seed = (uint32_t)values->whole[FMU_SEED];
  start.mode = TF_NO_MODE;
  const bool from_h = values->whole[FMU_START_FROM_H] != 0;
  if ((from_h ? tf_begin_with_slip(&motion->machine, &start, &input, h,
                                   &motion->report)
              : tf_begin(&motion->machine, &start, &input, &motion->report)) !=
      TF_OK) {
    if (from_h && tf_speed_for_slip(&motion->machine, start.r, start.w,
                                    input.omega0, h, &start.v) != TF_OK)
      return fmu_discard(fmu,
                         "no start.v gives start.h, because sin(gamma) is 0:"
                         " set start.from_h to false");
    return fmu_discard(fmu,
                       "the start is out of range: start.r, start.v,"
                       " start.omega and the inputs add up to more than 1e9");
  }
  motion->state = start;
  motion->values.real[FMU_TURNTABLE] = (double)input.omega0;
  motion->begun = true;
  fmu_observe(motion);
  return FMU_OK;
}

void fmu_observe(fmu_motion_t *motion) {
  const tf_report_t *report = &motion->report;
  double *real = motion->values.real;
  int64_t *whole = motion->values.whole;
  real[FMU_R] = (double)motion->state.r;
  real[FMU_V] = (double)motion->state.v;
  real[FMU_OMEGA] = (double)motion->state.w;
  real[FMU_PHI] = (double)motion->state.phi;
  real[FMU_H] = (double)report->slip.h;
  real[FMU_G] = (double)report->slip.g;
  real[FMU_F] = (double)report->force.F;
  real[FMU_M] = (double)report->force.M;
  real[FMU_DELASSUS] = (double)report->delassus;
  real[FMU_RESIDUAL] = (double)report->residual;
  real[FMU_ENERGY] = (double)tf_energy(&motion->machine, &motion->state,
                                       (tf_real_t)real[FMU_R0]);
  real[FMU_EVENT_TIME] = motion->start_time + (double)motion->event_tick *
                                                  (double)motion->machine.dt;
  whole[FMU_MODE] = report->mode;
  whole[FMU_CHOICES] = report->choices;
  whole[FMU_SET] = report->set;
  whole[FMU_STATUS] = (int64_t)report->status;
  whole[FMU_TICK] = (int64_t)motion->state.tick;
  whole[FMU_EVENTS] = (int64_t)motion->events;
  whole[FMU_DEGRADED] = (int64_t)motion->tally.degraded;
  whole[FMU_FELL_BACK] = (int64_t)motion->tally.fell_back;
  whole[FMU_COARSE] = (int64_t)motion->tally.coarse;
  whole[FMU_STALLED] = (int64_t)motion->tally.stalled;
  whole[FMU_REFUSED] = (int64_t)motion->tally.refused;
  whole[FMU_FIRST] = (int64_t)motion->tally.first;
}

// The tick at which a communication step ends.
static fmu_status_t find_end(fmu_t *fmu, double time, double length,
                             uint64_t *end) {
  const fmu_motion_t *motion = &fmu->motion;
  const double dt = (double)motion->machine.dt, now = fmu_time(motion);
  const double last = time + length;
  const double reach = magnitude_of(time) + magnitude_of(last);
  if (!(reach <= DBL_MAX) || !(length > 0))
    return fmu_error(fmu,
                     "communicationStepSize = %g s must be > 0, at"
                     " currentCommunicationPoint = %g s",
                     length, time);
  if (!(magnitude_of(time - now) <= TIME_ROUNDING * dt))
    return fmu_error(fmu,
                     "currentCommunicationPoint = %g s, but the time of this"
                     " FMU is %g s",
                     time, now);
  if (motion->stops && last > motion->stop_time + TIME_ROUNDING * dt)
    return fmu_error(fmu, "the step would end at %g s, after stopTime = %g s",
                     last, motion->stop_time);
  const double steps = length / dt;
  const double rounding = 4 * DBL_EPSILON * reach / dt;
  if (!(steps + (double)motion->state.tick <= MAX_STEPS))
    return fmu_refuse(
        fmu, fmu->refusal,
        "communicationStepSize = %g s is more than 1e15 steps of dt = %g s",
        length, dt);
  const uint64_t whole = (uint64_t)(steps + 0.5);
  const double off = magnitude_of(steps - (double)whole);
  if (whole == 0 ||
      !(off <= (rounding > LENGTH_ROUNDING ? rounding : LENGTH_ROUNDING)))
    return fmu_refuse(
        fmu, fmu->refusal,
        "communicationStepSize = %g s is no whole multiple of dt = %g s; the"
        " nearest is %g s",
        length, dt, (double)(whole > 0 ? whole : 1) * dt);
  *end = motion->state.tick + whole;
  return FMU_OK;
}

// The motion as before the communication step, which is refused.
static void go_back(fmu_t *fmu) {
  memcpy(&fmu->motion, &fmu->before, sizeof fmu->motion);
}

static fmu_status_t refuse_step(fmu_t *fmu, tf_status_t status) {
  const double time = fmu_time(&fmu->motion);
  const uint64_t tick = fmu->motion.state.tick;
  go_back(fmu);
  tf_tally_count(&fmu->motion.tally, tick, status);
  fmu->motion.values.whole[FMU_REFUSED] = (int64_t)fmu->motion.tally.refused;
  fmu->motion.values.whole[FMU_FIRST] = (int64_t)fmu->motion.tally.first;
  return fmu_refuse(fmu, fmu->refusal, "no step from t = %g s: %s", time,
                    tf_status_name(status));
}

typedef struct {
  fmu_motion_t *motion;
  tf_input_t input;
} coming_t;

static tf_status_t step_once(void *of) {
  const coming_t *coming = of;
  fmu_motion_t *motion = coming->motion;
  return (motion->values.whole[FMU_SCHEME] == FMU_LOCATED ? tf_step_located
                                                          : tf_step)(
      &motion->machine, &motion->state, &coming->input, &motion->report);
}

static tf_status_t take_step(coming_t *coming, unsigned mode) {
  fmu_motion_t *motion = coming->motion;
  return take_mode(step_once, coming, &motion->state, &motion->machine.contact,
                   &motion->report, mode);
}

// The report of the last step does not tell: its set is that of its end or of
// an instant within it, which may be past. So the step is tried in each mode.
fmu_status_t fmu_check_open(fmu_t *fmu, fmu_status_t status, unsigned mode,
                            uint64_t end) {
  fmu_message_t *message = fmu_begin_message(fmu);
  const char *comma = "; open in the next step: ";
  fmu_say(message, "take = %s is not open", tf_mode_name(mode));
  for (unsigned other = 0; other < TF_MODES; other++) {
    fmu_motion_t motion = fmu->motion;
    coming_t coming = {&motion, input_at(&motion, motion.state.tick + 1, end)};
    if (take_step(&coming, other) < 0) continue;
    if (other == mode) return FMU_OK;
    fmu_say(message, "%s%s", comma, tf_mode_name(other));
    comma = ", ";
  }
  return fmu_refuse_so(fmu, status);
}

static void log_event(fmu_t *fmu) {
  if (fmu->emit == NULL || (fmu->logs & FMU_LOG_EVENTS) == 0) return;
  fmu_message_t *message = fmu_begin_message(fmu);
  fmu_say(message, "t = %g s, mode %s, choices %u", fmu_time(&fmu->motion),
          tf_mode_name(fmu->motion.report.mode),
          (unsigned)fmu->motion.report.choices);
  fmu->emit(fmu, FMU_OK, fmu_categories[0], message->text);
}

// One step of dt, of a communication step that ends at a tick. event: out,
// whether mode or set changed.
static fmu_status_t advance(fmu_t *fmu, uint64_t end, bool *event) {
  fmu_motion_t *motion = &fmu->motion;
  const unsigned mode = motion->report.mode, set = motion->report.set;
  const unsigned wanted = (unsigned)motion->values.whole[FMU_TAKE];
  coming_t coming = {motion, input_at(motion, motion->state.tick + 1, end)};
  const tf_status_t status =
      motion->takes ? take_step(&coming, wanted) : step_once(&coming);
  if (motion->takes && status == TF_BAD_PARAMETER) {
    go_back(fmu);
    return fmu_check_open(fmu, fmu->refusal, wanted, end);
  }
  if (status < 0) return refuse_step(fmu, status);
  motion->takes = false;
  motion->values.real[FMU_TURNTABLE] = (double)coming.input.omega0;
  tf_tally_count(&motion->tally, motion->state.tick, status);
  *event = motion->report.mode != mode || motion->report.set != set;
  if (*event) {
    motion->events++;
    motion->event_tick = motion->state.tick;
    log_event(fmu);
  }
  return FMU_OK;
}

fmu_status_t fmu_step(fmu_t *fmu, double time, double length, fmu_step_t *end) {
  uint64_t last = 0;
  *end = (fmu_step_t){.time = fmu_time(&fmu->motion)};
  fmu_status_t status = find_end(fmu, time, length, &last);
  if (status != FMU_OK) return status;
  memcpy(&fmu->before, &fmu->motion, sizeof fmu->before);
  while (fmu->motion.state.tick < last) {
    status = advance(fmu, last, &end->event);
    if (status != FMU_OK) return status;
    if (end->event && fmu->early_return) break;
  }
  fmu_observe(&fmu->motion);
  end->early = fmu->motion.state.tick < last;
  end->time = fmu_time(&fmu->motion);
  return FMU_OK;
}

fmu_status_t fmu_initialized(fmu_t *fmu, unsigned next_phase) {
  const fmu_status_t status = fmu_begin(fmu);
  return status == FMU_OK ? fmu_go_to(fmu, next_phase) : status;
}
