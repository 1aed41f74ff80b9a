// Motions by the project's steppers under a perturbation of h.
//
// noise: the set-valued law, stepped by tf_step_located, and after every step a
//   normal draw of standard deviation size sqrt(dt) is added to h: Euler's
//   method for the stochastic differential inclusion. Where the surface
//   attracts, the next step takes the wheel back onto it, whatever dt; what dt
//   has to resolve is the time (size / (dA/dt mu))^(2/3) in which noise beats
//   the weak attraction near the two-fold.
// smoothing: the law SMOOTH of that width, by tf_step, without any draw.

#include <math.h>

#include "diverge.h"

#define SMOOTH_BAND 10 // widths within which smoothed stick stays

// Change of A mu in time, where stick runs through the two-fold.
static double weakening(const cli_job_t *job) {
  const double e = 1e-6;
  const cli_twofold_t *at = &job->twofold;
  const double rise = cli_delassus(&job->stay, at->r + e, at->g) -
                      cli_delassus(&job->stay, at->r - e, at->g);
  return fabs(rise / (2 * e) * at->v) * (double)job->stay.tyre.mu;
}

static cli_instant_t instant(const cli_mover_t *mover) {
  return cli_instant_in_band(mover,
                             cli_state_place(&mover->far, &mover->state));
}

static void start(cli_mover_t *mover) {
  const cli_job_t *job = mover->job;
  tf_params_t params = job->params;
  tf_report_t report;
  const tf_input_t input = tf_input_default(&job->stay);
  if (job->args->by == CLI_BY_SMOOTHING) {
    params.law = TF_TYRE_SMOOTH;
    params.epsilon = (tf_real_t)mover->size;
    mover->band = SMOOTH_BAND * mover->size;
  } else {
    const double beaten = pow(2 * mover->size / weakening(job), 2.0 / 3.0);
    mover->band = 4 * mover->size * (isfinite(beaten) ? sqrt(beaten) : 1);
  }
  params.dt = (tf_real_t)job->dt;
  (void)tf_prepare(&mover->far, &params, NULL);
  cli_prepare_near(mover, &params);
  mover->t = 0;
  mover->state = cli_mover_start(job);
  (void)tf_begin(&mover->far, &mover->state, &input, &report);
  const cli_instant_t now = instant(mover);
  cli_track_start(mover->tracker, &now);
}

static void kick(cli_mover_t *mover, double dt) {
  const tf_machine_t *k = &mover->far;
  const double by = mover->size * sqrt(dt) * cli_draw_normal(&mover->draws);
  mover->state.v -= (tf_real_t)(by / (double)k->sin_gamma);
  const tf_slip_t slip =
      tf_slip(k, mover->state.r, mover->state.v, mover->state.w, k->omega0);
  mover->state.mode = slip.h < 0 ? TF_SLIP_MINUS : TF_SLIP_PLUS;
}

static bool move(cli_mover_t *mover) {
  const cli_instant_t before = mover->tracker->last;
  const double dt = cli_step_here(mover, before.at, before.g);
  const tf_machine_t *k =
      dt < (double)mover->far.dt ? &mover->near : &mover->far;
  const tf_input_t input = tf_input_default(k);
  const bool noisy = mover->job->args->by == CLI_BY_NOISE;
  const tf_status_t status =
      noisy ? tf_step_located(k, &mover->state, &input, &mover->report)
            : tf_step(k, &mover->state, &input, &mover->report);
  if (status < 0) {
    return cli_refuse_cycle(mover);
  }
  mover->t += dt;
  const cli_instant_t now = instant(mover);
  if (noisy) {
    kick(mover, dt);
  }
  return cli_track(mover->tracker, &now);
}

const cli_motion_t cli_kicked_motion = {start, move, NULL};
