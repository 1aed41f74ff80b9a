// The command `diverge`: many futures of one place, sample by sample, each
// through a number of cycles from the two-fold to the two-fold. Rows of a cycle
// are written when it has ended, so that whatever ends the program leaves whole
// cycles; memory is that of one sample.

#include "diverge.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "text.h"

#define FLUSH_EVERY 0.5 // [s]
#define LOG_EVERY 10.0  // [s] between lines where standard error is no terminal
#define BATCH 4096      // steps between two looks at the wish to stop

typedef struct {
  const cli_job_t *job;
  cli_files_t *files;
  cli_mover_t mover;
  cli_tracker_t tracker;
  uint64_t first, last; ///< samples of this shard
  uint64_t done;        ///< samples that have ended
  uint64_t cycles;      ///< cycles that have ended
  uint64_t outcomes[CLI_OUTCOMES];
  double started, shown, flushed;
  bool one_line, stopped, unwritten;
} work_t;

static void show_progress(work_t *work, double now) {
  const double samples = (double)(work->last - work->first);
  (void)fprintf(stderr,
                "%s%.0f of %.0f samples, %" PRIu64 " cycles, %" PRIu64
                " returned, %.3g cycles/s%s",
                work->one_line ? "\r" : "twofold: ", (double)work->done,
                samples, work->cycles, work->outcomes[CLI_CYCLE_RETURNED],
                (double)work->cycles / (now - work->started),
                work->one_line ? "\033[K" : "\n");
  (void)fflush(stderr);
  work->shown = now;
}

static void look_around(work_t *work) {
  const double now = cli_now();
  if (cli_stop_asked()) {
    work->stopped = true;
  }
  if (now - work->shown > (work->one_line ? 0.5 : LOG_EVERY)) {
    show_progress(work, now);
  }
  if (now - work->flushed > FLUSH_EVERY) {
    work->unwritten = !cli_files_flush(work->files) || work->unwritten;
    work->flushed = now;
  }
}

// Follows one cycle to its end; returns whether it got there.
static bool follow(work_t *work, const cli_motion_t *motion, bool from_it) {
  bool ended = from_it && motion->pass != NULL && motion->pass(&work->mover);
  for (int i = 1; !ended; i++) {
    if (i % BATCH == 0) {
      look_around(work);
      if (work->stopped) {
        return false;
      }
    }
    ended = motion->move(&work->mover);
  }
  return true;
}

// So long within the band is on the surface; a stick that is known as such at
// once.
static double least_stay(const cli_mover_t *mover) {
  return mover->job->args->by == CLI_BY_RANDOM
             ? 0
             : 4 * (double)mover->job->stay.dt / mover->job->args->near_ratio;
}

static bool do_sample(work_t *work, uint64_t sample) {
  const cli_job_t *job = work->job;
  const cli_motion_t *motion = cli_kinds[job->args->by].motion;
  cli_mover_t *mover = &work->mover;
  work->tracker = cli_tracker_of(job);
  mover->job = job;
  mover->tracker = &work->tracker;
  mover->draws.seed = job->args->seed;
  mover->draws.sample = (uint32_t)sample;
  mover->draws.used = 0;
  mover->size = job->args->size;
  if (job->args->spread > 1) {
    mover->size *= pow(job->args->spread, -cli_draw_uniform(&mover->draws));
  }
  motion->start(mover);
  work->tracker.stay = least_stay(mover);
  // A motion that starts before the two-fold arrives there first.
  bool from_it = job->at_twofold && motion->pass != NULL;
  if (job->at_twofold && !from_it) {
    if (!follow(work, motion, false)) {
      return false;
    }
    if (work->tracker.cycle.outcome == CLI_CYCLE_RETURNED) {
      cli_track_next(&work->tracker);
    }
  }
  for (uint64_t cycle = 1; cycle <= job->args->cycles; cycle++) {
    if (!follow(work, motion, from_it)) {
      return false;
    }
    const cli_outcome_t outcome = work->tracker.cycle.outcome;
    work->unwritten |=
        !cli_files_put(work->files, sample, cycle, &work->tracker.cycle);
    work->cycles++;
    work->outcomes[outcome]++;
    look_around(work);
    if (outcome != CLI_CYCLE_RETURNED) {
      break;
    }
    if (work->stopped || work->unwritten) {
      return false;
    }
    cli_track_next(&work->tracker);
    from_it = true;
  }
  return true;
}

static void summarise(work_t *work, double now) {
  if (work->one_line) {
    (void)fputs("\r\033[K", stderr);
  }
  (void)fprintf(stderr,
                "samples    %" PRIu64 " of %" PRIu64
                ", by %s\ncycles     "
                "%" PRIu64,
                work->done, work->last - work->first,
                cli_kinds[work->job->args->by].name, work->cycles);
  for (int i = 1; i < CLI_OUTCOMES; i++) {
    if (work->outcomes[i] > 0) {
      (void)fprintf(stderr, ", %s %" PRIu64, cli_outcome_name((cli_outcome_t)i),
                    work->outcomes[i]);
    }
  }
  (void)fprintf(
      stderr, "\ncost       %.3g s, %.3g ms a cycle\n", now - work->started,
      work->cycles > 0 ? 1e3 * (now - work->started) / (double)work->cycles
                       : 0.0);
}

static int perform(work_t *work, const cli_diverge_args_t *args) {
  work->first = args->samples / args->shards * (args->shard - 1);
  const uint64_t rest = args->samples % args->shards;
  work->first += args->shard - 1 < rest ? args->shard - 1 : rest;
  work->last = work->first + args->samples / args->shards +
               (args->shard - 1 < rest ? 1 : 0);
  int code = cli_files_open(work->files, args);
  if (code != CLI_DONE) {
    return code;
  }
  work->one_line = cli_is_terminal(STDERR_FILENO);
  work->started = work->shown = work->flushed = cli_now();
  for (uint64_t i = work->first; i < work->last; i++) {
    if (!do_sample(work, i)) {
      break;
    }
    work->done++;
    if (work->stopped || work->unwritten) {
      break;
    }
  }
  code = cli_files_close(work->files);
  summarise(work, cli_now());
  if (work->stopped && code == CLI_DONE) {
    code = cli_complain(CLI_STOPPED,
                        "stopped by a signal after %" PRIu64
                        " samples; what has ended is written",
                        work->done);
  }
  return code;
}

int cli_diverge(int argc, char *const argv[]) {
  static cli_diverge_args_t args;
  static cli_job_t job;
  int code = cli_diverge_args(&args, argc, argv);
  if (code == CLI_DONE) {
    code = cli_diverge_prepare(&job, &args);
  }
  if (code != CLI_DONE) {
    return code;
  }
  if (args.exhaustive) {
    return cli_diverge_exhaust(&job);
  }
  work_t *work = calloc(1, sizeof *work);
  cli_files_t *files = calloc(1, sizeof *files);
  if (work == NULL || files == NULL) {
    code = cli_complain(CLI_STOPPED, "out of memory");
  } else {
    work->job = &job;
    work->files = files;
    code = perform(work, &args);
  }
  free(files);
  free(work);
  return code;
}
