// The command `diverge`: many motions from the same state, sample by sample.
// Each goes through a number of cycles from the two-fold to the two-fold. The
// rows of a cycle are written when it has ended, so that whatever ends the
// program leaves complete cycles. Memory is that of a single sample.

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../host/host.h"
#include "../host/sheet.h"
#include "../text/summary.h"
#include "../text/text.h"
#include "motion.h"

#define FLUSH_EVERY 0.5 // [s]
#define BATCH 4096      // steps between two checks for a signal
#define NOTE_EVERY 1.0  // [s], under --resume
#define ROW_ROOM 512

// What is counted beside the samples.
enum { CYCLES = CLI_OUTCOMES }; // behind the outcomes

typedef struct {
  const cli_job_t *job;
  cli_sheets_t sheets;
  cli_motion_t motion;
  uint64_t first, samples; ///< of this shard
  cli_done_t done;         ///< samples that have ended, and their cycles
  uint64_t in_sample;      ///< cycles of the present one that have ended
  uint64_t kept;           ///< cycles of the run that was stopped
  double flushed, noted;
  cli_progress_t progress;
  bool stopped, unwritten;
} work_t;

// The rows of a cycle. A field of something that did not happen is empty; no
// number stands for "none".

enum { EXITS, RETURNS };
static const char exits_header[] =
    "sample,cycle,time,r,omega,g,side,phase,how,section_time\n";
static const char exits_units[] =
    "time s, r m, omega rad/s, g m/s, phase 1, section_time s";
static const char returns_header[] =
    "sample,cycle,outcome,time,arrived,exit_r,landing_time,landing_r,landings,"
    "windings\n";
static const char returns_units[] =
    "time s, arrived s, exit_r m, landing_time s, landing_r m";

// A comma, and the number if there is one.
static void add_field(cli_buffer_t *text, bool exists, double value) {
  cli_add(text, ",");
  if (exists) {
    cli_add_real(text, (tf_real_t)value);
  }
}

static void add_exit(cli_buffer_t *text, const cli_cycle_t *cycle) {
  cli_add_form(text, "%g,%g,%g,%g,%s", cycle->exit_t - cycle->arrived,
               cycle->exit_r, cycle->exit_omega, cycle->exit_g,
               cycle->side < 0 ? "slip-" : "slip+");
  add_field(text, cycle->phase >= 0, cycle->phase);
  cli_add(text, cycle->released ? ",released" : ",left");
  add_field(text, cycle->phase >= 0, cycle->section_t - cycle->arrived);
  cli_add(text, "\n");
}

static void add_return(cli_buffer_t *text, const cli_cycle_t *cycle) {
  cli_add_form(text, "%s,%g,%g", cli_outcome_name(cycle->outcome),
               cycle->ended - (cycle->left ? cycle->exit_t : cycle->arrived),
               cycle->arrived);
  add_field(text, cycle->left, cycle->exit_r);
  add_field(text, cycle->landed, cycle->land_t - cycle->exit_t);
  add_field(text, cycle->landed, cycle->land_r);
  cli_add_form(text, ",%" PRIu64 ",%" PRIu64 "\n", cycle->landings,
               cycle->windings);
}

static bool write_rows(work_t *work, uint64_t sample, uint64_t number) {
  const cli_cycle_t *cycle = &work->motion.tracker.cycle;
  bool written = true;
  for (int i = EXITS; i <= RETURNS; i++) {
    char row[ROW_ROOM];
    cli_buffer_t text = {row, 0, sizeof row, false};
    cli_add_form(&text, "%" PRIu64 ",%" PRIu64 ",", sample, number);
    (i == EXITS ? add_exit : add_return)(&text, cycle);
    if (i == RETURNS || cycle->left) {
      written &= cli_sheet_put(&work->sheets.sheet[i], row, text.used);
    }
  }
  return written;
}

static void show_progress(work_t *work, double now) {
  const uint64_t *count = work->done.count;
  const double share =
      ((double)work->done.done +
       (double)work->in_sample / (double)work->job->args->cycles) /
      (double)work->samples;
  cli_progress_say(
      &work->progress, now, share,
      "%" PRIu64 " of %" PRIu64 " samples, %" PRIu64 " cycles, %" PRIu64
      " returned, %.3g cycles/s",
      work->done.done, work->samples, count[CYCLES], count[CLI_CYCLE_RETURNED],
      (double)(count[CYCLES] - work->kept) / (now - work->progress.started));
}

static void check_clock(work_t *work) {
  const double now = cli_now();
  if (cli_stop_asked()) {
    work->stopped = true;
  }
  show_progress(work, now);
  if (now - work->flushed > FLUSH_EVERY) {
    work->unwritten |= !cli_sheets_flush(&work->sheets);
    work->flushed = now;
  }
}

// Follows one cycle. from_it: it starts at the two-fold.
// Returns: whether it ended; otherwise a signal has asked for a stop.
static bool follow(work_t *work, const cli_stepper_t *stepper, bool from_it) {
  bool ended = from_it && stepper->pass != NULL && stepper->pass(&work->motion);
  for (int i = 1; !ended; i++) {
    if (i % BATCH == 0) {
      check_clock(work);
      if (work->stopped) {
        return false;
      }
    }
    ended = stepper->advance(&work->motion);
  }
  return true;
}

static bool do_sample(work_t *work, uint64_t sample) {
  const cli_job_t *job = work->job;
  const bool random = job->args->mechanism == CLI_BY_RANDOM;
  const cli_stepper_t *stepper =
      random ? &cli_random_stepper : &cli_noise_stepper;
  cli_motion_t *motion = &work->motion;
  motion->job = job;
  motion->tracker = (cli_tracker_t){.job = job};
  motion->draws.seed = (uint32_t)job->args->seed;
  motion->draws.sample = (uint32_t)sample;
  motion->draws.used = 0;
  motion->size = job->args->size;
  if (job->args->spread > 1) {
    motion->size *= pow(job->args->spread, -cli_draw_uniform(&motion->draws));
  }
  const cli_instant_t start = stepper->start(motion);
  cli_track_start(&motion->tracker, &start);
  // Time within the band that counts as on the surface; random motions have
  // modes and need none.
  if (!random) {
    motion->tracker.dwell = 4 * job->near;
  }
  // Without `pass` the sample starts before the two-fold and first arrives.
  bool from_it = job->at_two_fold && stepper->pass != NULL;
  if (job->at_two_fold && !from_it) {
    if (!follow(work, stepper, false)) {
      return false;
    }
    if (motion->tracker.cycle.outcome == CLI_CYCLE_RETURNED) {
      cli_track_next(&motion->tracker);
    }
  }
  for (uint64_t cycle = 1; cycle <= job->args->cycles; cycle++) {
    work->in_sample = cycle - 1;
    if (!follow(work, stepper, from_it)) {
      return false;
    }
    const cli_outcome_t outcome = motion->tracker.cycle.outcome;
    work->unwritten |= !write_rows(work, sample, cycle);
    work->done.count[CYCLES]++;
    work->done.count[outcome]++;
    check_clock(work);
    if (outcome != CLI_CYCLE_RETURNED) {
      break;
    }
    if (work->stopped || work->unwritten) {
      return false;
    }
    cli_track_next(&motion->tracker);
    from_it = true;
  }
  return true;
}

static void summarise(const work_t *work, double seconds) {
  const uint64_t *count = work->done.count;
  cli_say("samples    %" PRIu64 " of %" PRIu64 ", by %s\ncycles     %" PRIu64,
          work->done.done, work->samples,
          cli_mechanisms[work->job->args->mechanism], count[CYCLES]);
  for (int i = 1; i < CLI_OUTCOMES; i++) {
    if (count[i] > 0) {
      cli_say(", %s %" PRIu64, cli_outcome_name((cli_outcome_t)i), count[i]);
    }
  }
  const uint64_t cycles = count[CYCLES] - work->kept;
  cli_say("\ncost       %.3g s, %.3g ms a cycle\n", seconds,
          cycles > 0 ? 1e3 * seconds / (double)cycles : 0.0);
}

// The same for a program: one line, the last one on standard error.
static void summarise_json(const work_t *work, double seconds, int code) {
  const cli_args_t *args = work->job->args;
  cli_put_begin("diverge");
  cli_put_word("scene", args->scene->name);
  cli_put_word("by", cli_mechanisms[args->mechanism]);
  cli_put_count("seed", args->seed);
  cli_put_count("samples", work->samples);
  cli_put_count("done", work->done.done);
  cli_put_count("cycles", work->done.count[CYCLES]);
  for (int i = 1; i < CLI_OUTCOMES; i++) {
    cli_put_count(cli_outcome_name((cli_outcome_t)i), work->done.count[i]);
  }
  cli_put_end(seconds, code);
}

static void describe_sheet(work_t *work, int i, const char *option,
                           const char *path, const char *header,
                           const char *units) {
  const cli_args_t *args = work->job->args;
  cli_sheet_t *sheet = &work->sheets.sheet[i];
  sheet->option = option;
  sheet->path = path;
  if (!args->header && args->shard.index != 1) {
    return;
  }
  size_t used = 0;
  if (args->provenance) {
    used = cli_job_provenance(work->job, units, sheet->begin);
  }
  (void)snprintf(sheet->begin + used, sizeof sheet->begin - used, "%s", header);
}

static int open_sheets(work_t *work, bool *whole) {
  const cli_args_t *args = work->job->args;
  cli_sheets_t *sheets = &work->sheets;
  cli_buffer_t about = {sheets->about, 0, sizeof sheets->about, false};
  uint64_t end = 0;
  cli_shard_range(&args->shard, args->samples, &work->first, &end);
  work->samples = end - work->first;
  sheets->what = "run";
  sheets->resume = sheets->noted = args->resume;
  cli_job_describe(work->job, &about);
  describe_sheet(work, EXITS, "--exits", args->exits, exits_header,
                 exits_units);
  describe_sheet(work, RETURNS, "--returns", args->returns, returns_header,
                 returns_units);
  CLI_TRY(cli_sheets_open(sheets, work->samples, &work->done, whole));
  work->kept = work->done.count[CYCLES];
  return CLI_DONE;
}

static void do_samples(work_t *work) {
  work->flushed = work->noted = cli_now();
  work->progress = cli_progress_start(work->flushed, -1);
  while (work->done.done < work->samples && !work->stopped &&
         !work->unwritten && do_sample(work, work->first + work->done.done)) {
    work->done.done++;
    work->in_sample = 0;
    if (cli_now() - work->noted >= NOTE_EVERY) {
      work->noted = cli_now();
      work->unwritten |= !cli_sheets_note(&work->sheets, &work->done);
    }
  }
  if (work->done.done == work->samples) {
    work->unwritten |= !cli_sheets_note(&work->sheets, &work->done);
  }
}

static int perform(work_t *work, const cli_args_t *args) {
  bool whole = false;
  CLI_TRY(open_sheets(work, &whole));
  if (whole) {
    return cli_message(CLI_DONE, "all of the %" PRIu64 " samples are there",
                       work->samples);
  }
  do_samples(work);
  // Where the output failed, the message is that of cli_sheets_close.
  const int code = cli_sheets_close(
      &work->sheets, work->unwritten || work->stopped ? CLI_STOPPED : CLI_DONE);
  const double seconds = cli_now() - work->progress.started;
  cli_progress_clear(&work->progress);
  if (args->summary == 0) {
    summarise(work, seconds);
  }
  if (work->stopped) {
    (void)cli_message(CLI_STOPPED,
                      "stopped by a signal after %" PRIu64
                      " samples; what has ended is written",
                      work->done.done);
    if (args->resume) {
      (void)cli_message(CLI_STOPPED, "the same command goes on");
    }
  }
  if (args->summary != 0) {
    summarise_json(work, seconds, code);
  }
  return code;
}

static bool is_standard(const char *path) {
  return path != NULL && strcmp(path, "-") == 0;
}

int cli_diverge_check(cli_args_t *args) {
  const bool sized = args->mechanism != CLI_BY_RANDOM;
  if (args->exhaustive && (sized || args->exits != NULL ||
                           args->returns != NULL || args->shard.of > 1)) {
    return cli_message(CLI_USAGE,
                       "--exhaustive: writes --branches FILE; it takes no "
                       "--by, --exits, --returns or --shard");
  }
  if (sized && !(args->size > 0)) {
    return cli_message(CLI_USAGE, "--by noise: give --size VALUE in m/s^1.5");
  }
  if (!sized && args->size > 0) {
    return cli_message(CLI_USAGE,
                       "--size %g: --by random has a --rate and no size",
                       args->size);
  }
  if (args->exits == NULL && args->returns == NULL) {
    args->returns = "-";
  }
  if (args->resume && (args->exhaustive || is_standard(args->exits) ||
                       is_standard(args->returns))) {
    return cli_message(CLI_USAGE,
                       "--resume: only with --exits or --returns to files");
  }
  return CLI_DONE;
}

int cli_diverge(const cli_args_t *args) {
  static cli_job_t job;
  static work_t work;
  CLI_TRY(cli_job_prepare(&job, args));
  if (args->exhaustive) {
    return cli_exhaustive(&job);
  }
  work.job = &job;
  return perform(&work, args);
}
