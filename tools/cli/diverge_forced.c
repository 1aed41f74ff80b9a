// Motions whose friction is on a side that does not follow the sign of h at
// once: with hysteresis it changes when h leaves +-size on the other side, with
// delay a time size after h changed its sign. Between two such changes the
// field is smooth: Runge-Kutta of order 4, the changes located. While the
// wheel is on the other side than its friction, tf_tyre_force gives the limit
// at h -> 0. In stick this is chatter across h = 0, as fine as the size.

#include <math.h>

#include "diverge.h"

#define REFINE 5       // Newton's steps on the way to a change of side
#define CLOSE 1e-4     // what they may leave of the way, as a part of it
#define THERE 1e-15    // |h - level| from which no crossing is sought [m/s]
#define OVER 1.2       // band of hysteresis, in sizes
#define RATE_BOUND 4.0 // h' changes less than this times mu / m in `size`

static cli_place_t along(cli_place_t at, cli_place_t rate, double dt) {
  const cli_place_t to = {at.r + dt * rate.r, at.p + dt * rate.p,
                          at.z + dt * rate.z};
  return to;
}

static cli_place_t rate_of(const tf_machine_t *k, cli_place_t at, int side) {
  const tf_slip_t slip = cli_place_slip(k, at);
  const tf_force_t force =
      tf_tyre_force(&k->tyre, (tf_real_t)side, slip.h, slip.g);
  return cli_flow(k, at, (double)force.F, (double)force.M);
}

static cli_place_t step(const tf_machine_t *k, cli_place_t at, int side,
                        double dt) {
  const cli_place_t a = rate_of(k, at, side);
  const cli_place_t b = rate_of(k, along(at, a, dt / 2), side);
  const cli_place_t c = rate_of(k, along(at, b, dt / 2), side);
  const cli_place_t d = rate_of(k, along(at, c, dt), side);
  const cli_place_t mean = {(a.r + 2 * b.r + 2 * c.r + d.r) / 6,
                            (a.p + 2 * b.p + 2 * c.p + d.p) / 6,
                            (a.z + 2 * b.z + 2 * c.z + d.z) / 6};
  return along(at, mean, dt);
}

static double slip_of(const tf_machine_t *k, cli_place_t at) {
  return (double)cli_place_slip(k, at).h;
}

// h' on a side.
static double slip_rate(const tf_machine_t *k, cli_place_t at, int side) {
  const cli_place_t f = rate_of(k, at, side);
  return -f.p * (double)k->sin_gamma -
         (f.r * at.z + at.r * f.z) * (double)k->cos_gamma;
}

// Goes on until h = level, by Newton's method from where h' points, or for dt
// at most; returns the time that took.
static double step_until(const tf_machine_t *k, cli_place_t *at, int side,
                         double level, double dt) {
  const cli_place_t from = *at;
  const double gap = level - slip_of(k, from);
  const bool there = fabs(gap) < THERE; // it leaves the level
  double x = there ? dt : gap / slip_rate(k, from, side);
  cli_place_t to = from;
  if (!(x > 0 && x < dt)) {
    to = step(k, from, side, dt);
    const double left = level - slip_of(k, to);
    if (there || (left > 0) == (gap > 0)) {
      *at = to;
      return dt;
    }
    x = dt * gap / (gap - left);
  }
  for (int i = 0; i < REFINE; i++) {
    to = step(k, from, side, x);
    const double left = level - slip_of(k, to);
    const double rate = slip_rate(k, to, side);
    if (fabs(left) <= CLOSE * fabs(gap) + 1e-16 || !(gap * rate > 0)) {
      break;
    }
    const double next = x + left / rate;
    if (!(next > 0 && next < dt)) {
      break;
    }
    x = next;
  }
  *at = to;
  return x;
}

static void start(cli_mover_t *mover) {
  const cli_job_t *job = mover->job;
  mover->far = job->stay;
  cli_prepare_near(mover, &job->params);
  mover->band = job->args->by == CLI_BY_DELAY
                    ? RATE_BOUND * mover->size * (double)job->stay.tyre.mu /
                          (double)job->stay.m
                    : mover->size * OVER;
  const tf_state_t at = cli_mover_start(job);
  mover->at = cli_state_place(&job->stay, &at);
  mover->t = 0;
  mover->side = cli_draw_uniform(&mover->draws) < 0.5 ? -1 : 1;
  mover->pendings = 0;
  const cli_instant_t now = cli_instant_in_band(mover, mover->at);
  cli_track_start(mover->tracker, &now);
}

// Hysteresis: the side changes where h leaves the band on the other side.
static void move_hysteresis(cli_mover_t *mover, double dt) {
  const double level = -mover->side * mover->size;
  const double h = slip_of(&mover->far, mover->at);
  if (mover->side * (h - level) <= 0) {
    mover->side = -mover->side;
    return;
  }
  const double gone =
      step_until(&mover->far, &mover->at, mover->side, level, dt);
  mover->t += gone;
  if (gone < dt) {
    mover->side = -mover->side;
  }
}

// Delay: what is pending is when the side changes, for every change of sign of
// h that has been.
static void move_delay(cli_mover_t *mover, double dt) {
  double span = dt;
  bool changes = false;
  if (mover->pendings > 0 && mover->pending[0] - mover->t <= dt) {
    span = mover->pending[0] - mover->t;
    changes = true;
  }
  if (span > 0) {
    const double gone =
        step_until(&mover->far, &mover->at, mover->side, 0, span);
    mover->t += gone;
    const int sign = slip_of(&mover->far, mover->at) < 0 ? -1 : 1;
    const int to_be = mover->pendings % 2 != 0 ? -mover->side : mover->side;
    if (sign != to_be && mover->pendings < CLI_PENDING) {
      mover->pending[mover->pendings++] = mover->t + mover->size;
    }
    changes = changes && gone >= span;
  }
  if (changes) {
    mover->side = -mover->side;
    mover->pendings--;
    for (int i = 0; i < mover->pendings; i++) {
      mover->pending[i] = mover->pending[i + 1];
    }
  }
}

static bool move(cli_mover_t *mover) {
  const cli_instant_t *last = &mover->tracker->last;
  const double dt = cli_step_here(mover, last->at, last->g);
  if (mover->job->args->by == CLI_BY_DELAY) {
    move_delay(mover, dt);
  } else {
    move_hysteresis(mover, dt);
  }
  const cli_instant_t now = cli_instant_in_band(mover, mover->at);
  if (!(fabs(now.at.r) + fabs(now.at.p) + fabs(now.at.z) < 1e9)) {
    return cli_refuse_cycle(mover);
  }
  return cli_track(mover->tracker, &now);
}

const cli_motion_t cli_forced_motion = {start, move, NULL};
