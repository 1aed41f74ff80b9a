// The motion of an instance: how it begins, and its communication steps. Time
// is the number of steps of dt: it cannot drift, and an importer whose own time
// does gets a message.

#include <string.h>

#include "fmu.h"
#include "fmu_scene.h"

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
  return motion->start_time + (double)motion->now.state.tick *
                                  (double)motion->now.machine.machine.dt;
}

static tf_params_t parameters_of(const double values[FMU_VARIABLES]) {
  tf_params_t params;
  memset(&params, 0, sizeof params);
  for (size_t i = 0; i < TF_PARAMETERS; i++) {
    const tf_real_t value = (tf_real_t)values[1 + i];
    memcpy((char *)&params + tf_parameter_ranges[i].offset, &value,
           sizeof value);
  }
  params.law = (tf_tyre_law_t)values[FMU_LAW];
  params.rule = (tf_rule_t)values[FMU_RULE];
  params.rest = FMU_SCENE->params.rest;
  params.with_angle = values[FMU_WITH_ANGLE] != 0;
  return params;
}

// The inputs of the step that ends at a tick. Those of the importer are of the
// communication step, which ends at another one: over it the turntable comes to
// omega0, with the acceleration alpha.
static tf_input_t input_at(const fmu_motion_t *motion, uint64_t tick,
                           uint64_t end) {
  const double *values = motion->values;
  tf_input_t input = {.omega0 = (tf_real_t)values[FMU_OMEGA0],
                      .r0 = (tf_real_t)values[FMU_R0],
                      .force = (tf_real_t)values[FMU_FORCE],
                      .torque = (tf_real_t)values[FMU_TORQUE],
                      .alpha = (tf_real_t)values[FMU_ALPHA]};
  if (values[FMU_FOLLOW_PROFILE] != 0 && !motion->steered) {
    tf_scene_t scene = *FMU_SCENE;
    for (size_t i = 0; i < scene.knots; i++) // times of the importer
      scene.profile[i].t -= (tf_real_t)motion->start_time;
    const tf_input_t driven =
        tf_scene_input(&scene, &motion->now.machine.machine, tick);
    input.omega0 = driven.omega0;
    input.alpha = driven.alpha;
  } else {
    input.omega0 -= input.alpha *
                    ((tf_real_t)(end - tick) * motion->now.machine.machine.dt);
  }
  return input;
}

static motion_scheme_t scheme_of(const fmu_motion_t *motion) {
  return (motion_scheme_t)motion->values[FMU_SCHEME];
}

static fmu_status_t prepare(fmu_t *fmu) {
  fmu_motion_t *motion = &fmu->motion;
  const motion_scheme_t scheme = scheme_of(motion);
  const tf_params_t params = parameters_of(motion->values);
  int offender = TF_PARAMETERS;
  if (motion->values[FMU_FOLLOW_PROFILE] != 0 && FMU_SCENE->knots == 0)
    return fmu_discard(fmu, "follow_profile = true: the scene has no profile");
  if (!motion_takes_law(scheme, params.law))
    return fmu_discard(fmu, "scheme = %s: law must be " MOTION_LOCATED_LAWS,
                       motion_scheme_name(scheme));
  if (motion_prepare(&motion->now, scheme, &params, &offender) == TF_OK)
    return FMU_OK;
  return fmu_discard(fmu, "%s is out of its range",
                     offender < TF_PARAMETERS
                         ? tf_parameter_ranges[offender].name
                         : "law or rule");
}

static motion_start_t start_of(const double values[FMU_VARIABLES]) {
  motion_start_t start = motion_start(FMU_SCENE, 0);
  start.state.r = (tf_real_t)values[FMU_START_R];
  start.state.v = (tf_real_t)values[FMU_START_V];
  start.state.w = (tf_real_t)values[FMU_START_OMEGA];
  start.state.phi = (tf_real_t)values[FMU_START_PHI];
  start.state.seed = (uint32_t)values[FMU_SEED];
  start.h = (tf_real_t)values[FMU_START_H];
  start.from_h = values[FMU_START_FROM_H] != 0;
  return start;
}

fmu_status_t fmu_check_arithmetic(fmu_t *fmu, fmu_status_t status) {
  const tf_arithmetic_t found = tf_arithmetic();
  return found == TF_ARITHMETIC_OK
             ? FMU_OK
             : fmu_refuse(fmu, status, "this arithmetic changes bits: %s",
                          tf_arithmetic_name(found));
}

fmu_status_t fmu_begin(fmu_t *fmu) {
  fmu_motion_t *motion = &fmu->motion;
  const double *values = motion->values;
  motion->begun = false;
  if (fmu_check_arithmetic(fmu, FMU_DISCARD) != FMU_OK ||
      prepare(fmu) != FMU_OK)
    return FMU_DISCARD;
  motion->steered = (tf_real_t)values[FMU_OMEGA0] != FMU_SCENE->params.omega0 ||
                    values[FMU_ALPHA] != 0;
  const tf_input_t input = input_at(motion, 0, 0);
  motion_start_t start = start_of(values);
  if (motion_begin(&motion->now, scheme_of(motion), &start, &input) != TF_OK) {
    if (start.from_h &&
        tf_speed_for_slip(&motion->now.machine.machine, start.state.r,
                          start.state.w, input.omega0, start.h,
                          &start.state.v) != TF_OK)
      return fmu_discard(fmu,
                         "no start.v gives start.h, because sin(gamma) is 0:"
                         " set start.from_h to false");
    return fmu_discard(fmu,
                       "the start is out of range: start.r, start.v,"
                       " start.omega and the inputs add up to more than 1e9");
  }
  motion->values[FMU_TURNTABLE] = (double)input.omega0;
  motion->begun = true;
  fmu_observe(motion);
  return FMU_OK;
}

#define OBSERVED(name, unit, value) values[FMU_##name] = (double)(value);

void fmu_observe(fmu_motion_t *motion) {
  const tf_state_t *state = &motion->now.state;
  const tf_report_t *report = &motion->now.report;
  const tf_tally_t *tally = &motion->tally;
  double *values = motion->values;
  EACH_COLUMN(COLUMN_NONE, OBSERVED, OBSERVED)
  values[FMU_RESIDUAL] = (double)report->residual;
  values[FMU_ENERGY] = (double)tf_energy(&motion->now.machine.machine, state,
                                         (tf_real_t)values[FMU_R0]);
  values[FMU_EVENT_TIME] =
      motion->start_time +
      (double)motion->event_tick * (double)motion->now.machine.machine.dt;
  values[FMU_MODE] = report->mode;
  values[FMU_CHOICES] = report->choices;
  values[FMU_SET] = report->set;
  values[FMU_STATUS] = (double)report->status;
  values[FMU_TICK] = (double)state->tick;
  values[FMU_EVENTS] = (double)motion->events;
  values[FMU_DEGRADED] = (double)tally->degraded;
  values[FMU_FELL_BACK] = (double)tally->fell_back;
  values[FMU_COARSE] = (double)tally->coarse;
  values[FMU_STALLED] = (double)tally->stalled;
  values[FMU_REFUSED] = (double)tally->refused;
  values[FMU_FIRST] = (double)tally->first;
}

// The tick at which a communication step ends.
static fmu_status_t find_end(fmu_t *fmu, double time, double length,
                             uint64_t *end) {
  const fmu_motion_t *motion = &fmu->motion;
  const double dt = (double)motion->now.machine.machine.dt,
               now = fmu_time(motion);
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
  if (!(steps + (double)motion->now.state.tick <= MAX_STEPS))
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
        "communicationStepSize = %g s is not a whole multiple of dt = %g s;"
        " the nearest is %g s",
        length, dt, (double)(whole > 0 ? whole : 1) * dt);
  *end = motion->now.state.tick + whole;
  return FMU_OK;
}

// The motion as before the communication step, which is refused.
static void go_back(fmu_t *fmu) {
  memcpy(&fmu->motion, &fmu->before, sizeof fmu->motion);
}

static fmu_status_t refuse_step(fmu_t *fmu, tf_status_t status) {
  const double time = fmu_time(&fmu->motion);
  const uint64_t tick = fmu->motion.now.state.tick;
  go_back(fmu);
  tf_tally_count(&fmu->motion.tally, tick, status);
  fmu->motion.values[FMU_REFUSED] = (double)fmu->motion.tally.refused;
  fmu->motion.values[FMU_FIRST] = (double)fmu->motion.tally.first;
  return fmu_refuse(fmu, fmu->refusal, "the step from t = %g s was refused: %s",
                    time, tf_status_name(status));
}

// One step, into the mode that is wanted where there is one. input: out.
// changes: out, those within the step.
static tf_status_t step_once(fmu_motion_t *motion, uint64_t end, unsigned mode,
                             tf_input_t *input, motion_changes_t *changes) {
  const motion_scheme_t scheme = scheme_of(motion);
  *input = input_at(motion, motion->now.state.tick + 1, end);
  changes->count = 0;
  return mode < TF_MODES
             ? motion_take(&motion->now, scheme, input, mode)
             : motion_step_changes(&motion->now, scheme, input, changes);
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
    tf_input_t input;
    motion_changes_t changes;
    if (step_once(&motion, end, other, &input, &changes) < 0) continue;
    if (other == mode) return FMU_OK;
    fmu_say(message, "%s%s", comma, tf_mode_name(other));
    comma = ", ";
  }
  return fmu_refuse_so(fmu, status);
}

static void add_event(fmu_t *fmu, double time, const tf_report_t *report) {
  fmu->motion.events++;
  if (fmu->emit == NULL || (fmu->logs & FMU_LOG_EVENTS) == 0) return;
  fmu_message_t *message = fmu_begin_message(fmu);
  fmu_say(message, "t = %g s, mode %s, choices %u", time,
          tf_mode_name(report->mode), (unsigned)report->choices);
  fmu->emit(fmu, FMU_OK, fmu_categories[0], message->text);
}

// One step of dt, of a communication step that ends at a tick. event: out,
// whether mode or set changed.
static fmu_status_t advance(fmu_t *fmu, uint64_t end, bool *event) {
  fmu_motion_t *motion = &fmu->motion;
  unsigned mode = motion->now.report.mode;
  const unsigned set = motion->now.report.set;
  const double time = fmu_time(motion);
  const uint64_t events = motion->events;
  motion_changes_t changes;
  const unsigned wanted = (unsigned)motion->values[FMU_TAKE];
  tf_input_t input;
  const tf_status_t status = step_once(
      motion, end, motion->takes ? wanted : TF_NO_MODE, &input, &changes);
  if (motion->takes && status == TF_BAD_PARAMETER) {
    go_back(fmu);
    return fmu_check_open(fmu, fmu->refusal, wanted, end);
  }
  if (status < 0) return refuse_step(fmu, status);
  motion->takes = false;
  motion->values[FMU_TURNTABLE] = (double)input.omega0;
  tf_tally_count(&motion->tally, motion->now.state.tick, status);
  for (size_t i = 0; i < changes.count; i++) {
    const tf_report_t *report = &changes.list[i].report;
    if (report->mode != mode)
      add_event(fmu, time + changes.list[i].time, report);
    mode = report->mode;
  }
  const tf_report_t *last = &motion->now.report;
  if (last->mode != mode || (last->set != set && motion->events == events))
    add_event(fmu, fmu_time(motion), last);
  *event = motion->events != events;
  if (*event) motion->event_tick = motion->now.state.tick;
  return FMU_OK;
}

fmu_status_t fmu_step(fmu_t *fmu, double time, double length, fmu_step_t *end) {
  uint64_t last = 0;
  *end = (fmu_step_t){.time = fmu_time(&fmu->motion)};
  fmu_status_t status = find_end(fmu, time, length, &last);
  if (status == FMU_OK) status = fmu_check_arithmetic(fmu, FMU_ERROR);
  if (status != FMU_OK) return status;
  memcpy(&fmu->before, &fmu->motion, sizeof fmu->before);
  while (fmu->motion.now.state.tick < last) {
    status = advance(fmu, last, &end->event);
    if (status != FMU_OK) return status;
    if (end->event && fmu->early_return) break;
  }
  fmu_observe(&fmu->motion);
  end->early = fmu->motion.now.state.tick < last;
  end->time = fmu_time(&fmu->motion);
  return FMU_OK;
}

fmu_status_t fmu_initialized(fmu_t *fmu, unsigned next_phase) {
  const fmu_status_t status = fmu_begin(fmu);
  return status == FMU_OK ? fmu_go_to(fmu, next_phase) : status;
}
