// The command `diverge`: many motions from the same state, sample by sample.
// Each goes through a number of cycles from the two-fold to the two-fold. The
// rows of a cycle are written when it has ended, so that whatever ends the
// program leaves complete cycles. Memory is that of a single sample.

#include "diverge.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../text/summary.h"

#define BATCH 4096 // steps between two checks for a signal

// What all samples share: the machine, its two-fold and the canard through it,
// and the start.

static int refuse_scene(const cli_setup_t *setup) {
  const char *name = setup->scene->name;
  if (setup->scene->knots > 0) {
    return cli_message(CLI_REFUSED,
                       "scene %s: its turntable is driven; diverge needs "
                       "constant inputs",
                       name);
  }
  if (setup->params.law != TF_TYRE_JUMP) {
    return cli_message(CLI_REFUSED,
                       "scene %s: law %s has no two-fold; law jump has", name,
                       tf_tyre_law_name(setup->params.law));
  }
  return CLI_DONE;
}

// A start that was typed must have several consistent modes.
static int prepare_start(cli_job_t *job) {
  cli_setup_t *setup = &job->setup;
  CLI_TRY(cli_setup_start(setup));
  if (setup->motion.report.choices < 2) {
    return cli_message(
        CLI_REFUSED,
        "the start r = %g m, v = %g m/s, omega = %g rad/s has %s future "
        "(%s), nothing diverges there",
        (double)setup->motion.state.r, (double)setup->motion.state.v,
        (double)setup->motion.state.w,
        setup->motion.report.choices == 1 ? "one" : "no",
        tf_mode_name(setup->motion.state.mode));
  }
  return CLI_DONE;
}

static int prepare_two_fold(cli_job_t *job) {
  const bool found = cli_find_two_fold(&job->machine, &job->two_fold);
  if (!found) job->two_fold.r = job->two_fold.g = job->two_fold.v = (double)NAN;
  if (!job->at_two_fold) return CLI_DONE;
  const char *name = job->setup.scene->name;
  if (!found) {
    return cli_message(
        CLI_REFUSED,
        "scene %s: no two-fold that stick runs through, from a sliding into "
        "an escaping region, exists for these parameters; give a start with "
        "--set r=, omega=, h=",
        name);
  }
  const char *why = cli_canard_solve(&job->wide, &job->two_fold, &job->canard);
  if (why != NULL) {
    return cli_message(
        CLI_REFUSED,
        "scene %s: the stick behind the two-fold at r = %g m, omega = %g rad/s "
        "(ratio of eigenvalues %g) was not computed: %s; give a start with "
        "--set r=, omega=, h=",
        name, job->two_fold.r, job->two_fold.omega, job->two_fold.ratio, why);
  }
  return CLI_DONE;
}

static int prepare(cli_job_t *job) {
  const cli_args_t *args = job->args;
  cli_setup_t *setup = &job->setup;
  const bool random = args->mechanism == CLI_BY_RANDOM;
  CLI_TRY(cli_setup_read(setup, args->scene, &args->settings, NULL));
  if (cli_settings_find(&args->settings, "dt") == NULL)
    setup->params.dt = random ? TF_R(5e-2) : TF_R(1e-3);
  CLI_TRY(cli_setup_machine(setup));
  CLI_TRY(refuse_scene(setup));
  tf_params_t params = setup->params;
  params.rule =
      args->codim2 == CLI_CODIM2_ATTRACTING ? TF_RULE_PERSIST : TF_RULE_RANDOM;
  params.rate = 0;
  if (!random) params.tolerance = 0; // as fine as the number type allows
  (void)tf_prepare(&job->machine, &params, NULL);
  job->wide = cli_widen(&job->machine);
  job->near = (double)params.dt / args->refinement;
  job->dwell = random ? 0 : 4 * job->near;
  job->at_two_fold = cli_setup_start_set(setup) == NULL;
  CLI_TRY(job->at_two_fold ? CLI_DONE : prepare_start(job));
  setup->seed = (uint32_t)args->seed;
  return prepare_two_fold(job);
}

// What the rows are of, as the comment lines of --provenance.
static size_t provenance(const cli_job_t *job, const char *units,
                         char out[CLI_PROVENANCE_ROOM]) {
  const cli_args_t *args = job->args;
  const double dt = (double)job->machine.dt;
  char how[CLI_PROVENANCE_ROOM / 4];
  if (args->exhaustive) {
    (void)snprintf(how, sizeof how, "all branches, grid %.9g s", args->grid);
  } else if (args->mechanism == CLI_BY_RANDOM) {
    (void)snprintf(how, sizeof how,
                   "by random, rate %.9g 1/s, dt %.9g s, each wait drawn once",
                   (double)job->setup.params.rate, dt);
  } else {
    (void)snprintf(how, sizeof how,
                   "by noise, size %.9g m/s^1.5, spread %.9g, dt %.9g s",
                   args->size, args->spread, dt);
  }
  return cli_provenance(&job->setup, how, units, out);
}

static const char *const outcomes[CLI_OUTCOMES] = {
    "open", "returned", "small_cycle", "rest", "timeout", "refused"};

// The rows of a cycle. A field of something that did not happen is empty; no
// number stands for "none".

// A comma, and the number if there is one.
static void add_field(cli_buffer_t *text, bool exists, double value) {
  cli_add(text, ",");
  if (exists) cli_add_real(text, (tf_real_t)value);
}

static void add_exit(cli_buffer_t *text, const cli_cycle_t *cycle) {
  const bool in_slip = !isnan(cycle->phase); // at the section
  cli_add_form(text, "%g,%g,%g,%g,%s", cycle->exit_t - cycle->arrived,
               cycle->exit_r, cycle->exit_omega, cycle->exit_g,
               cycle->side < 0 ? "slip-" : "slip+");
  add_field(text, in_slip, cycle->phase);
  cli_add(text, cycle->released ? ",released" : ",left");
  add_field(text, in_slip, cycle->section_t - cycle->arrived);
  cli_add(text, "\n");
}

static void add_return(cli_buffer_t *text, const cli_cycle_t *cycle) {
  cli_add_form(text, "%s,%g,%g", outcomes[cycle->outcome],
               cycle->ended - (cycle->left ? cycle->exit_t : cycle->arrived),
               cycle->arrived);
  add_field(text, cycle->left, cycle->exit_r);
  add_field(text, cycle->landings > 0, cycle->land_t - cycle->exit_t);
  add_field(text, cycle->landings > 0, cycle->land_r);
  cli_add_form(text, ",%" PRIu64 ",%" PRIu64 "\n", cycle->landings,
               cycle->windings);
}

// Files of rows, and what stands in them.
typedef struct {
  const char *option, *header, *units;
  bool leaves; ///< a row only of a cycle that left the surface
  void (*add)(cli_buffer_t *text, const cli_cycle_t *cycle);
} kind_t;

static const kind_t exits = {
    "--exits", "sample,cycle,time,r,omega,g,side,phase,how,section_time\n",
    "time s, r m, omega rad/s, g m/s, phase 1, section_time s", true, add_exit};
static const kind_t returns = {
    "--returns",
    "sample,cycle,outcome,time,arrived,exit_r,landing_time,landing_r,landings,"
    "windings\n",
    "time s, arrived s, exit_r m, landing_time s, landing_r m", false,
    add_return};
static const kind_t branches = {
    "--branches",
    "node,depth,kind,r,omega,mode,stick_time,exit_r,exit_omega,end,to,time,"
    "end_r,landing_r,windings\n",
    "r m, omega rad/s, stick_time s, exit_r m, exit_omega rad/s, time s, "
    "end_r m, landing_r m",
    false, NULL};

typedef struct {
  const cli_job_t *job;
  cli_sheets_t sheets;            ///< done: samples that have ended
  const kind_t *kind[CLI_SHEETS]; ///< of their rows
  cli_motion_t motion;
  uint64_t in_sample; ///< cycles of the present one that have ended
} work_t;

// What is counted beside the samples: each outcome, and all cycles.
enum { CYCLES = CLI_OUTCOMES };

static void write_rows(work_t *work, uint64_t sample, uint64_t number) {
  const cli_cycle_t *cycle = &work->motion.cycle;
  for (int i = 0; i < work->sheets.count; i++) {
    char row[CLI_DIVERGE_ROW];
    cli_buffer_t text = {row, 0, sizeof row, false};
    if (cycle->left || !work->kind[i]->leaves) {
      cli_add_form(&text, "%" PRIu64 ",%" PRIu64 ",", sample, number);
      work->kind[i]->add(&text, cycle);
      (void)cli_sheet_put(&work->sheets.sheet[i], row, text.used);
    }
  }
}

// Cycles that this call has followed.
static double cycles_of(const work_t *work) {
  return (double)(work->sheets.done.count[CYCLES] -
                  work->sheets.kept.count[CYCLES]);
}

// between: no sample is under way. Until the next note, rows go to the system
// cycle by cycle.
// Returns: whether to go on: no stop is asked for, and rows can be written.
static bool check_clock(work_t *work, bool between) {
  cli_sheets_t *sheets = &work->sheets;
  const double now = cli_now();
  const double in_sample =
      (double)work->in_sample / (double)work->job->args->cycles;
  cli_progress_say(
      &sheets->progress, now,
      ((double)sheets->done.done + in_sample) / (double)sheets->total,
      "%" PRIu64 " of %" PRIu64 " samples, %" PRIu64 " cycles, %" PRIu64
      " returned, %.3g cycles/s",
      sheets->done.done, sheets->total, sheets->done.count[CYCLES],
      sheets->done.count[CLI_CYCLE_RETURNED],
      cycles_of(work) / (now - sheets->progress.started));
  return cli_sheets_save(sheets, between) && !cli_stop_asked();
}

// Follows one cycle. Returns: whether it ended.
static bool follow(work_t *work) {
  for (unsigned i = 1; !cli_motion_advance(&work->motion); i++)
    if (i % BATCH == 0 && !check_clock(work, false)) return false;
  return true;
}

static bool do_sample(work_t *work, uint64_t sample) {
  const cli_job_t *job = work->job;
  cli_motion_t *motion = &work->motion;
  cli_motion_begin(motion, job, sample);
  // Under noise it starts before the two-fold, and first arrives.
  const bool arrives = job->at_two_fold && !motion->passes;
  for (uint64_t cycle = arrives ? 0 : 1; follow(work); cycle++) {
    const cli_outcome_t outcome = motion->cycle.outcome;
    if (cycle > 0) {
      write_rows(work, sample, cycle);
      work->sheets.done.count[CYCLES]++;
      work->sheets.done.count[outcome]++;
      work->in_sample = cycle;
      if (outcome != CLI_CYCLE_RETURNED || cycle == job->args->cycles)
        return true;
      if (!check_clock(work, false)) return false;
    }
  }
  return false;
}

static void do_samples(work_t *work) {
  cli_sheets_t *sheets = &work->sheets;
  bool goes_on = true;
  while (goes_on && sheets->done.done < sheets->total &&
         do_sample(work, sheets->first + sheets->done.done)) {
    sheets->done.done++;
    work->in_sample = 0;
    goes_on = check_clock(work, true);
  }
}

static const char *mechanism_of(const work_t *work) {
  return work->job->args->mechanism == CLI_BY_RANDOM ? "random" : "noise";
}

static void summarise(const work_t *work, double seconds) {
  const cli_done_t *done = &work->sheets.done;
  const double cycles = cycles_of(work);
  cli_say("samples    %" PRIu64 " of %" PRIu64 ", by %s\ncycles     %" PRIu64,
          done->done, work->sheets.total, mechanism_of(work),
          done->count[CYCLES]);
  for (int i = 1; i < CLI_OUTCOMES; i++)
    if (done->count[i] > 0)
      cli_say(", %s %" PRIu64, outcomes[i], done->count[i]);
  cli_say("\ncost       %.3g s, %.3g ms a cycle\n", seconds,
          cycles > 0 ? 1e3 * seconds / cycles : 0.0);
}

static void summarise_json(const work_t *work, double seconds, int code) {
  const cli_args_t *args = work->job->args;
  const cli_done_t *done = &work->sheets.done;
  cli_put_begin("diverge");
  cli_put("'scene': %s, 'by': %s, 'seed': %" PRIu64 ", 'samples': %" PRIu64
          ", 'done': %" PRIu64 ", 'cycles': %" PRIu64 ", ",
          args->scene->name, mechanism_of(work), args->seed, work->sheets.total,
          done->done, done->count[CYCLES]);
  for (int i = 1; i < CLI_OUTCOMES; i++)
    cli_put("%s: %" PRIu64 ", ", outcomes[i], done->count[i]);
  cli_put_end(cycles_of(work), seconds, code);
}

// What the rows follow from: program, machine, start and options.
static void describe(work_t *work) {
  const cli_args_t *args = work->job->args;
  const double numbers[] = {args->codim2,           (double)args->samples,
                            (double)args->cycles,   (double)args->shard.index,
                            (double)args->shard.of, args->size,
                            args->spread,           args->patience,
                            args->refinement,       args->fine};
  cli_buffer_t about = {work->sheets.about, 0, CLI_SHEET_ABOUT, false};
  about.used = provenance(work->job, "SI", about.text);
  for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
    cli_add(&about, " ");
    cli_add_number(&about, numbers[i], false);
  }
}

static void add_sheet(work_t *work, const kind_t *kind, const char *path) {
  const cli_args_t *args = work->job->args;
  const int i = work->kind[0] == NULL ? 0 : 1;
  cli_sheet_t *sheet = &work->sheets.sheet[i];
  cli_buffer_t begin = {sheet->begin, 0, sizeof sheet->begin, false};
  if (path == NULL) return;
  work->kind[i] = kind;
  sheet->option = kind->option;
  sheet->path = path;
  if (args->header || args->shard.index == 1) {
    begin.used =
        args->provenance ? provenance(work->job, kind->units, sheet->begin) : 0;
    cli_add(&begin, kind->header);
  }
}

static int follow_samples(work_t *work) {
  const cli_args_t *args = work->job->args;
  cli_sheets_t *sheets = &work->sheets;
  do_samples(work);
  // Where the output failed, the message is that of cli_sheets_close.
  const bool all = sheets->done.done == sheets->total;
  const int code = cli_sheets_close(sheets, all ? CLI_DONE : CLI_STOPPED);
  const double seconds = cli_now() - sheets->progress.started;
  if (args->summary == 0) summarise(work, seconds);
  if (!all && cli_stop_asked()) {
    (void)cli_message(CLI_STOPPED,
                      "stopped by a signal after %" PRIu64
                      " samples; what has ended is written",
                      sheets->done.done);
    if (args->resume) (void)cli_message(CLI_STOPPED, "repeat it to continue");
  }
  if (args->summary != 0) summarise_json(work, seconds, code);
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
  if (sized && !(args->size > 0))
    return cli_message(CLI_USAGE, "--by noise: give --size VALUE in m/s^1.5");
  if (!sized && args->size > 0) {
    return cli_message(CLI_USAGE,
                       "--size %g: --by random has a --rate and no size",
                       args->size);
  }
  if (args->exits == NULL && args->returns == NULL && args->branches == NULL)
    *(args->exhaustive ? &args->branches : &args->returns) = "-";
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
  cli_sheets_t *sheets = &work.sheets;
  job.args = args;
  work.job = &job;
  sheets->what = "run";
  sheets->resume = sheets->noted = args->resume;
  CLI_TRY(prepare(&job));
  describe(&work);
  add_sheet(&work, &exits, args->exits);
  add_sheet(&work, &returns, args->returns);
  add_sheet(&work, &branches, args->branches);
  CLI_TRY(cli_sheets_open(sheets, &args->shard, args->samples));
  if (sheets->whole) {
    return cli_message(CLI_DONE, "all %" PRIu64 " samples are done",
                       sheets->total);
  }
  return args->exhaustive ? cli_exhaustive(&job, sheets)
                          : follow_samples(&work);
}
