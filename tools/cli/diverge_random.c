// A motion that draws where the future is open, between draws by tf_step_located.
//
// Open are: the two-fold, from which the wheel sticks on for a time drawn from
// an exponential law and then slips to a side drawn evenly; any other escaping
// stick, alike; h = g = 0, where several modes are consistent; and a pinned
// wheel. The machine of the steps itself never leaves what is open (its rule is
// `random` at the rate 0, or `persist`), so that none of these choices is made
// but by a draw here; what it takes at h = g = 0 was asked for by --corner.

#include <math.h>

#include "diverge.h"

#define SHORTEST 2e-9 // [s], to which an instant h = g = 0 is cut down
#define OFF 1e-5      // [s], the first step off it
#define CORNER 4096   // |h| + |g| there is less, in tolerances of a velocity
#define SLIPS (TF_MODE_BIT(TF_SLIP_PLUS) | TF_MODE_BIT(TF_SLIP_MINUS))

static bool is_stick(unsigned mode) {
  return mode == TF_STICK_PLUS || mode == TF_STICK_MINUS;
}

static cli_instant_t instant(const cli_mover_t *mover) {
  const cli_place_t at = cli_state_place(&mover->job->stay, &mover->state);
  const tf_slip_t slip = cli_place_slip(&mover->job->stay, at);
  const cli_instant_t now = {.t = mover->t,
                             .at = at,
                             .h = (double)slip.h,
                             .g = (double)slip.g,
                             .on = mover->state.mode > TF_SLIP_MINUS,
                             .pinned = mover->state.mode == TF_PINNED};
  return now;
}

static double draw_time(cli_mover_t *mover) {
  const double rate = mover->job->rate;
  const double u = cli_draw_uniform(&mover->draws);
  return rate > 0 ? -log(u) / rate : (double)INFINITY;
}

static unsigned draw_of(cli_mover_t *mover, unsigned set) {
  unsigned modes[TF_MODES];
  unsigned n = 0;
  for (unsigned mode = 0; mode < TF_MODES; mode++) {
    if ((set & TF_MODE_BIT(mode)) != 0) {
      modes[n++] = mode;
    }
  }
  if (n < 2) {
    return n == 0 ? TF_MODES : modes[0];
  }
  return modes[(unsigned)(cli_draw_uniform(&mover->draws) * n) % n];
}

// Slips off from an open stick, to a drawn side.
static bool leave_stick(cli_mover_t *mover, bool released) {
  mover->state.mode = (uint8_t)draw_of(mover, SLIPS);
  mover->clock = -1;
  cli_instant_t now = instant(mover);
  now.on = false;
  now.released = released;
  now.h = mover->state.mode == TF_SLIP_PLUS ? 1e-300 : -1e-300;
  return cli_track(mover->tracker, &now);
}

// From the two-fold along the stick that runs through it, and off.
static bool pass_twofold(cli_mover_t *mover) {
  const cli_job_t *job = mover->job;
  cli_place_t at;
  double reached = 0;
  const double wished = draw_time(mover);
  const bool open = cli_stick_after(&job->stick, wished, &at, &reached);
  const double limit = mover->tracker->patience;
  reached = reached < limit ? reached : limit;
  mover->t += reached;
  mover->state = cli_place_state(&job->stay, at);
  mover->state.mode = job->stick.s < 0 ? TF_STICK_MINUS : TF_STICK_PLUS;
  const cli_instant_t on = instant(mover);
  return cli_track(mover->tracker, &on) || leave_stick(mover, !open);
}

static void start(cli_mover_t *mover) {
  const cli_job_t *job = mover->job;
  mover->far = job->stay;
  cli_prepare_near(mover, &job->params);
  mover->clock = -1;
  mover->t = 0;
  if (!job->at_twofold) {
    mover->state = job->setup.state;
    const cli_instant_t now = instant(mover);
    cli_track_start(mover->tracker, &now);
    return;
  }
  mover->state = cli_place_state(
      &job->stay, cli_on_surface(&job->stay, job->stick.r, job->stick.z));
  mover->state.mode = job->stick.s < 0 ? TF_STICK_MINUS : TF_STICK_PLUS;
  const cli_instant_t now = instant(mover);
  cli_track_start(mover->tracker, &now);
}

static tf_status_t step(cli_mover_t *mover, const tf_machine_t *machine) {
  const tf_input_t input = tf_input_default(machine);
  return tf_step_located(machine, &mover->state, &input, &mover->report);
}

// A step of another length.
static bool step_of(cli_mover_t *mover, double dt) {
  tf_machine_t machine;
  tf_params_t params = mover->job->params;
  params.dt = (tf_real_t)dt;
  return tf_prepare(&machine, &params, NULL) == TF_OK &&
         step(mover, &machine) >= 0;
}

// Whether within the last step, which began at `from`, the motion was at h = g
// = 0 with more than one future; then it is put there, with its set of futures.
static bool was_at_corner(cli_mover_t *mover, const tf_state_t *from,
                          double length, unsigned *set) {
  const tf_machine_t *k = &mover->job->stay;
  const cli_mover_t after = *mover;
  double gone = 0;
  *set = 0;
  if (mover->report.choices < 2) {
    return false;
  }
  mover->state = *from;
  while (length > SHORTEST) {
    const tf_state_t before = mover->state;
    length /= 2;
    if (!step_of(mover, length)) {
      break;
    }
    if (mover->report.choices > 1) {
      *set = mover->report.set;
      mover->state = before;
    } else {
      gone += length;
    }
  }
  const cli_instant_t now = instant(mover);
  const double speed =
      fabs((double)mover->state.v) + fabs((double)mover->state.w);
  // Short steps may land beside h = g = 0 where the long one met it.
  if (*set == 0 || length > SHORTEST ||
      fabs(now.h) + fabs(now.g) > CORNER * (double)k->tolerance * speed) {
    *mover = after;
    return false;
  }
  const cli_place_t at = {now.at.r, 0, 0};
  mover->state = cli_place_state(k, at);
  mover->state.mode = TF_PINNED;
  mover->t += gone;
  return true;
}

// Takes a mode at h = g = 0, and the first short step off, so that the place
// is not taken for another arrival there.
static bool leave_corner(cli_mover_t *mover, unsigned mode) {
  mover->state.mode = (uint8_t)mode;
  mover->clock = -1;
  if (mode != TF_PINNED) {
    if (!step_of(mover, OFF)) {
      return cli_refuse_cycle(mover);
    }
    mover->t += OFF;
  }
  const cli_instant_t now = instant(mover);
  return cli_track(mover->tracker, &now);
}

static bool at_corner(cli_mover_t *mover, unsigned set) {
  cli_instant_t now = instant(mover);
  now.on = false;
  return cli_track(mover->tracker, &now) ||
         leave_corner(mover, draw_of(mover, set));
}

// A wheel that rests at h = g = 0 leaves it after a drawn time by one of the
// other modes; which they are tells a short step under the rule that leaves.
static bool leave_rest(cli_mover_t *mover) {
  const tf_state_t rest = mover->state;
  unsigned set = 0;
  if (step_of(mover, OFF)) {
    set = mover->report.set & ~TF_MODE_BIT(TF_PINNED);
  }
  mover->state = rest;
  return leave_corner(mover, set != 0 ? draw_of(mover, set) : TF_PINNED);
}

static bool is_open_stick(const cli_mover_t *mover) {
  const unsigned mode = mover->state.mode;
  const double side = mode == TF_STICK_MINUS ? -1 : 1;
  return is_stick(mode) &&
         cli_delassus(&mover->job->stay, (double)mover->state.r, side) < 0;
}

// Ends the wait of an open stick or a pinned wheel within this step.
static bool end_wait(cli_mover_t *mover) {
  const unsigned mode = mover->state.mode;
  if (mover->clock > SHORTEST && !step_of(mover, mover->clock)) {
    return cli_refuse_cycle(mover);
  }
  mover->t += mover->clock;
  mover->clock = -1;
  const cli_instant_t now = instant(mover);
  if (cli_track(mover->tracker, &now) || mover->state.mode != mode) {
    return mover->tracker->cycle.outcome != CLI_CYCLE_OPEN;
  }
  return mode == TF_PINNED ? leave_rest(mover) : leave_stick(mover, false);
}

// Tells the tracker of a step. A stick that was left in the step in which it
// passed the two-fold was left behind it.
static bool tell(cli_mover_t *mover, const tf_state_t *from) {
  const cli_instant_t *before = &mover->tracker->last;
  cli_instant_t now = instant(mover);
  const double side = from->mode == TF_STICK_MINUS ? -1 : 1;
  const tf_machine_t *k = &mover->job->stay;
  const unsigned through = SLIPS | TF_MODE_BIT(from->mode);
  if (is_stick(from->mode) && mover->report.set == through &&
      cli_delassus(k, before->at.r, side) > 0 &&
      cli_delassus(k, now.at.r, side) < 0) {
    now.on = true;
    now.g = before->g;
  }
  if (!cli_track(mover->tracker, &now)) {
    return false;
  }
  if (mover->tracker->cycle.outcome == CLI_CYCLE_RETURNED) {
    mover->t = mover->tracker->cycle.ended;
    mover->clock = -1;
  }
  return true;
}

static bool move(cli_mover_t *mover) {
  const cli_job_t *job = mover->job;
  // Windings are told by where h is seen to change its sign.
  const tf_machine_t *k =
      mover->state.mode <= TF_SLIP_MINUS ? &mover->near : &mover->far;
  const double dt = (double)k->dt;
  const tf_state_t from = mover->state;
  const bool open = from.mode == TF_PINNED || is_open_stick(mover);
  unsigned set = 0;
  if (open && mover->clock < 0) {
    mover->clock = draw_time(mover);
  }
  if (open && mover->clock <= dt) {
    return end_wait(mover);
  }
  if (step(mover, k) < 0) {
    return cli_refuse_cycle(mover);
  }
  if (open) {
    mover->clock = mover->state.mode == from.mode ? mover->clock - dt : -1;
  } else if (job->args->corner == CLI_CORNER_EVEN &&
             was_at_corner(mover, &from, dt, &set)) {
    return at_corner(mover, set);
  }
  mover->t += dt;
  return tell(mover, &from);
}

cli_branch_t cli_random_branch(cli_mover_t *mover, unsigned mode,
                               unsigned *set) {
  const double dt = (double)mover->job->stay.dt;
  mover->t = 0;
  mover->clock = -1;
  mover->state.mode = (uint8_t)mode;
  cli_instant_t now = instant(mover);
  cli_track_start(mover->tracker, &now);
  if (mode <= TF_SLIP_MINUS) {
    mover->tracker->last.on = true;
    now.h = mode == TF_SLIP_PLUS ? 1e-300 : -1e-300;
    (void)cli_track(mover->tracker, &now);
  }
  if (!step_of(mover, OFF)) {
    return CLI_BRANCH_TIME;
  }
  mover->t += OFF;
  while (mover->state.mode != TF_PINNED && !is_open_stick(mover)) {
    const tf_state_t from = mover->state;
    if (step(mover, &mover->far) < 0) {
      return CLI_BRANCH_TIME;
    }
    if (was_at_corner(mover, &from, dt, set)) {
      return CLI_BRANCH_CORNER;
    }
    mover->t += dt;
    if (tell(mover, &from)) {
      return mover->tracker->cycle.outcome == CLI_CYCLE_RETURNED
                 ? CLI_BRANCH_TWOFOLD
                 : CLI_BRANCH_TIME;
    }
  }
  return mover->state.mode == TF_PINNED ? CLI_BRANCH_TIME : CLI_BRANCH_ESCAPING;
}

const cli_motion_t cli_random_motion = {start, move, pass_twofold};
