// The command `sweep`: point by point, each a motion of its own and one row. It
// takes one core; several cores take a shard each (tools/study/shards). A point whose
// machine is refused is an answer and no failure: its row says so, and the
// program goes on and ends with code 0.

#include "sweep.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "../host/host.h"
#include "../host/progress.h"
#include "../text/commit.h"
#include "../text/json.h"
#include "../text/message.h"
#include "point.h"
#include "sheet.h"

#define FLUSH_EVERY 0.2 // [s], so at most so much work is lost by a kill

typedef struct {
  const cli_args_t *args;
  cli_sweep_t sweep;
  cli_sheet_t *sheet;
  uint64_t done; ///< points of this call
  uint64_t ends[CLI_POINT_ENDS];
  cli_progress_t progress;
} work_t;

static void show_progress(work_t *work, double now) {
  const cli_sheet_t *sheet = work->sheet;
  const uint64_t points = sheet->end - sheet->first;
  const double done = (double)work->done;
  cli_progress_say(&work->progress, now, done / (double)(points - sheet->kept),
                   "%" PRIu64 " of %" PRIu64 " points, %.3g points/s",
                   sheet->kept + work->done, points,
                   done / (now - work->progress.started));
}

// Returns: CLI_DONE, or CLI_STOPPED; where the output failed, the message is
// that of cli_sheet_close.
static int do_points(work_t *work) {
  cli_sheet_t *sheet = work->sheet;
  char row[CLI_SWEEP_ROW];
  for (uint64_t i = sheet->first + sheet->kept; i < sheet->end; i++) {
    size_t length = 0;
    const cli_point_end_t end = cli_stop_asked()
                                    ? CLI_POINT_INTERRUPTED
                                    : cli_point(&work->sweep, i, row, &length);
    if (end == CLI_POINT_INTERRUPTED) {
      return cli_message(CLI_STOPPED, "interrupted at point %" PRIu64, i);
    }
    if (!cli_sheet_put(sheet, row, length)) {
      return CLI_STOPPED;
    }
    work->ends[end]++;
    work->done++;
    const double now = cli_now();
    if (now - sheet->output.flushed >= FLUSH_EVERY &&
        !cli_output_flush(&sheet->output)) {
      return CLI_STOPPED;
    }
    if (cli_progress_due(&work->progress, now)) {
      show_progress(work, now);
    }
  }
  return CLI_DONE;
}

static void summarise(const work_t *work, double seconds) {
  const cli_sheet_t *sheet = work->sheet;
  const char *separator = "";
  (void)fprintf(stderr, "points     %" PRIu64 " of %" PRIu64,
                sheet->kept + work->done, sheet->end - sheet->first);
  if (sheet->kept > 0) {
    (void)fprintf(stderr, ", of which %" PRIu64 " were there", sheet->kept);
  }
  (void)fputs("\nstatus     ", stderr);
  for (int i = 0; i < CLI_POINT_ENDS; i++) {
    if (work->ends[i] > 0) {
      (void)fprintf(stderr, "%s%s %" PRIu64, separator,
                    cli_point_status((cli_point_end_t)i), work->ends[i]);
      separator = ", ";
    }
  }
  (void)fprintf(stderr, "\ncost       %.3g s, %.3g ms a point\n", seconds,
                work->done > 0 ? 1e3 * seconds / (double)work->done : 0.0);
}

// The same for a program: one line, the last one on standard error.
static void summarise_json(const work_t *work, double seconds, int code) {
  const cli_sheet_t *sheet = work->sheet;
  (void)fprintf(stderr,
                "{" CLI_JSON_BUILD
                ", \"command\": \"sweep\", \"scene\": "
                "\"%s\", \"scheme\": \"%s\", \"points\": %" PRIu64
                ", \"kept\": %" PRIu64,
                cli_commit, work->args->scene->name, work->sweep.scheme->name,
                sheet->end - sheet->first, sheet->kept);
  for (int i = 0; i < CLI_POINT_ENDS; i++) {
    (void)fprintf(stderr, ", \"%s\": %" PRIu64,
                  cli_point_status((cli_point_end_t)i), work->ends[i]);
  }
  (void)fprintf(stderr, ", \"seconds\": %.9g, ", seconds);
  cli_put_exit(code);
}

static int perform(work_t *work, uint32_t hash) {
  cli_sheet_t *sheet = work->sheet;
  int code = cli_sheet_open(sheet, &work->sweep, hash);
  if (code != CLI_DONE) {
    return code;
  }
  if (sheet->whole) {
    (void)cli_message(CLI_DONE, "%s has all of its %" PRIu64 " points",
                      work->args->out, sheet->kept);
    if (work->args->summary != 0) {
      summarise_json(work, 0, CLI_DONE);
    }
    return CLI_DONE;
  }
  work->progress = cli_progress_start(cli_now(), sheet->output.to.descriptor);
  code = do_points(work);
  cli_progress_clear(&work->progress);
  code = cli_sheet_close(sheet, code);
  const double seconds = cli_now() - work->progress.started;
  if (work->args->summary == 0) {
    summarise(work, seconds);
  }
  if (code != CLI_DONE && sheet->output.to.left) {
    (void)cli_message(code, "the same command with --resume goes on");
  }
  if (work->args->summary != 0) {
    summarise_json(work, seconds, code);
  }
  return code;
}

int cli_sweep(const cli_args_t *args) {
  static cli_sheet_t sheet;
  work_t work = {.args = args,
                 .sweep = {args, &cli_schemes[args->scheme], {{0}, {0}}},
                 .sheet = &sheet};
  uint32_t hash = 0;
  int code = cli_drive_read(&work.sweep.drive, args->scene, &args->drive);
  code = code == CLI_DONE ? cli_point_check(&work.sweep, &hash) : code;
  code = code == CLI_DONE ? perform(&work, hash) : code;
  cli_drive_free(&work.sweep.drive);
  return code;
}
