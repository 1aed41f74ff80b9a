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

#include "../../../src/model/mechanics.h"
#include "diverge.h"

#define CHANGES 32    // within a step
#define SHORTEST 2e-9 // [s], of a step
#define OFF 1e-5      // [s], of the first step away from h = g = 0
#define TINY 1e-300   // [m/s], of an h or g that has a sign alone
#define SLIPS (TF_MODE_BIT(TF_SLIP_PLUS) | TF_MODE_BIT(TF_SLIP_MINUS))

static double draw_time(cli_motion_t *motion) {
  const double rate = (double)motion->job->setup.params.rate;
  const double u = cli_uniform(&motion->random);
  return rate > 0 ? -log(u) / rate : (double)INFINITY;
}

// One mode of a set, all with equal probability; TF_NO_MODE of an empty set.
static unsigned draw_mode(cli_motion_t *motion, unsigned set) {
  unsigned modes[TF_MODES];
  unsigned n = 0;
  for (unsigned mode = 0; mode < TF_MODES; mode++)
    if ((set & TF_MODE_BIT(mode)) != 0) modes[n++] = mode;
  if (n < 2) return n == 0 ? TF_NO_MODE : modes[0];
  return modes[(unsigned)(cli_uniform(&motion->random) * n) % n];
}

// Passes an instant within a step to the tracker, where h and g are 0 but for
// rounding and have the signs of a mode, and A is at a two-fold.
static bool track_change(cli_motion_t *motion, unsigned mode, bool two_fold) {
  cli_instant_t now = cli_instant(motion);
  if (two_fold) now.A = 0;
  now.on = !tf_mode_is_slip(mode);
  if (!now.on)
    now.h = mode == TF_SLIP_PLUS ? TINY : -TINY;
  else if (cli_is_stick(mode) && !(now.g * cli_stick_sign(mode) > 0))
    now.g = cli_stick_sign(mode) * TINY;
  return cli_track(motion, &now);
}

// Leaves an escaping stick for slip, to a random side.
static bool leave_stick(cli_motion_t *motion) {
  motion->state.mode = (uint8_t)draw_mode(motion, SLIPS);
  motion->wait = -1;
  return track_change(motion, motion->state.mode, false);
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

// How a part of a motion ends.
typedef enum {
  PART_STEP,    // with its step
  PART_WAITS,   // where a wait begins
  PART_CODIM2,  // at h = g = 0, where several modes are consistent
  PART_CYCLE,   // with the cycle
  PART_REFUSED, // a step was refused
} part_t;

// Takes a step, or as much of it as its segments come to; length: in/out.
static bool step_changes(cli_motion_t *motion, double *length,
                         tf_located_change_t list[CHANGES], size_t *count) {
  const tf_input_t input = tf_input_default(&motion->job->machine);
  const tf_state_t from = motion->state;
  for (;; *length /= 2) {
    tf_machine_t k = motion->job->machine;
    set_step_length(&k, (tf_real_t)*length);
    const tf_status_t status = tf_step_located_changes(
        &k, &motion->state, &input, &motion->report, list, CHANGES, count);
    if (status < 0) return false;
    if (status == TF_OK && *count <= CHANGES) return true;
    if (*length <= SHORTEST) return true;
    motion->state = from;
  }
}

// Whether it is not the rule that chooses at h = g = 0.
static bool chooses(const cli_motion_t *motion) {
  const cli_args_t *args = motion->job->args;
  return args->exhaustive || args->codim2 >= CLI_CODIM2_EVEN;
}

// Goes on from a change within a step.
static part_t pass_change(cli_motion_t *motion, unsigned before,
                          const tf_located_change_t *change) {
  const tf_report_t *report = &change->report;
  const bool two_fold = report->delassus == 0;
  motion->state = change->state;
  if (track_change(motion, before, false)) return PART_CYCLE;
  if (report->choices > 1 && !two_fold && chooses(motion)) return PART_CODIM2;
  if (track_change(motion, report->mode, two_fold)) return PART_CYCLE;
  if (two_fold) return PART_WAITS;
  return waits(motion->job, &motion->state) ? PART_WAITS : PART_STEP;
}

// At h = g = 0: the consistent modes, and the one that came there.
typedef struct {
  unsigned set, before;
} corner_t;

// Follows the motion for a time at most; corner: out, as of PART_CODIM2.
static part_t follow(cli_motion_t *motion, double length, corner_t *corner) {
  tf_located_change_t list[CHANGES];
  size_t count = 0;
  unsigned mode = motion->state.mode;
  const double t = motion->t;
  const tf_state_t from = motion->state;
  if (!step_changes(motion, &length, list, &count)) return PART_REFUSED;
  const tf_state_t end = motion->state;
  for (size_t i = 0; i < count; i++) {
    motion->t = t + (double)list[i].time;
    const part_t part = pass_change(motion, mode, &list[i]);
    *corner = (corner_t){list[i].report.set, mode};
    mode = list[i].report.mode;
    if (part == PART_STEP) continue;
    // A stick waits behind a two-fold, where A has the sign of its rounding.
    if (list[i].report.delassus == 0 && part == PART_WAITS) {
      motion->state = from;
      motion->t += OFF;
      return cli_step_of(motion, (double)list[i].time + OFF) ? part
                                                             : PART_REFUSED;
    }
    return part;
  }
  motion->t = t + length;
  motion->state = end;
  const cli_instant_t now = cli_instant(motion);
  return cli_track(motion, &now) ? PART_CYCLE : PART_STEP;
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

// One of the modes that are consistent at h = g = 0. By noise it is a slip, but
// where slip+ arrives the stick- that leaves as well.
static unsigned choose(cli_motion_t *motion, corner_t at) {
  const unsigned both =
      TF_MODE_BIT(TF_SLIP_MINUS) | TF_MODE_BIT(TF_STICK_MINUS);
  if (motion->job->args->codim2 != CLI_CODIM2_NOISE)
    return draw_mode(motion, at.set);
  if (at.before != TF_SLIP_PLUS || (at.set & both) != both)
    return draw_mode(motion, (at.set & SLIPS) != 0 ? at.set & SLIPS : at.set);
  const cli_corner_t corner = cli_motion_corner(motion);
  return cli_corner_selects(&corner, &motion->random) ? TF_SLIP_MINUS
                                                      : TF_STICK_MINUS;
}

// Goes on for a step, to the end of a wait at most. A wait is drawn once, and
// begins and ends at its own instant, so that its distribution does not depend
// on dt.
bool cli_random_advance(cli_motion_t *motion) {
  if (motion->passes) return pass_two_fold(motion);
  const tf_state_t from = motion->state;
  const double t = motion->t;
  corner_t corner = {0, 0};
  double length = (double)motion->job->machine.dt;
  const bool waiting = waits(motion->job, &from);
  if (!waiting)
    motion->wait = -1;
  else if (motion->wait < 0)
    motion->wait = draw_time(motion);
  if (waiting) length = fmin(length, motion->wait);
  const part_t part =
      length > SHORTEST ? follow(motion, length, &corner) : PART_STEP;
  if (part == PART_REFUSED) return cli_refuse_cycle(motion);
  if (part == PART_CYCLE) {
    motion->t = motion->cycle.ended;
    motion->wait = -1;
    return true;
  }
  if (part == PART_CODIM2) return leave_codim2(motion, choose(motion, corner));
  const bool stays =
      waiting && part == PART_STEP && motion->state.mode == from.mode;
  motion->wait = stays ? fmax(0, motion->wait - (motion->t - t)) : -1;
  if (!stays || motion->wait > SHORTEST) return false;
  if (from.mode != TF_PINNED) return leave_stick(motion);
  // A pinned wheel that has waited leaves in one of the other modes.
  const unsigned set = futures_of(motion) & ~TF_MODE_BIT(TF_PINNED);
  return leave_codim2(motion, set != 0 ? draw_mode(motion, set) : TF_PINNED);
}

const char *cli_random_branch(cli_motion_t *motion, unsigned mode,
                              unsigned *set) {
  motion->t = 0;
  motion->wait = -1;
  motion->state.mode = (uint8_t)mode;
  cli_track_start(motion);
  if (tf_mode_is_slip(mode)) {
    motion->last.on = true;
    (void)track_change(motion, mode, false);
  }
  corner_t corner = {0, 0};
  part_t part = cli_step_of(motion, OFF) ? PART_STEP : PART_REFUSED;
  motion->t += part == PART_STEP ? OFF : 0;
  while (part == PART_STEP && !waits(motion->job, &motion->state))
    part = follow(motion, (double)motion->job->machine.dt, &corner);
  *set = corner.set;
  return part == PART_CODIM2                                      ? "codim2"
         : motion->cycle.outcome == CLI_CYCLE_RETURNED            ? "two-fold"
         : part != PART_REFUSED && motion->state.mode < TF_PINNED ? "escaping"
         : motion->last.rests                                     ? "rest"
                              : "unfinished";
}
