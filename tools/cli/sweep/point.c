// A point is what `run` does with the same settings: the value of each axis is
// written as text, the shortest that reads back to the same bits, and then read
// like one of --set. So a row is replayed by copying its fields into a command.
// A refusal is a row, too, with the words of `run` in it.

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "../host/host.h"
#include "../setup/setup.h"
#include "../text/message.h"
#include "../text/number.h"
#include "../text/summary.h"
#include "sheet.h"

#define BATCH 4096 // steps between two checks for a signal
#define REASON_ROOM 512

typedef struct {
  const cli_sweep_t *sweep;
  cli_settings_t settings;
  char text[CLI_AXES][CLI_NAME_ROOM + CLI_REAL_ROOM];
  char select[CLI_REAL_ROOM];
  cli_setup_t setup;
  cli_drive_t drive; // its tables are those of sweep
  tf_input_t input;  // of the last step
  cli_system_t system;
  cli_course_t course;
  tf_tally_t tally;
  char reason[REASON_ROOM];
} point_t;

// The number of the value that each axis has at a point.
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

void cli_point_name(const cli_args_t *args, uint64_t index,
                    cli_buffer_t *text) {
  uint64_t at[CLI_AXES];
  indices_of(args, index, at);
  cli_add_count(text, index);
  for (size_t i = 0; i < args->axes; i++) {
    cli_add_form(text, ",%g",
                 (double)cli_range_at(&args->axis[i].range, at[i]));
  }
}

// Puts the values of the axes among the settings.
static void place(point_t *point, const cli_sweep_t *sweep, uint64_t index) {
  const cli_args_t *args = sweep->args;
  uint64_t at[CLI_AXES];
  indices_of(args, index, at);
  point->sweep = sweep;
  point->settings = args->settings;
  for (size_t i = 0; i < args->axes; i++) {
    const cli_axis_t *axis = &args->axis[i];
    const tf_real_t value = cli_range_at(&axis->range, at[i]);
    cli_buffer_t text = {point->text[i], 0, sizeof point->text[i], false};
    if (axis->is_seed) {
      (void)snprintf(point->select, sizeof point->select, "random:%.0f",
                     (double)value);
      continue;
    }
    cli_setting_t *setting = &point->settings.list[axis->setting];
    cli_add(&text, axis->name);
    cli_add(&text, "=");
    setting->value = point->text[i] + text.used;
    cli_add_real(&text, value);
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
  int code = read_setup(point);
  code = code == CLI_DONE
             ? cli_check_law(sweep->scheme, point->setup.params.law)
             : code;
  code = code == CLI_DONE ? cli_setup_machine(&point->setup) : code;
  if (code == CLI_DONE) {
    point->drive = sweep->drive;
    point->setup.input =
        cli_drive_begin(&point->drive, &point->setup.machine, 0);
    code = cli_count_steps(sweep->args, point->setup.machine.dt, steps);
  }
  return code;
}

// An end of every axis, by a message that names the axis and its range.
static int check_end(cli_sweep_t *sweep, bool last, uint32_t *hash) {
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
  int code = read_setup(&point);
  if (code == CLI_DONE && sweep->scheme == NULL) {
    sweep->scheme = cli_scheme_for(args, point.setup.params.dt, NULL);
  }
  code = code == CLI_DONE ? prepare(&point, &steps) : code;
  code = code == CLI_DONE ? cli_setup_check_starts(&point.setup) : code;
  if (code == CLI_DONE && !last) {
    *hash = cli_scene_hash(&point.setup);
    cli_setup_notes(&point.setup, sweep->scheme->unused, sweep->scheme->why);
    cli_drive_notes(&sweep->drive, &point.setup);
  }
  return code;
}

int cli_point_check(cli_sweep_t *sweep, uint32_t *hash) {
  const int code = check_end(sweep, false, hash);
  return code == CLI_DONE ? check_end(sweep, true, hash) : code;
}

static double energy_of(const point_t *point) {
  return (double)tf_energy(&point->setup.machine, &point->system.state,
                           point->input.r0);
}

// Follows the motion. steps: to take.
static cli_point_end_t follow(point_t *point, uint64_t steps) {
  const cli_setup_t *setup = &point->setup;
  const double dt = (double)setup->machine.dt;
  tf_report_t report = setup->report;
  tf_input_t input;
  cli_system_begin(&point->system, point->sweep->scheme, setup, &report);
  cli_course_begin(&point->course, &point->system.state, &report);
  point->input = setup->input;
  point->course.energy_at_start = energy_of(point);
  for (uint64_t i = 1; i <= steps; i++) {
    const double t = (double)i * dt;
    if (i % BATCH == 0 && cli_stop_asked()) {
      return CLI_POINT_INTERRUPTED;
    }
    const tf_status_t status =
        cli_drive_take(&point->drive, point->sweep->scheme, setup,
                       &point->system, &input, &report);
    if (status < 0) {
      (void)snprintf(point->reason, REASON_ROOM, "step %llu: %s",
                     (unsigned long long)i, tf_status_name(status));
      point->course.energy = energy_of(point);
      return CLI_POINT_STOPPED;
    }
    point->input = input;
    tf_tally_count(&point->tally, i, status);
    cli_course_see(&point->course, t, &point->system.state, &report);
  }
  point->course.energy = energy_of(point);
  if (cli_tally_code(&point->tally) != CLI_DONE) {
    const tf_tally_t *tally = &point->tally;
    (void)snprintf(point->reason, REASON_ROOM,
                   "%" PRIu64 " steps degraded; %" PRIu64 " coarse; %" PRIu64
                   " stalled; first at t = %.9g s",
                   tally->degraded, tally->coarse, tally->stalled,
                   (double)tally->first * dt);
    return CLI_POINT_FLAGGED;
  }
  return CLI_POINT_DONE;
}

// No field needs quotes, which not every reader of CSV knows.
static void drop_commas(char *text) {
  for (; *text != '\0'; text++) {
    if (*text == ',' || *text == '\n') {
      *text = ';';
    }
  }
}

cli_point_end_t cli_point(const cli_sweep_t *sweep, uint64_t index,
                          char row[CLI_SWEEP_ROW], size_t *length) {
  const cli_args_t *args = sweep->args;
  point_t point = {0};
  uint64_t steps = 0;
  place(&point, sweep, index);
  cli_message_divert(point.reason, REASON_ROOM);
  int code = prepare(&point, &steps);
  code = code == CLI_DONE ? cli_setup_start(&point.setup) : code;
  cli_message_divert(NULL, 0);
  const cli_point_end_t end =
      code == CLI_DONE ? follow(&point, steps) : CLI_POINT_REFUSED;
  if (end == CLI_POINT_INTERRUPTED) {
    return end;
  }
  drop_commas(point.reason);
  cli_buffer_t text = {row, 0, CLI_SWEEP_ROW, false};
  cli_point_name(args, index, &text);
  cli_add_form(&text, ",%s,%s,", cli_point_status(end), point.reason);
  if (end != CLI_POINT_REFUSED) {
    cli_add_real(&text, (tf_real_t)point.course.t);
  }
  for (size_t i = 0; i < args->measures; i++) {
    cli_add(&text, ",");
    if (end != CLI_POINT_REFUSED) {
      cli_measure_add((cli_measure_t)args->measure[i], &point.course, &text);
    }
  }
  cli_add(&text, "\n");
  *length = text.used;
  return end;
}
