// A point is what `run` does with the same settings: the value of each axis is
// written as text, the shortest that reads back to the same bits, and then read
// like one of --set. So a row is replayed by copying its fields into a command.
// A refusal is a row, too, with the words of `run` in it. Points of one machine
// are followed together, by the steps of an ensemble, which have the bits of
// single ones.

#include "point.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../host/host.h"
#include "../run/events.h"
#include "../setup/setup.h"
#include "../text/summary.h"
#include "../text/text.h"

#define BATCH 4096 // steps between two checks for a signal
#define REASON_ROOM 512

// Outcomes: what is left of a motion when its rows are not kept. All are of the
// steps themselves, so they agree with what `run` prints of the same motion.

const cli_measure_info_t cli_measures[CLI_MEASURES] = {
    [CLI_MODES] = {"modes", "", "the modes visited, in a fixed order"},
    [CLI_FINAL] = {"final", "", "the mode at the end"},
    [CLI_CHANGES] = {"changes", "1", "number of changes of mode"},
    [CLI_REST] = {"rest", "s", "since when the wheel is pinned, to the end"},
    [CLI_ARRIVALS] = {"arrivals", "1", "number of arrivals at the two-fold"},
    [CLI_ARRIVAL] = {"arrival", "s", "time of the first of them"},
    [CLI_RECURRENCE] = {"recurrence", "s", "mean time from one to the next"},
    [CLI_AMBIGUOUS] = {"ambiguous", "s", "first instant with several futures"},
    [CLI_AMBIGUOUS_SHARE] = {"ambiguous_share", "1",
                             "share of steps with several futures"},
    [CLI_STICK_SHARE] = {"stick_share", "1", "share of steps without slip"},
    [CLI_ENERGY] = {"energy", "J", "mechanical energy at the end"},
    [CLI_ENERGY_CHANGE] = {"energy_change", "J", "that less the one at t = 0"},
    [CLI_R_LOW] = {"r_low", "m", "least r"},
    [CLI_R_HIGH] = {"r_high", "m", "largest r"},
    [CLI_END_R] = {"end_r", "m", "state at the end"},
    [CLI_END_V] = {"end_v", "m/s", ""},
    [CLI_END_OMEGA] = {"end_omega", "rad/s", ""},
    [CLI_END_H] = {"end_h", "m/s", ""},
    [CLI_END_G] = {"end_g", "m/s", ""},
};

// What was seen of a motion so far. All zero but for the first report, the
// energy, and r at the start.
typedef struct {
  uint64_t steps; // seen
  double t;       // [s], after them
  tf_state_t state;
  tf_report_t report; // of the last step
  cli_events_t events;
  unsigned modes; // bits TF_MODE_BIT
  uint64_t changes, stuck;
  cli_ambiguity_t ambiguity;
  double pinned_since;                // [s], of the last time
  double first_arrival, last_arrival; // at the two-fold [s]
  double energy, energy_at_start;     // [J]
  double r_low, r_high;               // [m]
} course_t;

static void see(course_t *course, double t, const tf_state_t *state,
                const tf_report_t *report) {
  const uint64_t arrivals = course->events.counts[CLI_TWO_FOLD];
  cli_events_observe(&course->events, &course->report, report, state, t);
  if (course->events.counts[CLI_TWO_FOLD] > arrivals) {
    course->first_arrival = arrivals == 0 ? t : course->first_arrival;
    course->last_arrival = t;
  }
  if (report->mode == TF_PINNED && course->report.mode != TF_PINNED) {
    course->pinned_since = t;
  }
  cli_ambiguity_see(&course->ambiguity, report, t);
  course->steps++;
  course->t = t;
  course->modes |= TF_MODE_BIT(report->mode);
  course->changes += report->mode != course->report.mode;
  course->stuck += !tf_mode_is_slip(report->mode);
  course->r_low = fmin(course->r_low, (double)state->r);
  course->r_high = fmax(course->r_high, (double)state->r);
  course->state = *state;
  course->report = *report;
}

static void add_modes(unsigned modes, cli_buffer_t *text) {
  const char *separator = "";
  for (unsigned mode = 0; mode < TF_MODES; mode++) {
    if ((modes & TF_MODE_BIT(mode)) != 0) {
      cli_add(text, separator);
      cli_add(text, tf_mode_name(mode));
      separator = "|";
    }
  }
}

// The number, NaN where there is none. A share is one of all steps; there is
// none without a step.
static double number_of(cli_measure_t measure, const course_t *course) {
  const double none = (double)NAN, steps = (double)course->steps;
  const uint64_t arrivals = course->events.counts[CLI_TWO_FOLD];
  const bool rests = course->report.mode == TF_PINNED;
  const double between = course->last_arrival - course->first_arrival;
  const double values[CLI_MEASURES] = {
      [CLI_REST] = rests ? course->pinned_since : none,
      [CLI_ARRIVAL] = arrivals > 0 ? course->first_arrival : none,
      [CLI_RECURRENCE] = arrivals > 1 ? between / (double)(arrivals - 1) : none,
      [CLI_AMBIGUOUS] = course->ambiguity.since,
      [CLI_AMBIGUOUS_SHARE] = (double)course->ambiguity.steps / steps,
      [CLI_STICK_SHARE] = (double)course->stuck / steps,
      [CLI_ENERGY] = course->energy,
      [CLI_ENERGY_CHANGE] = course->energy - course->energy_at_start,
      [CLI_R_LOW] = course->r_low,
      [CLI_R_HIGH] = course->r_high,
      [CLI_END_R] = (double)course->state.r,
      [CLI_END_V] = (double)course->state.v,
      [CLI_END_OMEGA] = (double)course->state.w,
      [CLI_END_H] = (double)course->report.slip.h,
      [CLI_END_G] = (double)course->report.slip.g,
  };
  return values[measure];
}

static void add_measure(cli_measure_t measure, const course_t *course,
                        cli_buffer_t *text) {
  if (measure == CLI_MODES) {
    add_modes(course->modes, text);
  } else if (measure == CLI_FINAL) {
    cli_add(text, tf_mode_name(course->report.mode));
  } else if (measure == CLI_CHANGES) {
    cli_add_count(text, course->changes);
  } else if (measure == CLI_ARRIVALS) {
    cli_add_count(text, course->events.counts[CLI_TWO_FOLD]);
  } else {
    const double value = number_of(measure, course);
    if (isfinite(value)) {
      cli_add_real(text, (tf_real_t)value);
    }
  }
}

typedef struct {
  const cli_sweep_t *sweep;
  cli_settings_t settings;
  char text[CLI_AXES][CLI_NAME_ROOM + CLI_REAL_ROOM];
  char select[CLI_REAL_ROOM];
  cli_setup_t setup;
  cli_drive_t drive; // its tables are those of sweep
  tf_input_t input;  // of the last step
  motion_t system;
  course_t course;
  tf_tally_t tally;
  cli_point_end_t end; // CLI_POINT_DONE while it goes on
  char reason[REASON_ROOM];
} point_t;

// The points that are followed together, each in its lane, where there are
// several.
static struct {
  point_t points[TF_LANES];
  size_t going; // on
  tf_state_block_t states;
  tf_report_block_t reports;
} group;

static void indices_of(const cli_args_t *args, uint64_t index,
                       uint64_t at[CLI_AXES]) {
  for (size_t i = args->axes; i > 0; i--) {
    at[i - 1] = index % args->axis[i - 1].range.count;
    index /= args->axis[i - 1].range.count;
  }
}

const char *cli_point_status(cli_point_end_t end) {
  static const char *const names[] = {"done", "flagged", "stopped", "refused"};
  return names[end];
}

// The fields by which a row begins: its number and its axes.
static void add_place(const cli_args_t *args, uint64_t index,
                      cli_buffer_t *text) {
  uint64_t at[CLI_AXES];
  indices_of(args, index, at);
  cli_add_count(text, index);
  for (size_t i = 0; i < args->axes; i++) {
    const double value = cli_range_at(&args->axis[i].range, at[i]);
    if (args->axis[i].is_seed) {
      cli_add_form(text, ",%" PRIu64, (uint64_t)value);
    } else {
      cli_add_form(text, ",%g", value);
    }
  }
}

static void place(point_t *point, const cli_sweep_t *sweep, uint64_t index) {
  const cli_args_t *args = sweep->args;
  uint64_t at[CLI_AXES];
  indices_of(args, index, at);
  point->sweep = sweep;
  point->settings = args->settings;
  for (size_t i = 0; i < args->axes; i++) {
    const cli_axis_t *axis = &args->axis[i];
    const double value = cli_range_at(&axis->range, at[i]);
    cli_buffer_t text = {point->text[i], 0, sizeof point->text[i], false};
    if (axis->is_seed) {
      (void)snprintf(point->select, sizeof point->select, "random:%.0f", value);
      continue;
    }
    cli_setting_t *setting = &point->settings.list[axis->setting];
    cli_add(&text, axis->name);
    cli_add(&text, "=");
    setting->value = point->text[i] + text.used;
    cli_add_real(&text, (tf_real_t)value);
    setting->option = "--set";
    setting->text = point->text[i];
  }
}

static int read_setup(point_t *point) {
  const cli_args_t *args = point->sweep->args;
  return cli_setup_read(
      &point->setup, args->scene, &point->settings,
      point->select[0] != '\0' ? point->select : args->select);
}

static int prepare(point_t *point, uint64_t *steps) {
  const cli_sweep_t *sweep = point->sweep;
  CLI_TRY(read_setup(point));
  CLI_TRY(cli_check_law(sweep->scheme, point->setup.params.law));
  CLI_TRY(cli_setup_machine(&point->setup));
  point->drive = sweep->drive;
  point->setup.input = cli_drive_begin(&point->drive, &point->setup.machine, 0);
  return cli_count_steps(sweep->args, point->setup.machine.dt, steps);
}

// An end of every axis, by a message that names the axis and its range.
static int check_end(cli_sweep_t *sweep, bool last) {
  const cli_args_t *args = sweep->args;
  point_t point = {0};
  uint64_t steps = 0;
  place(&point, sweep, last ? args->points - 1 : 0);
  for (size_t i = 0; i < args->axes; i++) {
    if (!args->axis[i].is_seed) {
      cli_setting_t *setting = &point.settings.list[args->axis[i].setting];
      setting->option = "--over";
      setting->text = args->axis[i].range.text;
    }
  }
  CLI_TRY(read_setup(&point));
  if (sweep->scheme == NULL) {
    sweep->scheme = cli_scheme_for(args, point.setup.params.dt, NULL);
  }
  sweep->jumps = point.setup.params.law == TF_TYRE_JUMP;
  CLI_TRY(prepare(&point, &steps));
  CLI_TRY(cli_setup_check_starts(&point.setup));
  if (!last) {
    sweep->hash = cli_scene_hash(&point.setup);
    cli_setup_notes(&point.setup, sweep->scheme->unused, sweep->scheme->why);
    cli_drive_notes(&sweep->drive, &point.setup);
  }
  return CLI_DONE;
}

int cli_point_check(cli_sweep_t *sweep) {
  CLI_TRY(check_end(sweep, false));
  return check_end(sweep, true);
}

static double energy_of(const point_t *point) {
  return (double)tf_energy(&point->setup.machine, &point->system.state,
                           point->input.r0);
}

static void begin(point_t *point) {
  cli_system_begin(&point->system, point->sweep->scheme, &point->setup);
  const tf_report_t report = point->system.report;
  point->input = point->setup.input;
  course_t *course = &point->course; // all zero
  course->state = point->system.state;
  course->report = report;
  course->modes = TF_MODE_BIT(report.mode);
  course->r_low = course->r_high = (double)course->state.r;
  course->energy_at_start = energy_of(point);
  cli_ambiguity_begin(&course->ambiguity, &report);
  group.going++;
}

static void finish(point_t *point) {
  const tf_tally_t *tally = &point->tally;
  point->course.energy = energy_of(point);
  if (point->end == CLI_POINT_DONE && cli_tally_code(tally) != CLI_DONE) {
    (void)snprintf(point->reason, REASON_ROOM,
                   "%" PRIu64 " steps degraded; %" PRIu64 " coarse; %" PRIu64
                   " stalled; first at t = %.9g s",
                   tally->degraded, tally->coarse, tally->stalled,
                   (double)tally->first * (double)point->setup.machine.dt);
    point->end = CLI_POINT_FLAGGED;
  }
}

static void note(point_t *point, uint64_t i, const tf_input_t *input,
                 const tf_report_t *report) {
  const tf_status_t status = report->status;
  if (status < 0) {
    (void)snprintf(point->reason, REASON_ROOM, "step %llu: %s",
                   (unsigned long long)i, tf_status_name(status));
    point->end = CLI_POINT_STOPPED;
    group.going--;
  } else {
    point->input = *input;
    tf_tally_count(&point->tally, i, status);
    see(&point->course, (double)i * (double)point->setup.machine.dt,
        &point->system.state, report);
  }
}

static void step_alone(point_t *point, uint64_t i) {
  tf_input_t input;
  const tf_status_t status =
      cli_drive_take(&point->drive, point->sweep->scheme, &point->setup,
                     &point->system, &input);
  tf_report_t report = point->system.report;
  report.status = status;
  note(point, i, &input, &report);
}

// The lanes for AVX2, where the program was linked with them: a baseline x86-64
// has no vectors of double that lanes could use, nearly each that is built has.
#define step_with_avx2 TF_LINK(tf_ensemble_step_avx2)
__attribute__((weak)) size_t step_with_avx2(const tf_machine_t *machine,
                                            tf_state_block_t *states, size_t n,
                                            const tf_input_t *input,
                                            tf_report_block_t *reports);
#ifdef __x86_64__
#define HAS_AVX2 (step_with_avx2 != NULL && __builtin_cpu_supports("avx2"))
#else
#define HAS_AVX2 false
#endif

// Machine and inputs are those of all points.
static void step_together(size_t count, uint64_t i) {
  // half a block and less costs more than its single steps
  const size_t lanes = count > TF_LANES / 2 ? TF_LANES : count;
  const tf_machine_t *machine = &group.points[0].setup.machine;
  const cli_span_t span = cli_span_of(i - 1, machine->dt);
  const tf_input_t input =
      cli_drive_over(&group.points[0].drive, machine, &span);
  (void)(HAS_AVX2 ? step_with_avx2 : tf_ensemble_step)(
      machine, &group.states, lanes, &input, &group.reports);
  for (size_t n = 0; n < count; n++) {
    point_t *point = &group.points[n];
    if (point->end == CLI_POINT_DONE) {
      const tf_report_t report = tf_ensemble_report(&group.reports, n);
      point->system.state = tf_ensemble_get(&group.states, n);
      note(point, i, &input, &report);
    }
  }
}

// Returns: whether the motions have come to their ends.
static bool follow(size_t count, uint64_t steps) {
  for (size_t n = 0; n < TF_LANES; n++) { // nobody sees lanes beyond count
    tf_ensemble_put(&group.states, n, &group.points[n].system.state);
  }
  for (uint64_t i = 1; i <= steps && group.going > 0; i++) {
    if (i % BATCH == 0 && cli_stop_asked()) {
      return false;
    }
    if (count > 1) {
      step_together(count, i);
    } else {
      step_alone(&group.points[0], i);
    }
  }
  return true;
}

// No field needs quotes, which not every reader of CSV knows.
static void drop_commas(char *text) {
  for (; *text != '\0'; text++) {
    if (*text == ',' || *text == '\n') {
      *text = ';';
    }
  }
}

size_t cli_points_together(const cli_sweep_t *sweep) {
  const cli_args_t *args = sweep->args;
  bool one_machine = sweep->scheme == &cli_schemes[0] && sweep->jumps;
  for (size_t i = 0; i < args->axes; i++) {
    const cli_axis_t *axis = &args->axis[i];
    one_machine = one_machine && cli_number_index(axis->name) >= TF_PARAMETERS;
  }
  return one_machine ? TF_LANES : 1;
}

bool cli_points_follow(const cli_sweep_t *sweep, uint64_t index, size_t count) {
  uint64_t steps = 0;
  group.going = 0;
  for (size_t n = 0; n < count; n++) {
    point_t *point = &group.points[n];
    memset(point, 0, sizeof *point);
    place(point, sweep, index + n);
    cli_message_divert(point->reason, REASON_ROOM);
    int code = prepare(point, &steps);
    code = code == CLI_DONE ? cli_setup_start(&point->setup) : code;
    cli_message_divert(NULL, 0);
    point->end = code == CLI_DONE ? CLI_POINT_DONE : CLI_POINT_REFUSED;
    if (code == CLI_DONE) {
      begin(point);
    }
  }
  return follow(count, steps);
}

cli_point_end_t cli_point_row(uint64_t index, size_t which,
                              char row[CLI_SWEEP_ROW], size_t *length) {
  point_t *point = &group.points[which];
  const cli_args_t *args = point->sweep->args;
  if (point->end != CLI_POINT_REFUSED) {
    finish(point);
  }
  drop_commas(point->reason);
  cli_buffer_t text = {row, 0, CLI_SWEEP_ROW, false};
  add_place(args, index + which, &text);
  cli_add_form(&text, ",%s,%s,", cli_point_status(point->end), point->reason);
  if (point->end != CLI_POINT_REFUSED) {
    cli_add_real(&text, (tf_real_t)point->course.t);
  }
  for (size_t i = 0; i < args->measures; i++) {
    cli_add(&text, ",");
    if (point->end != CLI_POINT_REFUSED) {
      add_measure((cli_measure_t)args->measure[i], &point->course, &text);
    }
  }
  cli_add(&text, "\n");
  *length = text.used;
  return point->end;
}
