// What happens between one arrival at the two-fold and the next. It is
// determined from instants of a motion, in the same way for all mechanisms.
//
// "On the surface" means stick if the stepper has modes, otherwise |h| within a
// band for the dwell time. The phase of the outgoing spiral is the fraction of
// a winding, from one change from slip- to slip+ to the next, that is completed
// when r passes the section. It says where on the spiral the motion is, and
// does not depend on how the exit is defined.

#include <math.h>

#include "diverge.h"

// A motion that lands this often without coming back is in a small cycle.
#define SMALL_LANDINGS 3
#define SECTION 1e-3 // [m], behind the two-fold

// Whether g has the sign that it has at the two-fold.
static bool two_fold_side(const cli_tracker_t *tracker, double g) {
  return tracker->job->two_fold.g < 0 ? g < 0 : g > 0;
}

void cli_track_start(cli_tracker_t *tracker, const cli_job_t *job,
                     const cli_instant_t *at) {
  *tracker = (cli_tracker_t){.job = job,
                             .before = *at,
                             .last = *at,
                             .on_since = at->t,
                             .on_r = at->at.r};
  tracker->cycle.ended = at->t;
  cli_track_next(tracker);
}

void cli_track_next(cli_tracker_t *tracker) {
  tracker->cycle = (cli_cycle_t){.arrived = tracker->cycle.ended,
                                 .phase = -1,
                                 .section_t = -1,
                                 .up_last = -1};
}

// When r passes a value between two instants: bisection of the cubic that has r
// and v of both.
static double passage(const cli_tracker_t *tracker, const cli_instant_t *a,
                      const cli_instant_t *b, double r) {
  const double d = tracker->job->wide.d;
  const double dt = b->t - a->t;
  const double va = (a->at.p + d * a->at.z) * dt;
  const double vb = (b->at.p + d * b->at.z) * dt;
  const double rise = b->at.r - a->at.r;
  const bool down = a->at.r > r;
  double low = 0, high = 1;
  for (int i = 0; i < 50; i++) {
    const double x = (low + high) / 2, y = 1 - x;
    const double at =
        a->at.r + rise * x * x * (3 - 2 * x) + x * y * (va * y - vb * x);
    *((at > r) == down ? &low : &high) = x;
  }
  return a->t + dt * (low + high) / 2;
}

static bool has_arrived(cli_tracker_t *tracker, const cli_instant_t *at) {
  const cli_instant_t *last = &tracker->last;
  const double side = tracker->job->two_fold.g;
  const cli_wide_t *k = &tracker->job->wide;
  if (!isfinite(tracker->job->two_fold.r) || !last->on || !at->on ||
      !two_fold_side(tracker, last->g) || !two_fold_side(tracker, at->g) ||
      at->t - tracker->on_since < tracker->job->dwell ||
      cli_delassus(k, last->at.r, side) <= 0 ||
      cli_delassus(k, at->at.r, side) > 0) {
    return false;
  }
  tracker->cycle.ended = passage(tracker, last, at, tracker->job->two_fold.r);
  tracker->cycle.outcome = CLI_CYCLE_RETURNED;
  return true;
}

static void watch_exit(cli_tracker_t *tracker, const cli_instant_t *at) {
  cli_cycle_t *cycle = &tracker->cycle;
  const cli_instant_t *last = &tracker->last;
  if (cycle->left || !last->on || at->on) {
    return;
  }
  cycle->left = true;
  cycle->exit_t = last->t;
  cycle->exit_r = last->at.r;
  cycle->exit_omega = last->at.z + tracker->job->wide.omega0;
  cycle->exit_g = last->g;
  cycle->side = at->h < 0 ? -1 : 1;
  tracker->slip_side = cycle->side;
}

// When h changed its sign between two instants, by linear interpolation.
static double crossing(const cli_instant_t *a, const cli_instant_t *b) {
  return (a->h < 0) == (b->h < 0) ? a->t
                                  : a->t - (b->t - a->t) * a->h / (b->h - a->h);
}

static void watch_windings(cli_tracker_t *tracker, const cli_instant_t *at) {
  cli_cycle_t *cycle = &tracker->cycle;
  const cli_instant_t *last = &tracker->last;
  const double section =
      tracker->job->two_fold.r + copysign(SECTION, tracker->job->two_fold.v);
  if (!cycle->left || cycle->landed) {
    return;
  }
  if ((last->at.r > section) != (at->at.r > section) && cycle->section_t < 0) {
    cycle->section_t = passage(tracker, last, at, section);
  }
  const int side = at->h < 0 ? -1 : 1;
  if (at->on || side == tracker->slip_side) {
    return;
  }
  cycle->windings++;
  tracker->slip_side = side;
  if (side < 0) {
    return;
  }
  const double up = crossing(last, at);
  if (cycle->phase < 0 && cycle->up_last >= 0 &&
      cycle->up_last <= cycle->section_t && cycle->section_t <= up) {
    cycle->phase = (cycle->section_t - cycle->up_last) / (up - cycle->up_last);
  }
  cycle->up_last = up;
}

// When and where h became 0 between two instants, the first of which is in
// slip, by extrapolation of h from before them.
static void reach_surface(cli_tracker_t *tracker, const cli_instant_t *at) {
  const cli_instant_t *last = &tracker->last, *before = &tracker->before;
  const double v = last->at.p + tracker->job->wide.d * last->at.z;
  const double fall = (before->h - last->h) / (last->t - before->t);
  double dt = at->t - last->t;
  tracker->on_since = at->t;
  tracker->on_r = at->at.r;
  if (!before->on && before->t < last->t && before->h * last->h > 0 &&
      last->h / fall > 0) {
    dt = fmin(dt, last->h / fall);
    tracker->on_since = last->t + dt;
    tracker->on_r = last->at.r + v * dt;
  }
}

static void watch_landing(cli_tracker_t *tracker, const cli_instant_t *at) {
  cli_cycle_t *cycle = &tracker->cycle;
  if (at->on && !tracker->last.on) {
    reach_surface(tracker, at);
  }
  cycle->upper = cycle->upper && at->on;
  if (!at->on || cycle->upper || at->g == 0 || two_fold_side(tracker, at->g) ||
      at->rests || at->t - tracker->on_since < tracker->job->dwell) {
    return;
  }
  cycle->upper = true;
  cycle->landings++;
  if (!cycle->landed) {
    cycle->landed = true;
    cycle->land_t = tracker->on_since;
    cycle->land_r = tracker->on_r;
  }
}

bool cli_track(cli_tracker_t *tracker, const cli_instant_t *at) {
  cli_cycle_t *cycle = &tracker->cycle;
  if (!has_arrived(tracker, at)) {
    watch_exit(tracker, at);
    watch_windings(tracker, at);
    watch_landing(tracker, at);
    if (at->t - cycle->arrived > tracker->job->args->patience) {
      cycle->ended = at->t;
      cycle->outcome = at->rests                           ? CLI_CYCLE_REST
                       : cycle->landings >= SMALL_LANDINGS ? CLI_CYCLE_SMALL
                                                           : CLI_CYCLE_TIMEOUT;
    }
  }
  tracker->before = tracker->last;
  tracker->last = *at;
  return cycle->outcome != CLI_CYCLE_OPEN;
}
