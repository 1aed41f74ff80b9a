// Motions that take a random exit where several modes are consistent. Between
// two draws they are stepped by tf_step_located.
//
// Draws are made at the two-fold, where stick goes on for an exponentially
// distributed time and then slips to either side with equal probability; in any
// other escaping stick, in the same way; at h = g = 0 where several modes are
// consistent; and while the wheel is pinned. The rule of the machine (`random`
// at the rate 0, or `persist`) never leaves such a state, so that all of these
// choices are made here. --codim2 decides what is done at h = g = 0.

#include <math.h>

#include "diverge.h"

#define LOCATED 1e-3  // [s], to which the end of a stick is bisected
#define SHORTEST 2e-9 // [s], to which the time of h = g = 0 is bisected
#define OFF 1e-5      // [s], length of the first step away from it
// |h| + |g| at h = g = 0 is below this many tolerances of a velocity.
#define CODIM2_TOLERANCES 4096
#define SLIPS (TF_MODE_BIT(TF_SLIP_PLUS) | TF_MODE_BIT(TF_SLIP_MINUS))

static double draw_time(cli_motion_t *motion) {
  const double rate = (double)motion->job->setup.params.rate;
  const double u = cli_draw_uniform(motion);
  return rate > 0 ? -log(u) / rate : (double)INFINITY;
}

// One mode of a set, all with equal probability; TF_NO_MODE of an empty set.
static unsigned draw_mode(cli_motion_t *motion, unsigned set) {
  unsigned modes[TF_MODES];
  unsigned n = 0;
  for (unsigned mode = 0; mode < TF_MODES; mode++)
    if ((set & TF_MODE_BIT(mode)) != 0) modes[n++] = mode;
  if (n < 2) return n == 0 ? TF_NO_MODE : modes[0];
  return modes[(unsigned)(cli_draw_uniform(motion) * n) % n];
}

// Leaves an escaping stick for slip, to a random side.
static bool leave_stick(cli_motion_t *motion) {
  motion->state.mode = (uint8_t)draw_mode(motion, SLIPS);
  motion->wait = -1;
  cli_instant_t now = cli_instant(motion);
  now.on = false;
  now.h = motion->state.mode == TF_SLIP_PLUS ? 1e-300 : -1e-300;
  return cli_track(motion, &now);
}

// From the two-fold along the canard, then slip to a random side.
static bool pass_two_fold(cli_motion_t *motion) {
  const cli_job_t *job = motion->job;
  cli_point_t at;
  double reached = 0;
  const double stay = fmin(draw_time(motion), job->args->patience);
  cli_cycle_t *cycle = &motion->cycle;
  cycle->released = !cli_canard_after(&job->canard, stay, &at, &reached);
  motion->passes = false;
  motion->t += reached;
  motion->state = cli_state_at(&job->wide, at);
  motion->state.mode = (uint8_t)cli_stick_mode(job->canard.s);
  const cli_instant_t on = cli_instant(motion);
  // To go on from the two-fold is no arrival there, wherever the sign of A is
  // that of its rounding.
  motion->last = on;
  return cli_track(motion, &on) || leave_stick(motion);
}

static unsigned futures_of(const cli_motion_t *motion) {
  const tf_machine_t *k = &motion->job->machine;
  const tf_input_t input = tf_input_default(k);
  tf_state_t state = motion->state;
  tf_report_t report = {.set = 0};
  state.mode = TF_NO_MODE;
  (void)tf_begin(k, &state, &input, &report);
  return report.set;
}

// Whether a state is one of those that end by a draw: pinned, or an escaping
// stick.
static bool waits(const cli_job_t *job, const tf_state_t *state) {
  const unsigned mode = state->mode;
  return mode == TF_PINNED ||
         (cli_is_stick(mode) &&
          cli_delassus(&job->wide, (double)state->r, cli_stick_sign(mode)) < 0);
}

// Whether a step ended a stay on h = 0, or something happened to a stick that
// had one future.
static bool changed(const cli_motion_t *motion, const tf_state_t *from) {
  return !tf_mode_is_slip(from->mode) &&
         (motion->state.mode != from->mode ||
          (!waits(motion->job, from) && motion->report.choices > 1));
}

// Goes on to LOCATED before the first step that changed, or to SHORTEST before
// the first with several futures; length: in/out, what is left of it.
// Returns: the time that has passed; < 0 where a step was refused.
static double come_near(cli_motion_t *motion, double *length, double end) {
  double passed = 0;
  while (*length > end) {
    const tf_state_t before = motion->state;
    *length /= 2;
    if (!cli_step_of(motion, *length)) return -1;
    if (end < LOCATED ? motion->report.choices > 1 : changed(motion, &before))
      motion->state = before;
    else
      passed += *length;
  }
  return passed;
}

// Whether within the last step, which began at `from`, the motion was at
// h = g = 0 with several consistent modes. If so it is put there; set gets the
// modes.
static bool was_at_codim2(cli_motion_t *motion, const tf_state_t *from,
                          double length, unsigned *set) {
  const tf_machine_t *k = &motion->job->machine;
  const cli_motion_t after = *motion;
  const double whole = length;
  if (motion->report.choices < 2) return false;
  motion->state = *from;
  const double passed = come_near(motion, &length, SHORTEST);
  const cli_instant_t now = cli_instant(motion);
  const double speed =
      fabs((double)motion->state.v) + fabs((double)motion->state.w);
  // Short steps may miss h = g = 0 where the long one hit it: then all but the
  // last has passed.
  if (passed < 0 || passed + 1.5 * length > whole ||
      fabs(now.h) + fabs(now.g) >
          CODIM2_TOLERANCES * (double)k->tolerance * speed) {
    *motion = after;
    return false;
  }
  const cli_point_t at = {now.at.r, 0, 0};
  motion->state = cli_state_at(&motion->job->wide, at);
  motion->state.mode = TF_PINNED;
  motion->t += passed;
  *set = futures_of(motion);
  return true;
}

// Leaves h = g = 0 in a mode by a short step, so that the next step does not
// count as another arrival there.
static bool leave_codim2(cli_motion_t *motion, unsigned mode) {
  motion->state.mode = (uint8_t)mode;
  motion->wait = -1;
  if (mode != TF_PINNED) {
    if (!cli_step_of(motion, OFF)) return cli_refuse_cycle(motion);
    motion->t += OFF;
  }
  const cli_instant_t now = cli_instant(motion);
  return cli_track(motion, &now);
}

// Leaves h = g = 0 after a pinned wheel has waited, in one of the other modes.
static bool leave_pinned(cli_motion_t *motion) {
  const unsigned set = futures_of(motion) & ~TF_MODE_BIT(TF_PINNED);
  return leave_codim2(motion, set != 0 ? draw_mode(motion, set) : TF_PINNED);
}

// Passes the state after a step to the tracker. Stick that passed the two-fold
// and ended within the same step ended after the two-fold.
static bool track(cli_motion_t *motion, const tf_state_t *from) {
  const cli_instant_t *before = &motion->last;
  cli_instant_t now = cli_instant(motion);
  const double side = cli_stick_sign(from->mode);
  const cli_wide_t *k = &motion->job->wide;
  const unsigned through = SLIPS | TF_MODE_BIT(from->mode);
  if (cli_is_stick(from->mode) && motion->report.set == through &&
      cli_delassus(k, before->at.r, side) > 0 &&
      cli_delassus(k, now.at.r, side) < 0) {
    now.on = true;
    now.g = before->g;
  }
  if (!cli_track(motion, &now)) return false;
  if (motion->cycle.outcome == CLI_CYCLE_RETURNED) {
    motion->t = motion->cycle.ended;
    motion->wait = -1;
  }
  return true;
}

// When a step from a state came to rest: v falls to 0 at a constant rate in the
// end, and at rest r stays. The tests hold it to 5e-5 s.
static double time_to_rest(const cli_motion_t *motion, const tf_state_t *from,
                           double length) {
  const double way = (double)motion->state.r - (double)from->r;
  const double time = 2 * way / (double)from->v;
  return motion->state.mode == TF_PINNED && from->mode != TF_PINNED &&
                 time >= 0 && time < length
             ? time
             : length;
}

// One step, to the end of a wait at most. A wait is drawn once, and begins and
// ends at its own instant, so that its distribution does not depend on dt.
bool cli_random_advance(cli_motion_t *motion) {
  if (motion->passes) return pass_two_fold(motion);
  tf_state_t from = motion->state;
  const bool waiting = waits(motion->job, &from);
  unsigned set = 0;
  // Windings are counted by changes of the sign of h, which need short steps.
  double length = tf_mode_is_slip(from.mode) ? motion->near
                                             : (double)motion->job->machine.dt;
  if (waiting) {
    motion->wait = motion->wait < 0 ? draw_time(motion) : motion->wait;
    length = fmin(length, motion->wait);
  }
  if (length > SHORTEST && !cli_step_of(motion, length))
    return cli_refuse_cycle(motion);
  if (length > LOCATED && changed(motion, &from)) {
    motion->state = from;
    const double passed = come_near(motion, &length, LOCATED);
    motion->t += passed;
    motion->wait -= waiting ? passed : 0;
    if (passed > 0 && track(motion, &from)) return true;
    from = motion->state;
    if (passed < 0 || !cli_step_of(motion, length))
      return cli_refuse_cycle(motion);
  }
  const bool stays = waiting && motion->state.mode == from.mode;
  motion->wait = stays ? motion->wait - length : -1;
  if (!waiting && motion->job->args->codim2 == CLI_CODIM2_EVEN &&
      was_at_codim2(motion, &from, length, &set)) {
    cli_instant_t now = cli_instant(motion);
    now.on = false;
    return cli_track(motion, &now) ||
           leave_codim2(motion, draw_mode(motion, set));
  }
  motion->t += time_to_rest(motion, &from, length);
  if (track(motion, &from) || !stays || motion->wait > 0)
    return motion->cycle.outcome != CLI_CYCLE_OPEN;
  return from.mode == TF_PINNED ? leave_pinned(motion) : leave_stick(motion);
}

const char *cli_random_branch(cli_motion_t *motion, unsigned mode,
                              unsigned *set) {
  const double dt = (double)motion->job->machine.dt;
  motion->t = 0;
  motion->wait = -1;
  motion->state.mode = (uint8_t)mode;
  cli_instant_t now = cli_instant(motion);
  cli_track_start(motion);
  if (tf_mode_is_slip(mode)) {
    motion->last.on = true;
    now.h = mode == TF_SLIP_PLUS ? 1e-300 : -1e-300;
    (void)cli_track(motion, &now);
  }
  bool ends = !cli_step_of(motion, OFF);
  motion->t += ends ? 0 : OFF;
  while (!ends && !waits(motion->job, &motion->state)) {
    const tf_state_t from = motion->state;
    ends = !cli_step_of(motion, dt);
    if (!ends && was_at_codim2(motion, &from, dt, set)) return "codim2";
    motion->t += ends ? 0 : dt;
    ends = ends || track(motion, &from);
  }
  return motion->cycle.outcome == CLI_CYCLE_RETURNED ? "two-fold"
         : !ends && motion->state.mode != TF_PINNED  ? "escaping"
         : motion->last.rests                        ? "rest"
                                                     : "unfinished";
}
