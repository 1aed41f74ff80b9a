// The command `sweep`. It takes one core; several cores take a shard each
// (tools/study/shards). A point whose machine is refused is an answer and no
// failure: its row says so, and the program ends with code 0.

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../host/host.h"
#include "../text/message.h"
#include "../text/number.h"
#include "../text/options.h"
#include "../text/summary.h"
#include "sheet.h"

#define FLUSH_EVERY 0.2 // [s], so at most so much work is lost by a kill

typedef struct {
  cli_sweep_t sweep;
  cli_sheet_t *sheet;
  size_t together; ///< points that are followed at once
  uint64_t done;   ///< points of this call
  uint64_t ends[CLI_POINT_ENDS];
  cli_progress_t progress;
} work_t;

// Returns: CLI_DONE, or CLI_STOPPED; where the output failed, the message is
// that of cli_sheet_close.
static int do_points(work_t *work) {
  cli_sheet_t *sheet = work->sheet;
  char row[CLI_SWEEP_ROW];
  size_t count = 0, length = 0;
  for (uint64_t i = sheet->first + sheet->kept; i < sheet->end; i += count) {
    count = sheet->end - i < work->together ? (size_t)(sheet->end - i)
                                            : work->together;
    if (cli_stop_asked() || !cli_points_follow(&work->sweep, i, count)) {
      return cli_message(CLI_STOPPED, "interrupted at point %" PRIu64, i);
    }
    for (size_t n = 0; n < count; n++) {
      work->ends[cli_point_row(i, n, row, &length)]++;
      work->done++;
      cli_trailer_add(&sheet->trailer, row, length, 1);
      if (!cli_output_lines(&sheet->output, row, length)) {
        return CLI_STOPPED;
      }
    }
    const double now = cli_now();
    if (now - sheet->output.flushed >= FLUSH_EVERY && !cli_sheet_flush(sheet)) {
      return CLI_STOPPED;
    }
    const uint64_t points = sheet->end - sheet->first;
    const double done = (double)work->done;
    cli_progress_say(&work->progress, now,
                     done / (double)(points - sheet->kept),
                     "%" PRIu64 " of %" PRIu64 " points, %.3g points/s",
                     sheet->kept + work->done, points,
                     done / (now - work->progress.started));
  }
  return CLI_DONE;
}

static void summarise(const work_t *work, double seconds) {
  const cli_sheet_t *sheet = work->sheet;
  const char *separator = "\nstatus     ";
  cli_say("points     %" PRIu64 " of %" PRIu64, sheet->kept + work->done,
          sheet->end - sheet->first);
  if (sheet->kept > 0) {
    cli_say(", of which %" PRIu64 " were there", sheet->kept);
  }
  for (int i = 0; i < CLI_POINT_ENDS; i++) {
    if (work->ends[i] > 0) {
      cli_say("%s%s %" PRIu64, separator, cli_point_status((cli_point_end_t)i),
              work->ends[i]);
      separator = ", ";
    }
  }
  cli_say("\ncost       %.3g s, %.3g points/s, %s\n", seconds,
          seconds > 0 ? (double)work->done / seconds : 0.0,
          work->together > 1 ? "in lanes of an ensemble" : "one by one");
}

static void summarise_json(const work_t *work, double seconds, int code) {
  const cli_sheet_t *sheet = work->sheet;
  cli_put_begin("sweep");
  cli_put_word("scene", work->sweep.args->scene->name);
  cli_put_word("scheme", work->sweep.scheme->name);
  cli_put_count("points", sheet->end - sheet->first);
  cli_put_count("kept", sheet->kept);
  for (int i = 0; i < CLI_POINT_ENDS; i++) {
    cli_put_count(cli_point_status((cli_point_end_t)i), work->ends[i]);
  }
  cli_put_count("together", work->together);
  cli_put_end(seconds, code);
}

static int perform(work_t *work, uint32_t hash) {
  cli_sheet_t *sheet = work->sheet;
  CLI_TRY(cli_sheet_open(sheet, &work->sweep, hash));
  if (sheet->whole) {
    (void)cli_message(CLI_DONE, "%s has all of its %" PRIu64 " points",
                      work->sweep.args->out, sheet->kept);
    if (work->sweep.args->summary != 0) {
      summarise_json(work, 0, CLI_DONE);
    }
    return CLI_DONE;
  }
  work->progress = cli_progress_start(cli_now(), sheet->output.to.descriptor);
  int code = do_points(work);
  cli_progress_clear(&work->progress);
  code = cli_sheet_close(sheet, code);
  const double seconds = cli_now() - work->progress.started;
  if (work->sweep.args->summary == 0) {
    summarise(work, seconds);
  }
  if (code != CLI_DONE && sheet->output.to.left) {
    (void)cli_message(code, "the same command with --resume goes on");
  }
  if (work->sweep.args->summary != 0) {
    summarise_json(work, seconds, code);
  }
  return code;
}

int cli_sweep(const cli_args_t *args) {
  static cli_sheet_t sheet;
  work_t work = {.sweep = {.args = args}, .sheet = &sheet};
  uint32_t hash = 0;
  int code = cli_drive_read(&work.sweep.drive, args->scene, &args->drive);
  code = code == CLI_DONE ? cli_point_check(&work.sweep, &hash) : code;
  work.together = cli_points_together(&work.sweep);
  code = code == CLI_DONE ? perform(&work, hash) : code;
  cli_drive_free(&work.sweep.drive);
  return code;
}

// What is swept and what is found. An axis is a setting whose value changes
// from point to point, so it stands among the settings: a name that is both
// swept and set is refused like one that is set twice.

#define MAX_VALUES 1000000u            // of one axis
#define MAX_POINTS 1000000000000000ull // exact in a double

// The seed is a number of rule random, not a real parameter of the machine.
static int add_seed(const cli_args_t *args, cli_axis_t *axis) {
  const char *text = axis->range.text;
  axis->is_seed = true;
  for (size_t i = 0; i < args->axes; i++) {
    if (args->axis[i].is_seed) {
      return cli_message(CLI_USAGE,
                         "--over %s: seed was already given by --over %s", text,
                         args->axis[i].range.text);
    }
  }
  for (uint64_t i = 0; i < axis->range.count; i++) {
    const double value = cli_range_at(&axis->range, i);
    if (!(value >= 0 && value <= UINT32_MAX && floor(value) >= value)) {
      return cli_message(CLI_REFUSED,
                         "--over %s: seed must be whole numbers in "
                         "[0, 4294967295]; value %llu is %.10g",
                         text, (unsigned long long)i + 1, value);
    }
  }
  return CLI_DONE;
}

int cli_read_over(void *to, const cli_given_t *option) {
  cli_args_t *args = to;
  const char *text = option->value;
  const char *equals = strchr(text, '=');
  if (equals == NULL || equals == text) {
    return cli_message(CLI_USAGE, "--over %s: expected NAME=A:B:N", text);
  }
  if (args->axes == CLI_AXES) {
    return cli_message(CLI_USAGE, "--over %s: more than %d axes", text,
                       CLI_AXES);
  }
  cli_axis_t *axis = &args->axis[args->axes];
  const size_t length = (size_t)(equals - text);
  const bool is_seed = length == 4 && strncmp(text, "seed", 4) == 0;
  CLI_TRY(cli_read_range(option->name, text, equals + 1, MAX_VALUES, is_seed,
                         &axis->range));
  if (is_seed) {
    memcpy(axis->name, "seed", 5);
    CLI_TRY(add_seed(args, axis));
  } else {
    axis->setting = args->settings.count;
    CLI_TRY(cli_settings_add(&args->settings, option->name, text));
    memcpy(axis->name, args->settings.list[axis->setting].name,
           sizeof axis->name);
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

int cli_read_outcome(void *to, const cli_given_t *option) {
  cli_args_t *args = to;
  const char *at = option->value;
  for (;;) {
    char name[32];
    const size_t length = strcspn(at, ",");
    (void)snprintf(name, sizeof name, "%.*s", (int)length, at);
    CLI_TRY(add_measure(args, name, option->value));
    if (at[length] == '\0') {
      return CLI_DONE;
    }
    at += length + 1;
  }
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
