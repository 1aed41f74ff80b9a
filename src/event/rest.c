// What ends a rest on a turntable that changes its speed. The force that holds
// the wheel is a quadratic in time there, because r stays and omega0 goes
// linearly into m r w^2. So is all that decides about a rest but one: how far F
// and M are within the law of rest, and within which bounds a stick that
// attracts is consistent, which takes the wheel over: g grows in it,
//   s g' = r sin(gamma) (kappa F - s M) / (m J A(s)) > 0,
// so that this ends where |M| = kappa |F|, and it needs no more than mu,
//   A(s) lambda = A(0) F + r cos(gamma) M / J,  |lambda| <= mu.
// Where an exit rule asks for a slip, this begins with a limit direction, which
// is no root of a polynomial: the instant is found by halving, and one that is
// gone again by the end of the step is passed over.
#include "../friction/mode_set.h"
#include "../friction/rest_law.h"
#include "segment.h"

// An event is where a condition holds, or is broken, by that many roundings of
// the terms that balance at rest: by all who ask for it then.
#define REST_ROUNDINGS (64 * TF_REAL_EPSILON)
// Halvings of a step in which an exit begins.
#ifdef TF_REAL_FLOAT
#define HALVINGS 20
#else
#define HALVINGS 40
#endif

typedef struct {
  tf_real_t c0, c1, c2;
} parabola_t;

// of_F F + of_M M + c.
static parabola_t combined(const taylor_t *motion, tf_real_t of_F,
                           tf_real_t of_M, tf_real_t c) {
  const tf_real_t *F = motion->F.c, *M = motion->M.c;
  return (parabola_t){c + of_F * F[0] + of_M * M[0], of_F * F[1] + of_M * M[1],
                      of_F * F[2] + of_M * M[2]};
}

// Where a parabola rises through 0, which it does once at most: its slope there
// is the root of the discriminant. NaN or infinity where it does not rise. Over
// the size of its terms, so that no product overflows.
static tf_real_t time_of_rise(parabola_t y) {
  const tf_real_t size = magnitude(y.c0) + magnitude(y.c1) + magnitude(y.c2);
  const tf_real_t a = y.c2 / size, b = y.c1 / size, c = y.c0 / size;
  const tf_real_t slope = square_root(b * b - 4 * a * c);
  return b > 0 ? -2 * c / (b + slope) : (slope - b) / (2 * a);
}

static bool is_positive(parabola_t y, tf_real_t t) {
  return (y.c2 * t + y.c1) * t + y.c0 > 0;
}

// What rounding makes of the force at rest, and of the accelerations of p and q
// under it.
typedef struct {
  tf_real_t F, M, rates;
} rest_rounding_t;

static rest_rounding_t rounding_at_rest(const taylor_t *motion, tf_real_t t) {
  const tf_machine_t *k = motion->machine;
  const tf_input_t *u = motion->input;
  const tf_real_t r = motion->r.c[0], alpha = magnitude(u->alpha);
  const tf_real_t w = magnitude(motion->w.c[0]) + alpha * t;
  const force_terms_t size =
      force_terms(k, u, magnitude(u->r0) + magnitude(r), r, 0, w);
  const tf_real_t d = magnitude(k->d);
  const tf_real_t radial = size.radial + k->m * d * alpha;
  const tf_real_t torque =
      size.torque + d * size.radial + alpha / motion->inverse_J;
  const tf_real_t F = radial / magnitude(k->sin_gamma);
  return (rest_rounding_t){
      REST_ROUNDINGS * F,
      REST_ROUNDINGS * (torque + F * magnitude(motion->arm)),
      REST_ROUNDINGS * (radial * motion->inverse_m +
                        magnitude(r) * torque * motion->inverse_J)};
}

// F or M leaves the law: |x| > x0 - x1 |y| or |y| > y0 + y1 |x| in multipliers.
// Where a bound grows with the other one (the bow tie) only the present sign of
// that one counts.
static bool leaves_the_law(const taylor_t *motion, rest_rounding_t off,
                           tf_real_t *time) {
  const tf_machine_t *k = motion->machine;
  const rest_bounds_t at = rest_bounds(k->rest);
  const tf_real_t mu = k->tyre.mu, kappa = k->stick_kappa;
  const tf_real_t sign_F = motion->F.c[0] < 0 ? TF_R(-1.0) : TF_R(1.0);
  const tf_real_t most_F = at.x0 * mu + off.F + at.x1 / kappa * off.M;
  const tf_real_t most_M = at.y0 * kappa * mu + off.M + at.y1 * kappa * off.F;
  bool leaves = false;
  for (int i = 0; i < 6; i++) {
    const tf_real_t sign = i % 2 == 0 ? TF_R(-1.0) : TF_R(1.0);
    const tf_real_t other = i < 2 ? TF_R(-1.0) : TF_R(1.0);
    const parabola_t beyond =
        i < 4 ? combined(motion, sign, other * at.x1 / kappa, -most_F)
              : combined(motion, -sign_F * kappa * at.y1, sign, -most_M);
    const tf_real_t t = time_of_rise(beyond);
    if (!(t > 0 && t < *time)) continue;
    *time = t;
    leaves = true;
  }
  return leaves;
}

// The stick with one sign of g becomes consistent, and attracts.
static bool stick_begins(const taylor_t *motion, rest_rounding_t off,
                         bool minus, tf_real_t *time) {
  const tf_machine_t *k = motion->machine;
  const tf_real_t rotation = motion->arm * motion->inverse_J;
  const tf_real_t A =
      delassus_from(k, rotation * stick_arm(k, motion->arm, minus));
  if (!(A > 0)) return false;
  const tf_real_t A0 = delassus_from(k, rotation * motion->arm);
  const tf_real_t of_M = (minus ? TF_R(1.0) : TF_R(-1.0)) * motion->r.c[0] *
                         k->sin_gamma * motion->inverse_m * motion->inverse_J /
                         A;
  const tf_real_t most = A * k->tyre.mu - off.rates;
  const parabola_t above[3] = {
      combined(motion, -signed_kappa(k, minus) * of_M, of_M, -off.rates),
      combined(motion, -A0, -rotation, most),
      combined(motion, A0, rotation, most)};
  bool begins = false;
  for (int i = 0; i < 3; i++) {
    const tf_real_t t = time_of_rise(above[i]);
    if (!(t > 0 && t < *time) || !is_positive(above[(i + 1) % 3], t) ||
        !is_positive(above[(i + 2) % 3], t))
      continue;
    *time = t;
    begins = true;
  }
  return begins;
}

static bool has_slip_at(const taylor_t *motion, unsigned slip, tf_real_t t) {
  const tf_machine_t *k = motion->machine;
  const tf_real_t omega = motion->w.c[0] + motion->w.c[1] * t;
  const rates_t rates = rates_at(k, motion->input, motion->r.c[0], 0, 0, omega);
  const codim2_field_t field = tf_codim2_field_of(k, &rates);
  consistent_modes_t modes;
  tf_codim2_modes(k, &field, &modes);
  return has(modes.solutions.set, slip);
}

// The slip that the exit rule asks for begins. Before this time it has not.
static bool exit_begins(const taylor_t *motion, unsigned slip,
                        tf_real_t *time) {
  tf_real_t before = 0;
  if (!has_slip_at(motion, slip, *time)) return false;
  for (int i = 0; i < HALVINGS; i++) {
    const tf_real_t middle = before + (*time - before) / 2;
    if (has_slip_at(motion, slip, middle))
      *time = middle;
    else
      before = middle;
  }
  return true;
}

TF_API event_t tf_next_event_at_rest(const taylor_t *motion, tf_real_t *time) {
  const tf_machine_t *k = motion->machine;
  const tf_rule_t rule = k->rule;
  if (motion->input->alpha == 0) return EVENT_NONE;
  const rest_rounding_t off = rounding_at_rest(motion, *time);
  bool ends = leaves_the_law(motion, off, time);
  // RANDOM waits for its draw, which belongs to a step.
  if (rule != TF_RULE_RANDOM) {
    ends |= stick_begins(motion, off, false, time);
    ends |= stick_begins(motion, off, true, time);
  }
  if (rule == TF_RULE_SLIP_PLUS)
    ends |= exit_begins(motion, TF_SLIP_PLUS, time);
  if (rule == TF_RULE_SLIP_MINUS)
    ends |= exit_begins(motion, TF_SLIP_MINUS, time);
  return ends ? EVENT_UNPINNED : EVENT_NONE;
}
