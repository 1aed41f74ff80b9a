// The command `sweep`. It takes one core; several cores take a shard each
// (tools/study/shards). A point whose machine is refused is an answer and no
// failure: its row says so, and the program ends with code 0.

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../host/host.h"
#include "../host/sheet.h"
#include "../text/summary.h"
#include "../text/text.h"
#include "point.h"

#define FLUSH_EVERY 0.2 // [s], so at most so much work is lost by a kill

typedef struct {
  cli_sweep_t sweep;
  cli_sheets_t *sheets;
  uint64_t first, points; ///< of this shard
  uint64_t kept;          ///< rows that were there before
  cli_done_t work;        ///< points with a row, in this call or before
  uint64_t ends[CLI_POINT_ENDS];
  cli_progress_t progress;
} work_t;

// Returns: whether the rows of so many points could be written.
static bool write_rows(work_t *work, uint64_t index, size_t count) {
  char row[CLI_SWEEP_ROW];
  size_t length = 0;
  cli_sheet_t *sheet = work->sheets->sheet;
  for (size_t i = 0; i < count; i++) {
    work->ends[cli_point_row(index, i, row, &length)]++;
    work->work.done++;
    if (!cli_sheet_put(sheet, row, length)) {
      return false;
    }
  }
  return cli_now() - sheet->output.flushed < FLUSH_EVERY ||
         cli_sheets_note(work->sheets, &work->work);
}

// Returns: CLI_DONE, or CLI_STOPPED; where the output failed, the message is
// that of cli_sheets_close.
static int do_points(work_t *work) {
  while (work->work.done < work->points) {
    const uint64_t left = work->points - work->work.done;
    const uint64_t index = work->first + work->work.done;
    const size_t count =
        left < work->sweep.together ? (size_t)left : work->sweep.together;
    if (cli_stop_asked() || !cli_points_follow(&work->sweep, index, count)) {
      return cli_message(CLI_STOPPED, "interrupted at point %" PRIu64, index);
    }
    if (!write_rows(work, index, count)) {
      return CLI_STOPPED;
    }
    const double now = cli_now();
    const double done = (double)(work->work.done - work->kept);
    cli_progress_say(
        &work->progress, now, done / (double)(work->points - work->kept),
        "%" PRIu64 " of %" PRIu64 " points, %.3g points/s", work->work.done,
        work->points, done / (now - work->progress.started));
  }
  return CLI_DONE;
}

static void summarise(const work_t *work, double seconds) {
  const char *separator = "\nstatus     ";
  const double done = (double)(work->work.done - work->kept);
  cli_say("points     %" PRIu64 " of %" PRIu64, work->work.done, work->points);
  if (work->kept > 0) {
    cli_say(", of which %" PRIu64 " were there", work->kept);
  }
  for (int i = 0; i < CLI_POINT_ENDS; i++) {
    if (work->ends[i] > 0) {
      cli_say("%s%s %" PRIu64, separator, cli_point_status((cli_point_end_t)i),
              work->ends[i]);
      separator = ", ";
    }
  }
  cli_say("\ncost       %.3g s, %.3g points/s, %s\n", seconds,
          seconds > 0 ? done / seconds : 0.0,
          work->sweep.together > 1 ? "in lanes of an ensemble" : "one by one");
}

static void summarise_json(const work_t *work, double seconds, int code) {
  cli_put_begin("sweep");
  cli_put_word("scene", work->sweep.args->scene->name);
  cli_put_word("scheme", motion_scheme_name(work->sweep.scheme));
  cli_put_count("points", work->points);
  cli_put_count("kept", work->kept);
  for (int i = 0; i < CLI_POINT_ENDS; i++) {
    cli_put_count(cli_point_status((cli_point_end_t)i), work->ends[i]);
  }
  cli_put_count("together", work->sweep.together);
  cli_put_end(seconds, code);
}

// What the rows of all shards follow from: program, scene, options. newline:
// what stands between these.
static void add_about(const cli_sweep_t *sweep, const char *newline,
                      cli_buffer_t *text) {
  const cli_args_t *args = sweep->args;
  cli_add_form(text, "twofold %s, commit %s, numbers are %s%sscene %s, hash ",
               TF_VERSION, cli_commit, CLI_NUMBER_TYPE, newline,
               args->scene->name);
  cli_add_hash(text, sweep->hash);
  cli_add_form(text, "%ssweep %s --scheme %s --t-end %g", newline,
               args->scene->name, motion_scheme_name(sweep->scheme),
               (double)cli_end_of(args));
  if (args->select != NULL) {
    cli_add_form(text, " --select %s", args->select);
  }
  if (args->drive.inputs != NULL) {
    cli_add_form(text, " --inputs %s --between %s (", args->drive.inputs,
                 args->drive.between == 1 ? "linear" : "held");
    cli_add_hash(text, cli_inputs_hash(&sweep->drive.table));
    cli_add(text, ")");
  }
  for (size_t i = 0; i < args->settings.count; i++) {
    const cli_setting_t *setting = &args->settings.list[i];
    if (strcmp(setting->option, "--over") != 0) {
      cli_add_form(text, " %s %s", setting->option, setting->text);
    }
  }
  for (size_t i = 0; i < args->axes; i++) {
    cli_add_form(text, " --over %s", args->axis[i].range.text);
  }
  for (size_t i = 0; i < args->measures; i++) {
    cli_add_form(text, " --outcome %s", cli_measures[args->measure[i]].name);
  }
}

static void add_provenance(const cli_sweep_t *sweep, cli_buffer_t *text) {
  const cli_args_t *args = sweep->args;
  cli_add(text, "# ");
  add_about(sweep, "\n# ", text);
  cli_add(text, "\n# units:");
  for (size_t i = 0; i < args->axes; i++) {
    const size_t number = cli_number_index(args->axis[i].name);
    cli_add_form(text, " %s %s,", args->axis[i].name,
                 number < CLI_NUMBERS ? cli_number(number)->unit : "1");
  }
  for (size_t i = 0; i < args->measures; i++) {
    const cli_measure_info_t *info = &cli_measures[args->measure[i]];
    if (info->unit[0] != '\0') {
      cli_add_form(text, " %s %s,", info->name, info->unit);
    }
  }
  cli_add(text, " t s\n");
}

static void add_header(const cli_args_t *args, cli_buffer_t *text) {
  cli_add(text, "point");
  for (size_t i = 0; i < args->axes; i++) {
    cli_add_form(text, ",%s", args->axis[i].name);
  }
  cli_add(text, ",status,reason,t");
  for (size_t i = 0; i < args->measures; i++) {
    cli_add_form(text, ",%s", cli_measures[args->measure[i]].name);
  }
  cli_add(text, "\n");
}

// The shards of a sweep have header and comments once, so that their files, one
// after the other, are the file of the whole.
static int open_sheet(work_t *work, bool *whole) {
  const cli_args_t *args = work->sweep.args;
  cli_sheets_t *sheets = work->sheets;
  cli_buffer_t begin = {sheets->sheet->begin, 0, CLI_SHEET_BEGIN, false};
  cli_buffer_t about = {sheets->about, 0, CLI_SHEET_ABOUT, false};
  uint64_t end = 0;
  cli_shard_range(&args->shard, args->points, &work->first, &end);
  work->points = end - work->first;
  if (args->shard.index == 1 && args->provenance) {
    add_provenance(&work->sweep, &begin);
  }
  if (args->shard.index == 1) {
    add_header(args, &begin);
  }
  add_about(&work->sweep, "; ", &about);
  cli_add_form(&about, "; shard %" PRIu64 "/%" PRIu64, args->shard.index,
               args->shard.of);
  if (begin.truncated || about.truncated) {
    return cli_message(CLI_USAGE, "sweep: the command line is too long");
  }
  sheets->what = "sweep";
  sheets->resume = args->resume;
  sheets->noted = true;
  sheets->sheet->option = "--out";
  sheets->sheet->path = args->out != NULL ? args->out : "-";
  CLI_TRY(cli_sheets_open(sheets, work->points, &work->work, whole));
  work->kept = work->work.done;
  return CLI_DONE;
}

static int perform(work_t *work) {
  const cli_args_t *args = work->sweep.args;
  const cli_output_t *output = &work->sheets->sheet->output;
  bool whole = false;
  CLI_TRY(open_sheet(work, &whole));
  if (whole) {
    (void)cli_message(CLI_DONE, "%s has all of its %" PRIu64 " points",
                      args->out, work->kept);
    if (args->summary != 0) {
      summarise_json(work, 0, CLI_DONE);
    }
    return CLI_DONE;
  }
  work->progress = cli_progress_start(cli_now(), output->to.descriptor);
  int code = do_points(work);
  cli_progress_clear(&work->progress);
  if (!cli_sheets_note(work->sheets, &work->work)) {
    code = CLI_STOPPED;
  }
  code = cli_sheets_close(work->sheets, code);
  const double seconds = cli_now() - work->progress.started;
  if (args->summary == 0) {
    summarise(work, seconds);
  }
  if (code != CLI_DONE && output->to.left) {
    (void)cli_message(code, "the same command with --resume goes on");
  }
  if (args->summary != 0) {
    summarise_json(work, seconds, code);
  }
  return code;
}

int cli_sweep(const cli_args_t *args) {
  static cli_sheets_t sheets;
  work_t work = {.sweep = {.args = args, .scheme = MOTION_SCHEMES},
                 .sheets = &sheets};
  int code = cli_drive_read(&work.sweep.drive, args->scene, &args->drive);
  code = code == CLI_DONE ? cli_point_check(&work.sweep) : code;
  code = code == CLI_DONE ? perform(&work) : code;
  cli_drive_free(&work.sweep.drive);
  return code;
}

// What is swept and what is found. An axis is a setting whose value changes
// from point to point, so it stands among the settings: a name that is both
// swept and set is refused like one that is set twice.

#define MAX_VALUES 1000000u            // of one axis
#define MAX_POINTS 1000000000000000ull // exact in a double

// The seed is a number of rule random, not a real parameter of the machine.
static int check_seed(const cli_args_t *args, const cli_range_t *range) {
  for (size_t i = 0; i < args->axes; i++) {
    if (args->axis[i].is_seed) {
      return cli_message(CLI_USAGE,
                         "--over %s: seed was already given by --over %s",
                         range->text, args->axis[i].range.text);
    }
  }
  for (uint64_t i = 0; i < range->count; i++) {
    const double value = cli_range_at(range, i);
    if (!(value >= 0 && value <= UINT32_MAX && floor(value) >= value)) {
      return cli_message(CLI_REFUSED,
                         "--over %s: seed must be whole numbers in "
                         "[0, 4294967295]; value %" PRIu64 " is %.10g",
                         range->text, i + 1, value);
    }
  }
  return CLI_DONE;
}

int cli_read_over(cli_args_t *args, const cli_given_t *option) {
  const char *text = option->value, *equals = strchr(text, '=');
  cli_axis_t *axis = &args->axis[args->axes];
  if (equals == NULL || equals == text) {
    return cli_message(CLI_USAGE, "--over %s: expected NAME=A:B:N", text);
  }
  if (args->axes == CLI_AXES) {
    return cli_message(CLI_USAGE, "--over %s: more than %d axes", text,
                       CLI_AXES);
  }
  axis->is_seed = strncmp(text, "seed=", 5) == 0;
  CLI_TRY(cli_read_range(option->name, text, equals + 1, MAX_VALUES,
                         axis->is_seed, &axis->range));
  if (axis->is_seed) {
    axis->name = "seed";
    CLI_TRY(check_seed(args, &axis->range));
  } else {
    axis->setting = args->settings.count;
    axis->name = args->settings.list[axis->setting].name;
    CLI_TRY(cli_settings_add(&args->settings, option->name, text));
  }
  if (args->points > MAX_POINTS / axis->range.count) {
    return cli_message(CLI_REFUSED, "--over %s: more than %llu points", text,
                       MAX_POINTS);
  }
  args->points *= axis->range.count;
  args->axes++;
  return CLI_DONE;
}

static int add_measure(cli_args_t *args, const char *name, const char *text) {
  cli_closest_t closest = cli_closest_to(name);
  const unsigned found = (unsigned)cli_closest_find(
      &closest, cli_measures, CLI_MEASURES, sizeof cli_measures[0]);
  if (found == CLI_MEASURES) {
    return cli_message(CLI_USAGE,
                       "--outcome %s: unknown outcome '%s'%s ('twofold help "
                       "sweep' lists them)",
                       text, name, closest.hint);
  }
  for (size_t i = 0; i < args->measures; i++) {
    if (args->measure[i] == found) {
      return cli_message(CLI_USAGE, "--outcome %s: %s was already given", text,
                         name);
    }
  }
  args->measure[args->measures++] = found;
  return CLI_DONE;
}

int cli_read_outcome(cli_args_t *args, const cli_given_t *option) {
  const char *at = option->value;
  do {
    char name[32];
    const size_t length = strcspn(at, ",");
    (void)snprintf(name, sizeof name, "%.*s", (int)length, at);
    CLI_TRY(add_measure(args, name, option->value));
    at += length;
  } while (*at++ == ',');
  return CLI_DONE;
}

int cli_sweep_check(cli_args_t *args) {
  static const cli_given_t usual = {"--outcome",
                                    "modes,rest,recurrence,energy,ambiguous"};
  if (args->axes == 0) {
    return cli_message(CLI_USAGE, "sweep: --over NAME=A:B:N is missing");
  }
  if (args->resume && (args->out == NULL || strcmp(args->out, "-") == 0)) {
    return cli_message(CLI_USAGE, "--resume: only with --out FILE");
  }
  for (size_t i = 0; i < args->axes; i++) {
    if (args->axis[i].is_seed &&
        (args->select == NULL || strcmp(args->select, "random") != 0)) {
      return cli_message(CLI_USAGE, "--over %s: only with --select random",
                         args->axis[i].range.text);
    }
  }
  return args->measures > 0 ? CLI_DONE : cli_read_outcome(args, &usual);
}
