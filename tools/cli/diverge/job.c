// From the command line of `diverge` to what all samples share: the machine,
// its two-fold and the canard through it, and the start.

#include "job.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../text/text.h"

#define IN_SLIP 1e-3 // [s], longest step of random motions in slip

const char *const cli_mechanisms[] = {"random", "noise"};

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
  if (setup->report.choices < 2) {
    return cli_message(
        CLI_REFUSED,
        "the start r = %g m, v = %g m/s, omega = %g rad/s has %s future "
        "(%s), nothing diverges there",
        (double)setup->state.r, (double)setup->state.v, (double)setup->state.w,
        setup->report.choices == 1 ? "one" : "no",
        tf_mode_name(setup->state.mode));
  }
  return CLI_DONE;
}

static int prepare_two_fold(cli_job_t *job) {
  const bool found = cli_find_two_fold(&job->machine, &job->two_fold);
  if (!found) {
    job->two_fold.r = job->two_fold.g = job->two_fold.v = (double)NAN;
  }
  if (!job->at_two_fold) {
    return CLI_DONE;
  }
  const char *name = job->setup.scene->name;
  if (!found) {
    return cli_message(
        CLI_REFUSED,
        "scene %s: no two-fold that stick runs through, from a sliding into "
        "an escaping region, exists for these parameters; give a start with "
        "--set r=, omega=, h=",
        name);
  }
  const cli_canard_status_t status =
      cli_canard_solve(&job->machine, &job->two_fold, &job->canard);
  if (status != CLI_CANARD_SOLVED) {
    return cli_message(
        CLI_REFUSED,
        "scene %s: the stick behind the two-fold at r = %g m, omega = %g rad/s "
        "(ratio of eigenvalues %g) was not computed: %s; give a start with "
        "--set r=, omega=, h=",
        name, job->two_fold.r, job->two_fold.omega, job->two_fold.ratio,
        cli_canard_failure(status));
  }
  return CLI_DONE;
}

int cli_job_prepare(cli_job_t *job, const cli_args_t *args) {
  cli_setup_t *setup = &job->setup;
  const bool random = args->mechanism == CLI_BY_RANDOM;
  const double refinement = random ? 10 : 64;
  job->args = args;
  CLI_TRY(cli_setup_read(setup, args->scene, &args->settings, NULL));
  if (cli_settings_find(&args->settings, "dt") == NULL) {
    setup->params.dt = random ? TF_R(1e-2) : TF_R(1e-3);
  }
  CLI_TRY(cli_setup_machine(setup));
  CLI_TRY(refuse_scene(setup));
  job->params = setup->params;
  job->params.rule =
      args->codim2 == CLI_CODIM2_ATTRACTING ? TF_RULE_PERSIST : TF_RULE_RANDOM;
  job->params.rate = 0;
  job->refinement = args->refinement > 0 ? args->refinement : refinement;
  job->near = (double)job->params.dt / job->refinement;
  job->near = random ? fmin(job->near, IN_SLIP) : job->near;
  (void)tf_prepare(&job->machine, &job->params, NULL);
  job->at_two_fold = cli_setup_start_set(setup) == NULL;
  CLI_TRY(job->at_two_fold ? CLI_DONE : prepare_start(job));
  return prepare_two_fold(job);
}

size_t cli_job_provenance(const cli_job_t *job, const char *units,
                          char out[CLI_PROVENANCE_ROOM]) {
  const cli_args_t *args = job->args;
  const double dt = (double)job->params.dt;
  char how[CLI_PROVENANCE_ROOM / 4];
  cli_setup_t told = job->setup;
  told.seed = (uint32_t)args->seed;
  if (args->exhaustive) {
    (void)snprintf(how, sizeof how, "all branches, grid %.9g s", args->grid);
  } else if (args->mechanism == CLI_BY_RANDOM) {
    (void)snprintf(how, sizeof how,
                   "by random, rate %.9g 1/s, dt %.9g s, in slip %.9g s, each "
                   "wait drawn once",
                   (double)job->setup.params.rate, dt, job->near);
  } else {
    (void)snprintf(how, sizeof how,
                   "by noise, size %.9g m/s^1.5, spread %.9g, dt %.9g s",
                   args->size, args->spread, dt);
  }
  return cli_provenance(&told, how, units, out);
}

void cli_job_describe(const cli_job_t *job, cli_buffer_t *text) {
  const cli_args_t *args = job->args;
  const double numbers[] = {args->size, args->spread, args->patience,
                            job->refinement, args->fine};
  char lines[CLI_PROVENANCE_ROOM];
  (void)cli_job_provenance(job, "SI", lines);
  for (char *end = lines; (end = strchr(end, '\n')) != NULL;) {
    *end = ' ';
  }
  cli_add_form(text,
               "%s--codim2 %" PRIu64 " --samples %" PRIu64 " --cycles %" PRIu64
               " --shard %" PRIu64 "/%" PRIu64,
               lines, (uint64_t)args->codim2, args->samples, args->cycles,
               args->shard.index, args->shard.of);
  for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
    cli_add(text, " ");
    cli_add_number(text, numbers[i], false);
  }
}
