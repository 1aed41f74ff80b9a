// A point is what `run` does with the same settings: the value of each axis is
// written as text, the shortest that reads back to the same bits, and then read
// like one of --set. So a row is replayed by copying its fields into a command.
// A refusal is a row, too, with the words of `run` in it. Points of one machine
// are followed together, by the steps of an ensemble, which have the bits of
// single ones.

#include "point.h"

#include "../text/summary.h"

#define BATCH 4096 // steps between two checks for a signal

// Outcomes: what is left of a motion when its rows are not kept. All are of the
// steps themselves, so they agree with what `run` prints of the same motion.
const cli_measure_info_t cli_measures[CLI_MEASURES] = {
    {"modes", "", "the modes visited, in a fixed order", false},
    {"final", "", "the mode at the end", false},
    {"changes", "1", "number of changes of mode", true},
    {"rest", "s", "when the wheel's final pinning begins", false},
    {"arrivals", "1", "number of arrivals at the two-fold", true},
    {"arrival", "s", "time of the first of them", false},
    {"recurrence", "s", "mean time from one to the next", false},
    {"ambiguous", "s", "first instant with several futures", false},
    {"set", "", "the modes possible then (if never several: at end)", false},
    {"ambiguous_share", "1", "share of steps with several futures", false},
    {"stick_share", "1", "share of steps without slip", false},
    {"energy", "J", "mechanical energy at the end", false},
    {"energy_change", "J", "its change since t = 0", false},
    {"r_low", "m", "least r", false},
    {"r_high", "m", "largest r", false},
    {"end_r", "m", "state at the end", false},
    {"end_v", "m/s", "", false},
    {"end_omega", "rad/s", "", false},
    {"end_h", "m/s", "", false},
    {"end_g", "m/s", "", false},
};

const char *const cli_point_ends[] = {"done", "flagged", "stopped", "refused"};

typedef struct {
  const cli_sweep_t *sweep;
  cli_settings_t settings;
  char text[CLI_AXES][CLI_NAME_ROOM + CLI_REAL_ROOM]; // NAME=VALUE
  char select[CLI_REAL_ROOM];
  cli_setup_t setup;
  cli_drive_t drive; // its tables are those of sweep
  cli_outcome_t seen;
} point_t;

// The points that are followed together, each in its lane, where there are
// several.
static struct {
  point_t points[TF_LANES];
  cli_lanes_t lanes;
} group;

static void reach(cli_lanes_t *lanes) {
  const tf_real_t *r = lanes->states.r;
  for (size_t n = 0; n < TF_LANES; n++) {
    lanes->low[n] = r[n] < lanes->low[n] ? r[n] : lanes->low[n];
    lanes->high[n] = r[n] > lanes->high[n] ? r[n] : lanes->high[n];
  }
}

static double energy_of(const cli_outcome_t *seen, const motion_t *motion) {
  return (double)tf_energy(&motion->machine.machine, &motion->state,
                           seen->input.r0);
}

void cli_outcome_begin(cli_outcome_t *seen, const motion_t *motion,
                       const tf_input_t *input) {
  seen->dt = (double)motion->machine.machine.dt;
  seen->input = *input;
  seen->low = seen->high = motion->state.r;
  seen->report = motion->report;
  seen->modes = TF_MODE_BIT(motion->report.mode);
  seen->energy_at_start = energy_of(seen, motion);
  cli_events_begin(&seen->events, 0, &motion->report);
}

// Counts the steps up to one that were not looked at: they are as it was.
static void pass(cli_outcome_t *seen, uint64_t to, const tf_report_t *report) {
  const uint64_t steps = to - seen->steps;
  if (!tf_mode_is_slip(report->mode)) seen->stuck += steps;
  if (report->choices > 1) seen->events.ambiguous += steps;
  seen->steps = to;
  seen->report = *report;
}

// What follows another report, at a time.
static void meet(cli_outcome_t *seen, const tf_report_t *before,
                 const tf_report_t *report, const tf_state_t *state, double t) {
  const uint64_t arrivals = seen->events.counts[CLI_TWO_FOLD];
  cli_events_observe(&seen->events, before, report, state, t);
  if (seen->events.counts[CLI_TWO_FOLD] > arrivals) {
    seen->first_arrival = arrivals == 0 ? t : seen->first_arrival;
    seen->last_arrival = t;
  }
  if (report->mode == TF_PINNED && before->mode != TF_PINNED)
    seen->pinned_since = t;
  seen->modes |= TF_MODE_BIT(report->mode);
  seen->changes += report->mode != before->mode;
}

void cli_outcome_see(cli_outcome_t *seen, uint64_t i, const tf_report_t *before,
                     const tf_report_t *report, const tf_state_t *state,
                     const tf_input_t *input, const motion_changes_t *within) {
  pass(seen, i - 1, before);
  seen->low = state->r < seen->low ? state->r : seen->low;
  seen->high = state->r > seen->high ? state->r : seen->high;
  if (report->status < 0) {
    (void)snprintf(seen->reason, CLI_REASON_ROOM, "step %" PRIu64 ": %s", i,
                   tf_status_name(report->status));
    seen->end = CLI_POINT_STOPPED;
    return;
  }
  tf_tally_count(&seen->tally, i, report->status);
  for (size_t n = 0; n < within->count; n++) {
    const tf_located_change_t *at = &within->list[n];
    const tf_report_t from = cli_before_change(before, at);
    meet(seen, &from, &at->report, &at->state,
         (double)(i - 1) * seen->dt + (double)at->time);
    before = &at->report;
  }
  meet(seen, before, report, state, (double)i * seen->dt);
  seen->steps = i;
  seen->input = *input;
  seen->stuck += !tf_mode_is_slip(report->mode);
  seen->report = *report;
}

// A share is one of all steps; there is none without a step.
cli_point_end_t cli_outcome_end(cli_outcome_t *seen, const motion_t *motion,
                                double values[CLI_MEASURES]) {
  const tf_tally_t *tally = &seen->tally;
  const double none = (double)NAN, steps = (double)seen->steps;
  const double arrivals = (double)seen->events.counts[CLI_TWO_FOLD];
  const tf_state_t *x = &motion->state;
  const double energy = energy_of(seen, motion);
  const double found[CLI_MEASURES] = {
      seen->modes,
      TF_MODE_BIT(seen->report.mode),
      (double)seen->changes,
      seen->report.mode == TF_PINNED ? seen->pinned_since : none,
      arrivals,
      arrivals > 0 ? seen->first_arrival : none,
      arrivals > 1 ? (seen->last_arrival - seen->first_arrival) / (arrivals - 1)
                   : none,
      seen->events.ambiguous_since,
      seen->events.set != 0 ? seen->events.set : seen->report.set,
      (double)seen->events.ambiguous / steps,
      (double)seen->stuck / steps,
      energy,
      energy - seen->energy_at_start,
      (double)seen->low,
      (double)seen->high,
      (double)x->r,
      (double)x->v,
      (double)x->w,
      (double)seen->report.slip.h,
      (double)seen->report.slip.g};
  memcpy(values, found, sizeof found);
  if (seen->end == CLI_POINT_DONE && cli_tally_code(tally) != CLI_DONE) {
    seen->end = CLI_POINT_FLAGGED;
    (void)snprintf(seen->reason, CLI_REASON_ROOM,
                   "%" PRIu64 " steps degraded; %" PRIu64 " coarse; %" PRIu64
                   " stalled; first at t = %.9g s",
                   tally->degraded, tally->coarse, tally->stalled,
                   (double)tally->first * seen->dt);
  }
  return seen->end;
}

static void add_outcomes(const cli_args_t *args, const double *values,
                         cli_buffer_t *text) {
  for (size_t i = 0; i < args->measures; i++) {
    const cli_measure_info_t *info = &cli_measures[args->measure[i]];
    const double value = values[args->measure[i]];
    char set[CLI_SET_ROOM];
    cli_add(text, ",");
    if (info->unit[0] == '\0')
      cli_add(text, cli_write_set(set, (unsigned)value));
    else if (info->counts)
      cli_add_count(text, (uint64_t)value);
    else if (isfinite(value))
      cli_add_real(text, (tf_real_t)value);
  }
}

// Writes the value of each axis as text and sets it; the last axis is the inner
// loop.
static void place(point_t *point, const cli_sweep_t *sweep, uint64_t index) {
  const cli_args_t *args = sweep->args;
  point->sweep = sweep;
  point->settings = args->settings;
  for (size_t i = args->axes; i-- > 0;) {
    const cli_axis_t *axis = &args->axis[i];
    const double value = cli_range_at(&axis->range, index % axis->range.count);
    cli_buffer_t text = {point->text[i], 0, sizeof point->text[i], false};
    index /= axis->range.count;
    cli_add_form(&text, "%s=", axis->name);
    const char *digits = point->text[i] + text.used;
    if (axis->is_seed) {
      cli_add_count(&text, (uint64_t)value);
      (void)snprintf(point->select, sizeof point->select, "random:%s", digits);
    } else {
      cli_setting_t *setting = &point->settings.list[axis->setting];
      cli_add_real(&text, (tf_real_t)value);
      setting->given.name = "--set";
      setting->given.value = point->text[i];
      setting->value = digits;
    }
  }
}

static int prepare(point_t *point, cli_sweep_t *sweep, uint64_t *steps) {
  const cli_args_t *args = sweep->args;
  CLI_TRY(
      cli_setup_read(&point->setup, args->scene, &point->settings,
                     point->select[0] != '\0' ? point->select : args->select));
  point->setup.scheme = sweep->scheme;
  CLI_TRY(cli_setup_scheme(&point->setup, NULL));
  sweep->scheme = point->setup.scheme;
  CLI_TRY(cli_setup_machine(&point->setup));
  point->drive = sweep->drive;
  point->setup.input = cli_drive_begin(&point->drive, &point->setup.machine, 0);
  return cli_count_steps(&point->setup, &args->t_end, steps);
}

// An end of every axis, by a message that names the axis and its range.
static int check_end(cli_sweep_t *sweep, bool last) {
  const cli_args_t *args = sweep->args;
  point_t point = {0};
  uint64_t steps = 0;
  place(&point, sweep, last ? args->points - 1 : 0);
  sweep->together = TF_LANES;
  for (size_t i = 0; i < args->axes; i++) {
    const cli_axis_t *axis = &args->axis[i];
    if (!axis->is_seed) {
      cli_setting_t *setting = &point.settings.list[axis->setting];
      setting->given.name = "--over";
      setting->given.value = axis->range.text;
    }
    if (cli_number_index(axis->name) < TF_PARAMETERS) sweep->together = 1;
  }
  CLI_TRY(prepare(&point, sweep, &steps));
  CLI_TRY(cli_setup_check_starts(&point.setup));
  if (sweep->scheme != MOTION_MOREAU || point.setup.params.law != TF_TYRE_JUMP)
    sweep->together = 1;
  if (!last) {
    sweep->hash = cli_scene_hash(&point.setup);
    cli_setup_notes(&point.setup);
    cli_drive_notes(&sweep->drive, &point.setup, 0,
                    (double)steps * (double)point.setup.machine.dt);
  }
  return CLI_DONE;
}

int cli_point_check(cli_sweep_t *sweep) {
  CLI_TRY(check_end(sweep, false));
  return check_end(sweep, true);
}

static void step_alone(point_t *point, uint64_t i) {
  tf_input_t input;
  const tf_status_t status = cli_drive_take(&point->drive, &point->setup,
                                            &point->setup.motion, &input);
  tf_report_t report = point->setup.motion.report;
  report.status = status;
  cli_outcome_see(&point->seen, i, &point->seen.report, &report,
                  &point->setup.motion.state, &input, &point->drive.changes);
  group.lanes.going -= point->seen.end != CLI_POINT_DONE;
}

// The lanes for AVX2, where the program was linked with them: a baseline x86-64
// has no vectors of double that lanes could use, nearly each that is built has.
#define step_with_avx2 TF_LINK(tf_ensemble_step_avx2)
__attribute__((weak)) size_t step_with_avx2(const tf_machine_t *machine,
                                            tf_state_block_t *states, size_t n,
                                            const tf_input_t *input,
                                            tf_report_block_t *reports);

size_t cli_step_lanes(const tf_machine_t *machine, tf_state_block_t *states,
                      size_t n, const tf_input_t *input,
                      tf_report_block_t *reports) {
#ifdef __x86_64__
  if (step_with_avx2 != NULL && __builtin_cpu_supports("avx2"))
    return step_with_avx2(machine, states, n, input, reports);
#endif
  return tf_ensemble_step(machine, states, n, input, reports);
}

// Which lanes are to be looked at. Of the others the step was TF_OK, and mode,
// sign of the Delassus scalar and whether there are several futures as before.
static void find_due(const tf_report_block_t *was, const tf_report_block_t *now,
                     uint8_t due[TF_LANES]) {
  for (size_t n = 0; n < TF_LANES; n++)
    due[n] = (was->delassus[n] > 0) != (now->delassus[n] > 0);
  for (size_t n = 0; n < TF_LANES; n++)
    due[n] |= (now->mode[n] != was->mode[n]) | (now->status[n] != TF_OK) |
              ((now->choices[n] > 1) != (was->choices[n] > 1));
}

void cli_lanes_begin(cli_lanes_t *lanes) {
  for (size_t n = 0; n < TF_LANES; n++) { // nobody sees lanes beyond count
    const tf_state_t *state = &lanes->motion[n % lanes->count]->state;
    tf_ensemble_put(&lanes->states, n, state);
    lanes->low[n] = lanes->high[n] = state->r;
  }
  lanes->going = lanes->count;
  lanes->input = lanes->seen[0]->input;
}

void cli_lanes_step(cli_lanes_t *lanes, uint64_t i, const tf_input_t *input) {
  // half a block and less costs more than its single steps
  const size_t n_lanes = lanes->count > TF_LANES / 2 ? TF_LANES : lanes->count;
  static const motion_changes_t none = {.count = 0};
  const tf_report_block_t *was = &lanes->reports[(i - 1) % 2];
  tf_report_block_t *now = &lanes->reports[i % 2];
  uint8_t due[TF_LANES];
  (void)cli_step_lanes(&lanes->motion[0]->machine.machine, &lanes->states,
                       n_lanes, input, now);
  reach(lanes);
  find_due(was, now, due);
  for (size_t n = 0; n < lanes->count; n++) {
    cli_outcome_t *seen = lanes->seen[n];
    if ((due[n] == 0 && i > 1) || seen->end != CLI_POINT_DONE) continue;
    const tf_report_t before =
        i > 1 ? tf_ensemble_report(was, n) : seen->report;
    const tf_report_t report = tf_ensemble_report(now, n);
    lanes->motion[n]->state = tf_ensemble_get(&lanes->states, n);
    seen->input = lanes->input;
    cli_outcome_see(seen, i, &before, &report, &lanes->motion[n]->state, input,
                    &none);
    lanes->going -= seen->end != CLI_POINT_DONE;
  }
  lanes->input = *input;
}

void cli_lanes_end(cli_lanes_t *lanes, uint64_t steps) {
  for (size_t n = 0; n < lanes->count; n++) {
    cli_outcome_t *seen = lanes->seen[n];
    seen->low = lanes->low[n];
    seen->high = lanes->high[n];
    if (seen->end != CLI_POINT_DONE || steps == 0) continue;
    const tf_report_t report =
        tf_ensemble_report(&lanes->reports[steps % 2], n);
    pass(seen, steps, &report);
    lanes->motion[n]->state = tf_ensemble_get(&lanes->states, n);
    seen->input = lanes->input;
  }
}

// first: of those in the lanes. Returns: whether they have come to their ends.
static bool follow(point_t *first, uint64_t steps) {
  cli_lanes_t *lanes = &group.lanes;
  if (first == NULL) return true;
  cli_lanes_begin(lanes);
  for (uint64_t i = 1; i <= steps && lanes->going > 0; i++) {
    if (i % BATCH == 0 && cli_stop_asked()) return false;
    if (lanes->count == 1) {
      step_alone(first, i);
      continue;
    }
    const tf_machine_t *machine = &first->setup.machine;
    const cli_span_t span = cli_span_of(i - 1, machine->dt);
    const tf_input_t input = cli_drive_over(&first->drive, machine, &span);
    cli_lanes_step(lanes, i, &input);
  }
  if (lanes->count > 1) cli_lanes_end(lanes, steps);
  return true;
}

static void write_row(const cli_sweep_t *sweep, uint64_t index, point_t *point,
                      cli_chunk_t *chunk) {
  const cli_args_t *args = sweep->args;
  cli_outcome_t *seen = &point->seen;
  double values[CLI_MEASURES];
  cli_buffer_t text = {chunk->rows + chunk->used, 0, CLI_SWEEP_ROW, false};
  (void)cli_outcome_end(seen, &point->setup.motion, values);
  // No field needs quotes, which not every reader of CSV knows.
  for (char *at = seen->reason; *at != '\0'; at++)
    if (*at == ',' || *at == '\n') *at = ';';
  cli_add_count(&text, index);
  for (size_t i = 0; i < args->axes; i++)
    cli_add_form(&text, ",%s", strchr(point->text[i], '=') + 1);
  cli_add_form(&text, ",%s,%s,", cli_point_ends[seen->end], seen->reason);
  if (seen->end != CLI_POINT_REFUSED) {
    cli_add_real(&text, (tf_real_t)((double)seen->steps * seen->dt));
    add_outcomes(args, values, &text);
  } else {
    for (size_t i = 0; i < args->measures; i++) cli_add(&text, ",");
  }
  cli_add(&text, "\n");
  chunk->used += text.used;
  chunk->ends[seen->end]++;
}

bool cli_points_follow(cli_sweep_t *sweep, uint64_t index, size_t count,
                       cli_chunk_t *chunk) {
  uint64_t steps = 0;
  cli_lanes_t *lanes = &group.lanes;
  point_t *first = NULL;
  lanes->count = 0;
  memset(chunk, 0, offsetof(cli_chunk_t, rows));
  for (size_t n = 0; n < count; n++) {
    point_t *point = &group.points[n];
    memset(point, 0, sizeof *point);
    place(point, sweep, index + n);
    cli_message_divert(point->seen.reason, CLI_REASON_ROOM);
    int code = prepare(point, sweep, &steps);
    code = code == CLI_DONE ? cli_setup_start(&point->setup) : code;
    cli_message_divert(NULL, 0);
    if (code != CLI_DONE) {
      point->seen.end = CLI_POINT_REFUSED;
      continue;
    }
    cli_outcome_begin(&point->seen, &point->setup.motion, &point->setup.input);
    if (lanes->count == 0) first = point;
    lanes->motion[lanes->count] = &point->setup.motion;
    lanes->seen[lanes->count++] = &point->seen;
  }
  if (!follow(first, steps)) return false;
  for (size_t n = 0; n < count; n++)
    write_row(sweep, index + n, &group.points[n], chunk);
  return true;
}
