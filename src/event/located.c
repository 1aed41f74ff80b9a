// One step with its switches located: segments of Taylor series, from switch to
// switch, until the step is over.
#include "twofold/located.h"

#include "../friction/inclusion.h"
#include "../friction/mode_set.h"
#include "../friction/slip_residual.h"
#include "trajectory.h"

// Slip below so many errors of a segment, and so much smaller than at its
// start, is none: the segment ended in h = g = 0.
#define TF_CAPTURE 256
#define TF_CLOSE TF_R(0x1p-6)
// A fall into h = g = 0 is looked for in every so many segments.
#define TF_CAPTURE_EVERY 5
// The coarsest tolerance that a step which is short of segments is given.
#ifdef TF_REAL_FLOAT
#define TF_COARSE_TOLERANCE TF_R(1e-3)
#else
#define TF_COARSE_TOLERANCE TF_R(1e-6)
#endif
// Beyond TF_LOCATED_SEGMENTS the pace is looked at every so many segments, and
// made so much quicker at once at most.
#define TF_PACE_EVERY 8
#define TF_MOST_QUICKER 2

// How far a segment goes, and how far off it may be there [m/s].
typedef struct {
  tf_real_t length, error;
} tf_reach_t;

// Allowed is the tolerance times what the velocities are and may change by in
// the rest of the step.
static tf_reach_t reach(const tf_trajectory_t *walk) {
  const tf_taylor_t *s = &walk->motion;
  const tf_real_t allowed =
      walk->tolerance * (tf_term_size(s, 0) + tf_term_size(s, 1) * walk->left);
  return (tf_reach_t){tf_segment_length(s, walk->left, allowed), allowed};
}

// Goes along the series from one of its times to another.
static void advance(tf_trajectory_t *walk, tf_real_t from, tf_real_t to) {
  const tf_taylor_t *s = &walk->motion;
  const tf_real_t t = to - from;
  walk->at = (tf_phase_point_t){value_at(&s->r, to), value_at(&s->p, to),
                                value_at(&s->z, to)};
  walk->force = (tf_force_t){value_at(&s->F, to), value_at(&s->M, to)};
  if (s->machine->with_angle)
    walk->phi += tf_angle_change(s, to) - tf_angle_change(s, from);
  walk->omega += s->input->alpha * t;
  walk->left = t < walk->left ? walk->left - t : 0;
}

// Near h = g = 0 slip may turn much faster to a limit direction than it moves
// along it: that is stiff, and its series is short. But it soon is the one
// solution that begins or ends along the limit direction, whose series from
// there is long. Finds where and when that is, to second order in the slip by
// the first series and to fourth by the second; what it is off across will be
// turned away with t^exponent. Then goes along it, to h = g = 0 at most.
static bool captured(tf_trajectory_t *walk, tf_real_t allowed) {
  tf_taylor_t *s = &walk->motion;
  const tf_machine_t *k = s->machine;
  const tf_phase_point_t at = walk->at;
  const tf_real_t q_now = at.r * at.z;
  tf_segment_t ray = walk->segment;
  tf_real_t r = at.r, t = 0, scale = 0, missed = 0;
  ray.closure = TF_CONTACT_CODIM2_SLIP;
  ray.h_zeros = 1;
  ray.g_is_0 = true;
  for (int i = 0; i < 2; i++) {
    const tf_real_t omega = walk->omega - s->input->alpha * t;
    const tf_rates_t rates = rates_at(k, s->input, r, 0, 0, omega);
    if (!tf_codim2_attractor(k, &rates, ray.roll, ray.side, &ray.T))
      return false;
    begin_taylor(s, k, s->input, omega, (tf_phase_point_t){r, 0, 0});
    (void)tf_taylor_coefficients(s,
                                 &ray); // TF_CONTACT_CODIM2_SLIP always can be
    const tf_real_t p1 = s->p.c[1], q1 = s->q.c[1];
    const tf_real_t a2 = p1 * p1 + q1 * q1;
    const tf_real_t ahead = at.p * p1 + q_now * q1;
    t = ahead / a2; // since h = g = 0; < 0: until
    for (int j = 0; j < 3; j++)
      t -= (value_at(&s->p, t) * p1 + value_at(&s->q, t) * q1 - ahead) / a2;
    if (!(t * s->exponent < 0)) return false; // what is off would grow
    r += at.r - value_at(&s->r, t);
    missed = magnitude(value_at(&s->p, t) - at.p) +
             magnitude(value_at(&s->q, t) - q_now);
    scale = 1 + k->tyre.mu * (magnitude(rates.Fp) + magnitude(rates.Fq)) /
                    (square_root(a2) * (1 + magnitude(s->exponent)));
  }
  if (!(missed * scale <= allowed && tf_segment_length(s, t, allowed) == t))
    return false;
  tf_real_t end = t + walk->left, when;
  if (t < 0 && end > 0) end = 0;
  if (t > 0) {
    end = tf_segment_length(s, end, allowed);
    if (!(end > t) || tf_next_event(s, &ray, end, 0, &when)) return false;
  }
  advance(walk, t, end);
  return true;
}

// After a switch: what comes next.
static bool pass(tf_trajectory_t *walk, tf_event_t what) {
  tf_segment_t *segment = &walk->segment;
  const bool up = walk->force.F > 0;
  switch (what) {
    case TF_EVENT_NONE: // the same goes on
      if (segment->closure == TF_CONTACT_CODIM2_SLIP)
        segment->closure = TF_CONTACT_SLIP;
      if (segment->closure == TF_CONTACT_TWO_FOLD_STICK)
        segment->closure = TF_CONTACT_STICK;
      segment->h_zeros = 0;
      segment->g_is_0 = segment->A_is_0 = false;
      return true;
    case TF_EVENT_G_ZERO:
      segment->closure = TF_CONTACT_SLIP;
      segment->roll = -segment->roll;
      segment->h_zeros = 0;
      segment->g_is_0 = true;
      return true;
    case TF_EVENT_H_ZERO:
      tf_project(walk);
      return tf_leave_h_zero(walk);
    case TF_EVENT_CODIM2:
      return tf_leave_codim2(walk, segment->roll < 0);
    case TF_EVENT_RELEASE: {
      // An attracting stick lets go to the side that F pushed to, where h
      // starts with t^2; an escaping one to the other.
      const bool attracting =
          tf_trajectory_rates(walk).A[segment->roll < 0] > 0;
      const unsigned mode = up == attracting ? TF_SLIP_PLUS : TF_SLIP_MINUS;
      tf_project(walk);
      tf_keep_largest_set(walk, TF_MODE_BIT(mode));
      tf_enter_mode(walk, mode, TF_CONTACT_SLIP,
                    (tf_segment_t){.side = mode == TF_SLIP_PLUS ? 1 : -1,
                                   .roll = segment->roll,
                                   .h_zeros = attracting ? 2 : 1});
      return true;
    }
    case TF_EVENT_TWO_FOLD:
      tf_project(walk);
      tf_keep_largest_set(walk, SLIPS | TF_MODE_BIT(walk->mode));
      segment->closure = TF_CONTACT_TWO_FOLD_STICK;
      segment->A_is_0 = true;
      segment->g_is_0 = false;
      return true;
    case TF_EVENT_UNPINNED:
    default:
      return tf_leave_codim2(walk, false);
  }
}

// Whether slip is near h = g = 0 and its series much shorter than its way from
// or to there: then it may be stiff.
static bool is_stiff_near_corner(const tf_trajectory_t *walk,
                                 tf_real_t length) {
  const tf_taylor_t *s = &walk->motion;
  const tf_real_t R = magnitude(s->p.c[0]) + magnitude(s->q.c[0]);
  const tf_real_t a = magnitude(s->p.c[1]) + magnitude(s->q.c[1]);
  return walk->segment.closure == TF_CONTACT_SLIP &&
         s->machine->stick_kappa > 0 && R > 8 * a * length &&
         R < 16 * a * s->machine->dt;
}

// When a stick reaches A = 0, where that is nearer than what the slip may be
// off by can tell: N = lambda A is as near to 0 then, and shorter and shorter
// segments would follow the error of lambda alone. 0 where it is not so.
static tf_real_t when_at_twofold(const tf_trajectory_t *walk, tf_reach_t span) {
  const tf_taylor_t *s = &walk->motion;
  const tf_machine_t *k = s->machine;
  if (walk->segment.closure != TF_CONTACT_STICK || k->stick_kappa == 0)
    return 0;
  const tf_real_t r = s->r.c[0];
  const delassus_quadratic_t at =
      delassus_quadratic(k, (tf_real_t)walk->segment.roll);
  const tf_real_t A = r * r + at.b * r + at.c;
  const tf_real_t rate = (2 * r + at.b) * s->r.c[1];
  const tf_real_t when = A * rate < 0 ? -A / rate : 0;
  const bool near = when > span.length && when <= walk->left &&
                    tf_term_size(s, 1) * when <= TF_CAPTURE * span.error;
  return near && magnitude(s->F.c[1]) * when <= TF_CLOSE * k->tyre.mu ? when
                                                                      : 0;
}

// Changes the tolerance as the length of a segment to its order, between that
// of the machine and the coarsest; false where it is not coarser then.
static bool coarsen(tf_trajectory_t *walk, tf_real_t quicker) {
  const tf_real_t finest = walk->motion.machine->tolerance;
  const tf_real_t before = walk->tolerance;
  tf_real_t tolerance = before;
  if (!(finest < TF_COARSE_TOLERANCE)) return false;
  for (int n = 1; n < TF_ORDER; n++) tolerance *= quicker;
  walk->tolerance = clip(tolerance, finest, TF_COARSE_TOLERANCE);
  walk->coarse |= walk->tolerance > finest;
  return walk->tolerance > before;
}

// In a step that is short of segments: what is left is to be done, at the pace
// of the last ones, in three quarters of those that may still be spent. What
// has been done stays as good as it is.
static void keep_pace(tf_trajectory_t *walk, tf_real_t done, int in,
                      int spare) {
  const tf_real_t most = TF_MOST_QUICKER;
  const tf_real_t reached = TF_R(0.75) * done * (tf_real_t)spare;
  const tf_real_t wanted = walk->left * (tf_real_t)in;
  tf_real_t quicker = most;
  if (wanted < most * reached) quicker = wanted / reached;
  coarsen(walk, quicker > 1 / most ? quicker : 1 / most);
}

// One segment and its switch; false where there is none. After a switch at the
// very end of the step the force is that of what follows.
static bool integrate_segment(tf_trajectory_t *walk, bool look_for_corner) {
  tf_taylor_t *s = &walk->motion;
  begin_taylor(s, s->machine, s->input, walk->omega, walk->at);
  if (!tf_taylor_coefficients(s, &walk->segment)) return false;
  if (!(walk->left > 0)) {
    walk->force = (tf_force_t){s->F.c[0], s->M.c[0]};
    walk->is_over = true;
    return true;
  }
  const tf_reach_t span = reach(walk);
  if (!(span.length > 0)) return coarsen(walk, TF_MOST_QUICKER);
  if (look_for_corner && is_stiff_near_corner(walk, span.length)) {
    if (captured(walk, span.error + tf_trajectory_rounding(walk))) {
      const bool at_corner = magnitude(walk->at.p) + magnitude(walk->at.z) == 0;
      walk->is_over = !at_corner && !(walk->left > 0);
      return !at_corner || pass(walk, TF_EVENT_CODIM2);
    }
    begin_taylor(s, s->machine, s->input, walk->omega, walk->at);
    (void)tf_taylor_coefficients(s, &walk->segment); // as above
  }
  const tf_real_t twofold = when_at_twofold(walk, span);
  if (twofold > 0) {
    advance(walk, 0, twofold);
    return pass(walk, TF_EVENT_TWO_FOLD);
  }
  const tf_slip_t slip = tf_trajectory_slip(walk);
  const tf_real_t close = TF_CLOSE * (magnitude(slip.h) + magnitude(slip.g));
  const tf_real_t missed = TF_CAPTURE * span.error;
  tf_real_t when;
  const tf_event_t what = tf_next_event(
      s, &walk->segment, span.length,
      (missed < close ? missed : close) + tf_trajectory_rounding(walk), &when);
  advance(walk, 0, when);
  // The product r z of two cut series is off by its first left-out term.
  if (walk->mode == TF_STICK_PLUS || walk->mode == TF_STICK_MINUS)
    tf_project(walk);
  walk->is_over = what == TF_EVENT_NONE && !(walk->left > 0);
  return walk->is_over || pass(walk, what);
}

static bool integrate_step(tf_trajectory_t *walk) {
  if (!tf_first_segment(walk)) return false;
  tf_real_t before = walk->left;
  int last = 0;
  for (int i = 0; i < TF_LOCATED_MOST_SEGMENTS; i++) {
    if (i >= TF_LOCATED_SEGMENTS && i % TF_PACE_EVERY == 0) {
      keep_pace(walk, before - walk->left, i - last,
                TF_LOCATED_MOST_SEGMENTS - TF_PACE_EVERY - i);
      before = walk->left;
      last = i;
    }
    if (!integrate_segment(walk, i % TF_CAPTURE_EVERY == TF_CAPTURE_EVERY - 1))
      return false;
    if (walk->is_over) return true;
  }
  return false;
}

static void start(tf_trajectory_t *walk, const tf_machine_t *k,
                  const tf_state_t *state, const tf_input_t *input,
                  tf_real_t tolerance) {
  walk->state = state;
  walk->motion.machine = k;
  walk->motion.input = input;
  walk->omega = input->omega0 - input->alpha * k->dt;
  walk->at.r = state->r;
  walk->at.z = state->w - walk->omega;
  walk->at.p = state->v - k->d * walk->at.z;
  walk->left = k->dt;
  walk->phi = 0;
  walk->tolerance = tolerance;
  walk->coarse = walk->is_over = false;
  walk->mode = state->mode;
  walk->set = walk->choices = 0;
  walk->force = (tf_force_t){0, 0};
}

static tf_status_t fall_back(const tf_machine_t *k, tf_state_t *state,
                             const tf_input_t *input, tf_report_t *report) {
  const tf_status_t status = tf_step(k, state, input, report);
  if (status != TF_OK) return status;
  report->status = TF_FELL_BACK;
  return TF_FELL_BACK;
}

static tf_status_t refuse(tf_report_t *report, tf_status_t status) {
  report->status = status;
  return status;
}

TF_API tf_status_t tf_step_located(const tf_machine_t *machine,
                                   tf_state_t *state, const tf_input_t *input,
                                   tf_report_t *report) {
  const tf_machine_t *k = machine;
  const tf_tyre_law_t law = k->tyre.law;
  if (!tf_tyre_is_set_valued(law) && law != TF_TYRE_NONE)
    return refuse(report, TF_BAD_PARAMETER);
  if (state->mode >= TF_MODES || !in_range(state, input))
    return refuse(report, TF_BAD_STATE);
  tf_trajectory_t walk;
  start(&walk, k, state, input, k->tolerance);
  if (!integrate_step(&walk)) return fall_back(k, state, input, report);
  const tf_status_t status = walk.coarse ? TF_COARSE : TF_OK;
  const tf_real_t w = walk.at.z + input->omega0;
  const tf_real_t v = walk.at.p + k->d * walk.at.z;
  if (!within(magnitude(walk.at.r) + magnitude(v) + magnitude(w),
              TF_STATE_LIMIT))
    return refuse(report, TF_DIVERGED);
  state->r = walk.at.r;
  state->v = v;
  state->w = w;
  if (k->with_angle) state->phi += walk.phi;
  state->mode = (uint8_t)walk.mode;
  state->tick++;
  const tf_slip_t slip = slip_speeds(k, state->r, v, w - input->omega0);
  const bool stick = walk.mode > TF_SLIP_MINUS;
  // After the largest set of the step there may have been a smaller one.
  if (!(walk.set & TF_MODE_BIT(walk.mode))) {
    walk.set |= TF_MODE_BIT(walk.mode);
    walk.choices++;
  }
  report->mode = (uint8_t)walk.mode;
  report->set = (uint8_t)walk.set;
  report->choices = (uint8_t)walk.choices;
  report->force = walk.force;
  report->slip = slip;
  report->delassus = law == TF_TYRE_NONE
                         ? 0
                         : delassus_at(k, state->r * k->cos_gamma, slip.g < 0,
                                       inertia_at(k, state->r));
  report->residual =
      stick
          ? law_residual(k->tyre.mu, k->stick_kappa, walk.force, slip.h, slip.g)
          : slip_law_residual(&k->tyre, walk.mode == TF_SLIP_PLUS ? 1 : -1,
                              walk.force, slip);
  report->status = status;
  return status;
}
