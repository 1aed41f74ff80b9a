// From the command line of `diverge` to what all samples share: the machine,
// its two-fold and the canard through it, and the start.

#include "job.h"

#include <math.h>

#include "../setup/names.h"
#include "../text/message.h"

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
                       cli_law_name(setup->params.law));
  }
  return CLI_DONE;
}

// A start that was typed must have several consistent modes.
static int prepare_start(cli_job_t *job) {
  cli_setup_t *setup = &job->setup;
  const int code = cli_setup_start(setup);
  if (code == CLI_DONE && setup->report.choices < 2) {
    return cli_message(
        CLI_REFUSED,
        "the start r = %g m, v = %g m/s, omega = %g rad/s has one future "
        "(%s), nothing diverges there",
        (double)setup->state.r, (double)setup->state.v, (double)setup->state.w,
        tf_mode_name(setup->state.mode));
  }
  return code;
}

static int prepare_two_fold(cli_job_t *job) {
  const bool found = cli_find_two_fold(&job->machine, &job->two_fold);
  if (!found) {
    job->two_fold.r = job->two_fold.g = job->two_fold.v = (double)NAN;
  }
  if (!job->at_two_fold) {
    return CLI_DONE;
  }
  if (!found ||
      !cli_canard_solve(&job->machine, &job->two_fold, &job->canard)) {
    return cli_message(
        CLI_REFUSED,
        "scene %s: no two-fold that stick runs through, from a sliding into "
        "an escaping region, exists for these parameters; give a start with "
        "--set r=, omega=, h=",
        job->setup.scene->name);
  }
  return CLI_DONE;
}

int cli_job_prepare(cli_job_t *job, const cli_diverge_args_t *args) {
  cli_setup_t *setup = &job->setup;
  int code = cli_setup_read(setup, args->scene, &args->settings, NULL);
  job->args = args;
  if (code == CLI_DONE && cli_settings_find(&args->settings, "dt") == NULL) {
    setup->params.dt = (tf_real_t)cli_mechanisms[args->mechanism].dt;
  }
  code = code == CLI_DONE ? cli_setup_machine(setup) : code;
  code = code == CLI_DONE ? refuse_scene(setup) : code;
  if (code != CLI_DONE) {
    return code;
  }
  job->dt = (double)setup->params.dt;
  job->rate = (double)setup->params.rate;
  job->params = setup->params;
  job->params.rule =
      args->codim2 == CLI_CODIM2_ATTRACTING ? TF_RULE_PERSIST : TF_RULE_RANDOM;
  job->params.rate = 0;
  (void)tf_prepare(&job->machine, &job->params, NULL);
  job->at_two_fold = true;
  for (int i = 0; i < CLI_STARTS; i++) {
    job->at_two_fold &= setup->set_start[i] == NULL;
  }
  code = job->at_two_fold ? CLI_DONE : prepare_start(job);
  return code == CLI_DONE ? prepare_two_fold(job) : code;
}
