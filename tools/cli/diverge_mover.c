// What motions share, whatever decides where their future is open: where they
// start, how long their steps are, and when they are on the surface.

#include <math.h>

#include "diverge.h"

#define BEFORE 4e-3 // [m], of a start before the two-fold
#define NEAR 0.011  // short steps within so much of r of the two-fold

cli_tracker_t cli_tracker_of(const cli_job_t *job) {
  const cli_tracker_t tracker = {.machine = &job->stay,
                                 .twofold = &job->twofold,
                                 .section = job->args->section,
                                 .patience = job->args->patience};
  return tracker;
}

tf_state_t cli_mover_start(const cli_job_t *job) {
  return job->at_twofold ? cli_before_twofold(&job->stay, &job->twofold, BEFORE)
                         : job->setup.state;
}

void cli_prepare_near(cli_mover_t *mover, const tf_params_t *params) {
  const cli_job_t *job = mover->job;
  tf_params_t near = *params;
  near.dt = (tf_real_t)(job->dt / job->args->near_ratio);
  (void)tf_prepare(&mover->near, &near, NULL);
}

double cli_step_here(const cli_mover_t *mover, cli_place_t at, double g) {
  const cli_twofold_t *twofold = &mover->job->twofold;
  const bool near =
      g * twofold->g > 0 && fabs(at.r - twofold->r) < NEAR * fabs(twofold->r);
  return near ? (double)mover->near.dt : (double)mover->far.dt;
}

cli_instant_t cli_instant_in_band(const cli_mover_t *mover, cli_place_t at) {
  const tf_slip_t slip = cli_place_slip(&mover->far, at);
  const bool on = fabs((double)slip.h) <= mover->band;
  const bool rest = fabs((double)slip.g) <= CLI_REST * mover->band;
  const cli_instant_t now = {.t = mover->t,
                             .at = at,
                             .h = (double)slip.h,
                             .g = (double)slip.g,
                             .on = on,
                             .pinned = on && rest};
  return now;
}

bool cli_refuse_cycle(cli_mover_t *mover) {
  mover->tracker->cycle.ended = mover->t;
  mover->tracker->cycle.outcome = CLI_CYCLE_REFUSED;
  return true;
}
