// Motions by the core's own steps, perturbed in h.
//
// noise: the set-valued law, stepped by tf_step_located. After every step a
//   normally distributed number of standard deviation size sqrt(dt) is added to
//   h: the Euler-Maruyama method for the stochastic differential inclusion. In
//   the sliding region the next step returns to the surface for any dt. What dt
//   has to resolve is the time (size / (dA/dt mu))^(2/3) in which the noise is
//   stronger than the weak attraction near the two-fold.
// smoothing: the law SMOOTH of the width size, stepped by tf_step, no noise.

#include <math.h>

#include "motion.h"

#define SMOOTH_BAND 10 // smoothed stick stays within this many widths

// Rate of change of A mu where stick passes through the two-fold.
static double weakening(const cli_job_t *job) {
  const double e = 1e-6;
  const cli_two_fold_t *at = &job->two_fold;
  const double rise = cli_delassus(&job->machine, at->r + e, at->g) -
                      cli_delassus(&job->machine, at->r - e, at->g);
  return fabs(rise / (2 * e) * at->v) * (double)job->machine.tyre.mu;
}

static cli_instant_t instant(const cli_motion_t *motion) {
  return cli_instant_in_band(motion,
                             cli_point_of(&motion->long_steps, &motion->state));
}

static void start(cli_motion_t *motion) {
  const cli_job_t *job = motion->job;
  tf_params_t params = job->params;
  tf_report_t report;
  const tf_input_t input = tf_input_default(&job->machine);
  if (job->args->mechanism == CLI_BY_SMOOTHING) {
    params.law = TF_TYRE_SMOOTH;
    params.epsilon = (tf_real_t)motion->size;
    motion->band = SMOOTH_BAND * motion->size;
  } else {
    const double resolved = pow(2 * motion->size / weakening(job), 2.0 / 3.0);
    motion->band = 4 * motion->size * (isfinite(resolved) ? sqrt(resolved) : 1);
  }
  params.dt = (tf_real_t)job->dt;
  (void)tf_prepare(&motion->long_steps, &params, NULL);
  cli_prepare_near(motion, &params);
  motion->t = 0;
  motion->state = cli_motion_start(job);
  (void)tf_begin(&motion->long_steps, &motion->state, &input, &report);
  const cli_instant_t now = instant(motion);
  cli_track_start(motion->tracker, &now);
}

static void add_noise(cli_motion_t *motion, double dt) {
  const tf_machine_t *k = &motion->long_steps;
  const double mechanism =
      motion->size * sqrt(dt) * cli_draw_normal(&motion->draws);
  motion->state.v -= (tf_real_t)(mechanism / (double)k->sin_gamma);
  const tf_slip_t slip =
      tf_slip(k, motion->state.r, motion->state.v, motion->state.w, k->omega0);
  motion->state.mode = slip.h < 0 ? TF_SLIP_MINUS : TF_SLIP_PLUS;
}

static bool advance(cli_motion_t *motion) {
  const cli_instant_t before = motion->tracker->last;
  const double dt = cli_step_length(motion, before.at, before.g);
  const tf_machine_t *k = dt < (double)motion->long_steps.dt
                              ? &motion->short_steps
                              : &motion->long_steps;
  const tf_input_t input = tf_input_default(k);
  const bool noisy = motion->job->args->mechanism == CLI_BY_NOISE;
  const tf_status_t status =
      noisy ? tf_step_located(k, &motion->state, &input, &motion->report)
            : tf_step(k, &motion->state, &input, &motion->report);
  if (status < 0) {
    return cli_refuse_cycle(motion);
  }
  motion->t += dt;
  const cli_instant_t now = instant(motion);
  if (noisy) {
    add_noise(motion, dt);
  }
  return cli_track(motion->tracker, &now);
}

const cli_stepper_t cli_perturbed_stepper = {start, advance, NULL};
