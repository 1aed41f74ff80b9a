// The command `diverge`: many motions from the same state, sample by sample.
// Each goes through a number of cycles from the two-fold to the two-fold. The
// rows of a cycle are written when it has ended, so that whatever ends the
// program leaves complete cycles. Memory is that of a single sample.

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../host/host.h"
#include "../text/message.h"
#include "../text/summary.h"
#include "files.h"
#include "motion.h"

#define FLUSH_EVERY 0.5      // [s]
#define BATCH 4096           // steps between two checks for a signal
#define CHECKPOINT_EVERY 1.0 // [s], under --resume

static const cli_stepper_t *const steppers[CLI_MECHANISMS] = {
    [CLI_BY_RANDOM] = &cli_random_stepper,
    [CLI_BY_NOISE] = &cli_noise_stepper,
    [CLI_BY_SMOOTHING] = &cli_smoothing_stepper,
    [CLI_BY_HYSTERESIS] = &cli_lagged_stepper,
    [CLI_BY_DELAY] = &cli_lagged_stepper,
};

typedef struct {
  const cli_job_t *job;
  cli_files_t *files;
  cli_motion_t motion;
  uint64_t first, last; ///< samples of this shard
  cli_checkpoint_t at;  ///< what has ended
  uint64_t in_sample;   ///< cycles of the present one that have ended
  uint64_t kept;        ///< cycles of the run that was stopped
  double flushed, saved;
  cli_progress_t progress;
  bool stopped, unwritten;
} work_t;

static void show_progress(work_t *work, double now) {
  const double samples = (double)(work->last - work->first);
  const double share =
      ((double)work->at.samples +
       (double)work->in_sample / (double)work->job->args->cycles) /
      samples;
  cli_progress_say(
      &work->progress, now, share,
      "%" PRIu64 " of %.0f samples, %" PRIu64 " cycles, %" PRIu64
      " returned, %.3g cycles/s",
      work->at.samples, samples, work->at.cycles,
      work->at.outcomes[CLI_CYCLE_RETURNED],
      (double)(work->at.cycles - work->kept) / (now - work->progress.started));
}

static void check_clock(work_t *work) {
  const double now = cli_now();
  if (cli_stop_asked()) {
    work->stopped = true;
  }
  show_progress(work, now);
  if (now - work->flushed > FLUSH_EVERY) {
    work->unwritten = !cli_files_flush(work->files) || work->unwritten;
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
  const cli_stepper_t *stepper = steppers[job->args->mechanism];
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
  if (job->args->mechanism != CLI_BY_RANDOM) {
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
    work->unwritten |=
        !cli_files_put(work->files, sample, cycle, &motion->tracker.cycle);
    work->at.cycles++;
    work->at.outcomes[outcome]++;
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
  cli_say("samples    %" PRIu64 " of %" PRIu64 ", by %s\ncycles     %" PRIu64,
          work->at.samples, work->last - work->first,
          cli_mechanisms[work->job->args->mechanism].name, work->at.cycles);
  for (int i = 1; i < CLI_OUTCOMES; i++) {
    if (work->at.outcomes[i] > 0) {
      cli_say(", %s %" PRIu64, cli_outcome_name((cli_outcome_t)i),
              work->at.outcomes[i]);
    }
  }
  const uint64_t cycles = work->at.cycles - work->kept;
  cli_say("\ncost       %.3g s, %.3g ms a cycle\n", seconds,
          cycles > 0 ? 1e3 * seconds / (double)cycles : 0.0);
}

// The same for a program: one line, the last one on standard error.
static void summarise_json(const work_t *work, double seconds, int code) {
  const cli_args_t *args = work->job->args;
  cli_put_begin("diverge");
  cli_put_word("scene", args->scene->name);
  cli_put_word("by", cli_mechanisms[args->mechanism].name);
  cli_put_count("seed", args->seed);
  cli_put_count("samples", work->last - work->first);
  cli_put_count("done", work->at.samples);
  cli_put_count("cycles", work->at.cycles);
  for (int i = 1; i < CLI_OUTCOMES; i++) {
    cli_put_count(cli_outcome_name((cli_outcome_t)i), work->at.outcomes[i]);
  }
  cli_put_end(seconds, code);
}

// Under --resume, after a sample.
static void save(work_t *work) {
  if (!work->job->args->resume || cli_now() - work->saved < CHECKPOINT_EVERY) {
    return;
  }
  work->saved = cli_now();
  work->unwritten |= !cli_files_flush(work->files) ||
                     !cli_checkpoint_put(work->files, &work->at);
}

// Where the shard begins: behind what --resume finds.
static cli_resume_t find_place(work_t *work) {
  const cli_args_t *args = work->job->args;
  char text[CLI_JOB_TEXT];
  cli_buffer_t run = {text, 0, sizeof text, false};
  cli_job_describe(work->job, &run);
  work->files->run = work->at.run = cli_crc(0, run.text, run.used);
  work->at.build = cli_crc(0, cli_commit, strlen(cli_commit));
  work->at.shard = args->shard;
  cli_shard_range(&args->shard, args->samples, &work->first, &work->last);
  const cli_resume_t found = args->resume
                                 ? cli_checkpoint_find(work->files, &work->at)
                                 : CLI_RESUME_NEW;
  work->kept = work->at.cycles;
  return found;
}

static int perform(work_t *work, const cli_args_t *args) {
  const cli_resume_t found = find_place(work);
  if (found == CLI_RESUME_OTHER) {
    return CLI_REFUSED;
  }
  if (found == CLI_RESUME_WHOLE) {
    cli_checkpoint_remove(work->files);
    return cli_message(CLI_DONE, "all of the %" PRIu64 " samples are there",
                       work->last - work->first);
  }
  CLI_TRY(cli_files_open(work->files, work->at.at));
  work->flushed = work->saved = cli_now();
  work->progress = cli_progress_start(work->flushed, -1);
  for (uint64_t i = work->first + work->at.samples;
       i < work->last && !work->stopped && !work->unwritten; i++) {
    if (!do_sample(work, i)) {
      break;
    }
    work->at.samples++;
    work->in_sample = 0;
    save(work);
  }
  // Where the output failed, the message is that of cli_files_close.
  const bool ended = !work->unwritten && !work->stopped;
  const int code = cli_files_close(work->files, ended ? CLI_DONE : CLI_STOPPED);
  if (args->resume && code == CLI_DONE) {
    cli_checkpoint_remove(work->files);
  }
  const double seconds = cli_now() - work->progress.started;
  cli_progress_clear(&work->progress);
  if (args->summary == 0) {
    summarise(work, seconds);
  }
  if (work->stopped) {
    (void)cli_message(CLI_STOPPED,
                      "stopped by a signal after %" PRIu64
                      " samples; what has ended is written",
                      work->at.samples);
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

static int check_files(cli_args_t *args) {
  if (args->exits == NULL && args->returns == NULL && args->counts == NULL) {
    args->returns = "-";
  }
  if (args->resume &&
      (args->exhaustive || is_standard(args->exits) ||
       is_standard(args->returns) || is_standard(args->counts))) {
    return cli_message(CLI_USAGE,
                       "--resume: only with --exits, --returns or "
                       "--counts to files");
  }
  if (args->counts != NULL && args->cycles > CLI_COUNT_CYCLES) {
    return cli_message(CLI_REFUSED, "--counts: at most --cycles %d",
                       CLI_COUNT_CYCLES);
  }
  if (args->counts != NULL && args->shard.of > CLI_COUNT_SHARDS) {
    return cli_message(CLI_REFUSED, "--counts: at most %d shards",
                       CLI_COUNT_SHARDS);
  }
  return CLI_DONE;
}

int cli_diverge_check(cli_args_t *args) {
  const cli_mechanism_info_t *mechanism = &cli_mechanisms[args->mechanism];
  const bool sized = args->mechanism != CLI_BY_RANDOM;
  if (args->exhaustive &&
      (sized || args->exits != NULL || args->returns != NULL ||
       args->counts != NULL || args->shard.of > 1)) {
    return cli_message(CLI_USAGE,
                       "--exhaustive: writes --branches FILE; it takes no "
                       "--by, --exits, --returns, --counts or --shard");
  }
  if (sized && !(args->size > 0)) {
    return cli_message(CLI_USAGE, "--by %s: give --size VALUE in %s",
                       mechanism->name, mechanism->unit);
  }
  if (!sized && args->size > 0) {
    return cli_message(CLI_USAGE,
                       "--size %g: --by random has a --rate and no size",
                       args->size);
  }
  args->spread = args->spread > 0 ? args->spread : mechanism->spread;
  args->refinement =
      args->refinement > 0 ? args->refinement : mechanism->refinement;
  return check_files(args);
}

int cli_diverge(const cli_args_t *args) {
  static cli_job_t job;
  static work_t work;
  static cli_files_t files;
  CLI_TRY(cli_job_prepare(&job, args));
  if (args->exhaustive) {
    return cli_exhaustive(&job);
  }
  work.job = files.job = &job;
  work.files = &files;
  return perform(&work, args);
}
