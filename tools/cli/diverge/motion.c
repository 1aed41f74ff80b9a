// What the steppers have in common: where a motion starts, how long its steps
// are, and when it is on the surface.

#include "motion.h"

#include <math.h>

#define TWO_PI 6.283185307179586
#define BEFORE 4e-3 // [m], distance of a start before the two-fold
#define NEAR 0.011  // steps are short where r differs by less than this part

// The generator is Philox: draw n of sample i under a seed is the same number
// whatever was drawn before, so that any worker may compute any sample.
static void draw(cli_draws_t *draws, uint32_t word[2]) {
  tf_philox((uint64_t)draws->sample << 32 | draws->used, draws->seed, word);
  draws->used++;
}

// A word as a number in (0, 1).
static double fraction(uint32_t word) {
  return ((double)word + 0.5) * (1.0 / 4294967296.0);
}

double cli_draw_uniform(cli_draws_t *draws) {
  uint32_t word[2];
  draw(draws, word);
  return fraction(word[0]);
}

double cli_draw_normal(cli_draws_t *draws) {
  uint32_t word[2];
  draw(draws, word);
  return sqrt(-2 * log(fraction(word[0]))) * cos(TWO_PI * fraction(word[1]));
}

cli_tracker_t cli_tracker_of(const cli_job_t *job) {
  return (cli_tracker_t){.machine = &job->machine,
                         .two_fold = &job->two_fold,
                         .section = job->args->section,
                         .patience = job->args->patience};
}

tf_state_t cli_motion_start(const cli_job_t *job) {
  return job->at_two_fold
             ? cli_before_two_fold(&job->machine, &job->two_fold, BEFORE)
             : job->setup.state;
}

void cli_prepare_near(cli_motion_t *motion, const tf_params_t *params) {
  const cli_job_t *job = motion->job;
  tf_params_t short_steps = *params;
  short_steps.dt = (tf_real_t)(job->dt / job->args->refinement);
  (void)tf_prepare(&motion->short_steps, &short_steps, NULL);
}

double cli_step_length(const cli_motion_t *motion, cli_point_t at, double g) {
  const cli_two_fold_t *two_fold = &motion->job->two_fold;
  const bool short_steps = g * two_fold->g > 0 &&
                           fabs(at.r - two_fold->r) < NEAR * fabs(two_fold->r);
  return short_steps ? (double)motion->short_steps.dt
                     : (double)motion->long_steps.dt;
}

cli_instant_t cli_instant_in_band(const cli_motion_t *motion, cli_point_t at) {
  const tf_slip_t slip = cli_slip_at(&motion->long_steps, at);
  const bool on = fabs((double)slip.h) <= motion->band;
  const bool rest = fabs((double)slip.g) <= CLI_REST_BANDS * motion->band;
  return (cli_instant_t){.t = motion->t,
                         .at = at,
                         .h = (double)slip.h,
                         .g = (double)slip.g,
                         .on = on,
                         .pinned = on && rest};
}

bool cli_refuse_cycle(cli_motion_t *motion) {
  motion->tracker->cycle.ended = motion->t;
  motion->tracker->cycle.outcome = CLI_CYCLE_REFUSED;
  return true;
}
