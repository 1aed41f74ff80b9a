// Motions whose friction lags behind the sign of h: with hysteresis it changes
// its side when h leaves +-size on the other side, with delay a time `size`
// after h changed its sign. Between two such changes the vector field is smooth
// and is integrated by the Runge-Kutta method of order 4; the changes are
// located. While h is on the other side, tf_tyre_force gives the limit h -> 0.
// Stick becomes chatter across h = 0, with an amplitude that grows with `size`.

#include <math.h>

#include "motion.h"

#define NEWTON 5       // iterations towards a change of side
#define CLOSE 1e-4     // relative error at which they end
#define AT_LEVEL 1e-15 // |h - level| below which h is at the level [m/s]
#define OVERSHOOT 1.2  // band of hysteresis, in sizes
#define RATE_BOUND 4.0 // bound of h' in units of mu / m, within a delay

static cli_point_t along(cli_point_t at, cli_point_t rate, double dt) {
  return (cli_point_t){at.r + dt * rate.r, at.p + dt * rate.p,
                       at.z + dt * rate.z};
}

static cli_point_t rate_of(const tf_machine_t *k, cli_point_t at, int side) {
  const cli_field_t f = cli_field_at(k, at);
  const tf_force_t by = tf_tyre_force(&k->contact.tyre, (tf_real_t)side,
                                      (tf_real_t)f.h, (tf_real_t)f.g);
  const double F = (double)by.F, M = (double)by.M;
  return (cli_point_t){f.rate.r, f.rate.p + F * f.p_F,
                       f.rate.z + (F * f.arm + M) / f.J};
}

static cli_point_t step(const tf_machine_t *k, cli_point_t at, int side,
                        double dt) {
  const cli_point_t a = rate_of(k, at, side);
  const cli_point_t b = rate_of(k, along(at, a, dt / 2), side);
  const cli_point_t c = rate_of(k, along(at, b, dt / 2), side);
  const cli_point_t d = rate_of(k, along(at, c, dt), side);
  const cli_point_t mean = {(a.r + 2 * b.r + 2 * c.r + d.r) / 6,
                            (a.p + 2 * b.p + 2 * c.p + d.p) / 6,
                            (a.z + 2 * b.z + 2 * c.z + d.z) / 6};
  return along(at, mean, dt);
}

static double slip_of(const tf_machine_t *k, cli_point_t at) {
  return (double)cli_slip_at(k, at).h;
}

// h' with friction on a side: h is linear in p and r z.
static double slip_rate(const tf_machine_t *k, cli_point_t at, int side) {
  const cli_point_t f = rate_of(k, at, side);
  const cli_point_t change = {1, f.p, f.r * at.z + at.r * f.z};
  return cli_field_at(k, change).h;
}

// Integrates until h = level, which is found by Newton's method, or for dt at
// most. Returns: the time that has passed.
static double step_until(const tf_machine_t *k, cli_point_t *at, int side,
                         double level, double dt) {
  const cli_point_t from = *at;
  const double gap = level - slip_of(k, from);
  const bool at_level = fabs(gap) < AT_LEVEL; // it is about to leave
  double x = at_level ? dt : gap / slip_rate(k, from, side);
  cli_point_t to = from;
  if (!(x > 0 && x < dt)) {
    to = step(k, from, side, dt);
    const double left = level - slip_of(k, to);
    if (at_level || (left > 0) == (gap > 0)) {
      *at = to;
      return dt;
    }
    x = dt * gap / (gap - left);
  }
  for (int i = 0; i < NEWTON; i++) {
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

static cli_instant_t start(cli_motion_t *motion) {
  const cli_job_t *job = motion->job;
  cli_motion_begin(motion, &job->params);
  motion->band = job->args->mechanism == CLI_BY_DELAY
                     ? RATE_BOUND * motion->size *
                           (double)job->machine.contact.tyre.mu /
                           (double)job->machine.m
                     : motion->size * OVERSHOOT;
  motion->at = cli_point_of(&job->machine, &motion->state);
  motion->side = cli_draw_uniform(&motion->draws) < 0.5 ? -1 : 1;
  return cli_instant_at(motion, motion->at);
}

// Hysteresis: the side changes where h leaves the band on the other side.
static void advance_hysteresis(cli_motion_t *motion, double dt) {
  const double level = -motion->side * motion->size;
  const double h = slip_of(&motion->long_steps, motion->at);
  if (motion->side * (h - level) <= 0) {
    motion->side = -motion->side;
    return;
  }
  const double passed =
      step_until(&motion->long_steps, &motion->at, motion->side, level, dt);
  motion->t += passed;
  if (passed < dt) {
    motion->side = -motion->side;
  }
}

// Delay: the queue has the time of the change of side for every past change of
// the sign of h.
static void advance_delay(cli_motion_t *motion, double dt) {
  double span = dt;
  bool changes = false;
  if (motion->queued > 0 && motion->queue[0] - motion->t <= dt) {
    span = motion->queue[0] - motion->t;
    changes = true;
  }
  if (span > 0) {
    const double passed =
        step_until(&motion->long_steps, &motion->at, motion->side, 0, span);
    motion->t += passed;
    const int sign = slip_of(&motion->long_steps, motion->at) < 0 ? -1 : 1;
    const int to_be = motion->queued % 2 != 0 ? -motion->side : motion->side;
    if (sign != to_be && motion->queued < CLI_QUEUED_SWITCHES) {
      motion->queue[motion->queued++] = motion->t + motion->size;
    }
    changes = changes && passed >= span;
  }
  if (changes) {
    motion->side = -motion->side;
    motion->queued--;
    for (int i = 0; i < motion->queued; i++) {
      motion->queue[i] = motion->queue[i + 1];
    }
  }
}

static bool advance(cli_motion_t *motion) {
  const cli_instant_t *last = &motion->tracker.last;
  const double dt = cli_step_length(motion, last->at, last->g);
  if (motion->job->args->mechanism == CLI_BY_DELAY) {
    advance_delay(motion, dt);
  } else {
    advance_hysteresis(motion, dt);
  }
  const cli_instant_t now = cli_instant_at(motion, motion->at);
  if (!(fabs(now.at.r) + fabs(now.at.p) + fabs(now.at.z) < 1e9)) {
    return cli_refuse_cycle(motion);
  }
  return cli_track(&motion->tracker, &now);
}

const cli_stepper_t cli_lagged_stepper = {start, advance, NULL};
