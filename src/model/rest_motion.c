// What ends a rest on a turntable that changes its speed. The force that holds
// the wheel is a quadratic in time there, because r stays and omega0 goes
// linearly into m r w^2. So is all that decides about a rest but one: how far F
// and M are within the law of rest, and within which bounds a stick that
// attracts is consistent, which takes the wheel over: g grows in it,
//   s g' = r sin(gamma) (kappa F - s M) / (m J A(s)) > 0,
// so that this ends where |M| = kappa |F|, and it needs no more than mu,
//   A(s) lambda = A(0) F + r cos(gamma) M / J,  |lambda| <= mu.
// The slip that an exit rule names is found by halving.
#include "../friction/mode_set.h"
#include "rates.h"

// An event is where a condition holds, or is broken, by that many roundings of
// the terms that balance at rest, wherever it is tested.
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
static parabola_t combined(const rest_motion_t *rest, tf_real_t of_F,
                           tf_real_t of_M, tf_real_t c) {
  const tf_real_t *F = rest->F, *M = rest->M;
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

static rest_rounding_t rounding_at_rest(const rest_motion_t *rest,
                                        tf_real_t t) {
  const tf_machine_t *k = rest->machine;
  const tf_input_t *u = rest->input;
  const tf_real_t r = rest->r, alpha = magnitude(u->alpha);
  const tf_real_t w = magnitude(rest->omega) + alpha * t;
  const force_terms_t size =
      force_terms(k, u, magnitude(u->r0) + magnitude(r), r, 0, w);
  const tf_real_t d = magnitude(k->d);
  const tf_real_t radial = size.radial + k->m * d * alpha;
  const tf_real_t torque =
      size.torque + d * size.radial + alpha / rest->inverse_J;
  const tf_real_t F = radial / magnitude(k->sin_gamma);
  return (rest_rounding_t){
      REST_ROUNDINGS * F, REST_ROUNDINGS * (torque + F * magnitude(rest->arm)),
      REST_ROUNDINGS *
          (radial * rest->inverse_m + magnitude(r) * torque * rest->inverse_J)};
}

// Pinned: r stays, w follows the turntable, and (13), (14) give the F and M
// that keep p' = z' = 0:
//   F sin(gamma) = -(Q_r + m d alpha),
//   M = J alpha - Q_phi - d Q_r - F r cos(gamma).
// With sin(gamma) = 0 no wheel is pinned (rates.h).
TF_API rest_motion_t tf_rest_motion(const tf_machine_t *k, const tf_input_t *u,
                                    tf_real_t r, tf_real_t omega) {
  const tf_real_t alpha = u->alpha;
  rest_motion_t rest = {.machine = k,
                        .input = u,
                        .r = r,
                        .omega = omega,
                        .inverse_m = 1 / k->m,
                        .inverse_J = 1 / (k->m * gyration2_at(k, r)),
                        .arm = r * k->cos_gamma};
  const tf_real_t w[REST_ORDER + 1] = {omega, alpha, 0};
  const tf_real_t w2[REST_ORDER + 1] = {omega * omega, 2 * omega * alpha,
                                        alpha * alpha};
  for (int n = 0; n <= REST_ORDER; n++) {
    const tf_real_t Q_r = radial_force_at_rest_term(k, u, n, r, w2[n]);
    tf_real_t F = -Q_r;
    tf_real_t torque = momentum_rate_term(k, u, n, w[n], Q_r);
    if (n == 0) {
      F -= k->m * k->d * alpha;
      torque -= alpha / rest.inverse_J;
    }
    rest.F[n] = F / k->sin_gamma;
    rest.M[n] = -torque - rest.F[n] * rest.arm;
  }
  return rest;
}

// By how much F or M is beyond the law: |x| > x0 - x1 |y| or |y| > y0 + y1 |x|
// in multipliers. Where a bound grows with the other one (the bow tie) only the
// sign counts that F has at time t: it may change while the law is left.
#define LAW_BORDERS 6

static parabola_t beyond_border(const rest_motion_t *rest, rest_rounding_t off,
                                int i, tf_real_t t) {
  const tf_machine_t *k = rest->machine;
  const rest_bounds_t at = rest_bounds(k->contact.rest);
  const tf_real_t mu = k->contact.tyre.mu, kappa = k->contact.stick_kappa;
  const bool pulls = is_positive(combined(rest, TF_R(-1.0), 0, 0), t);
  const sign_t sign_F = pulls ? MINUS : PLUS;
  const tf_real_t most_F = at.x0 * mu + off.F + at.x1 / kappa * off.M;
  const tf_real_t most_M = at.y0 * kappa * mu + off.M + at.y1 * kappa * off.F;
  const tf_real_t sign = unit(i % 2 == 0 ? MINUS : PLUS);
  const sign_t other = i < 2 ? MINUS : PLUS;
  return i < 4
             ? combined(rest, sign, with_sign(other, at.x1 / kappa), -most_F)
             : combined(rest, with_sign(sign_F, -kappa * at.y1), sign, -most_M);
}

static bool leaves_the_law(const rest_motion_t *rest, rest_rounding_t off,
                           tf_real_t *time) {
  bool leaves = false;
  for (int i = 0; i < LAW_BORDERS; i++) {
    const tf_real_t t = time_of_rise(beyond_border(rest, off, i, 0));
    if (!(t > 0 && t < *time)) continue;
    *time = t;
    leaves = true;
  }
  return leaves;
}

// The stick with one sign of g is consistent where all of these are above 0, if
// it attracts; false where it does not.
#define STICK_BORDERS 3

static bool stick_borders(const rest_motion_t *rest, rest_rounding_t off,
                          sign_t s, parabola_t above[STICK_BORDERS]) {
  const tf_machine_t *k = rest->machine;
  const tf_real_t rotation = rest->arm * rest->inverse_J;
  const tf_real_t A = delassus_from(k, rotation * stick_arm(k, rest->arm, s));
  if (!(A > 0)) return false;
  const tf_real_t A0 = delassus_from(k, rotation * rest->arm);
  const tf_real_t of_M = with_sign(s, -rest->r) * k->sin_gamma *
                         rest->inverse_m * rest->inverse_J / A;
  const tf_real_t most = A * k->contact.tyre.mu - off.rates;
  above[0] = combined(rest, -signed_kappa(k, s) * of_M, of_M, -off.rates);
  above[1] = combined(rest, -A0, -rotation, most);
  above[2] = combined(rest, A0, rotation, most);
  return true;
}

static bool all_positive(const parabola_t above[STICK_BORDERS], tf_real_t t) {
  return is_positive(above[0], t) && is_positive(above[1], t) &&
         is_positive(above[2], t);
}

// The stick with one sign of g becomes consistent.
static bool stick_begins(const rest_motion_t *rest, rest_rounding_t off,
                         sign_t s, tf_real_t *time) {
  parabola_t above[STICK_BORDERS];
  if (!stick_borders(rest, off, s, above)) return false;
  bool begins = false;
  for (int i = 0; i < STICK_BORDERS; i++) {
    const tf_real_t t = time_of_rise(above[i]);
    if (!(t > 0 && t < *time) || !is_positive(above[(i + 1) % 3], t) ||
        !is_positive(above[(i + 2) % 3], t))
      continue;
    *time = t;
    begins = true;
  }
  return begins;
}

static bool has_slip_at(const rest_motion_t *rest, unsigned slip, tf_real_t t) {
  const tf_machine_t *k = rest->machine;
  const tf_real_t omega = rest->omega + rest->input->alpha * t;
  const rates_t rates = tf_rates_at(k, rest->input, rest->r, 0, 0, omega);
  const codim2_field_t field = tf_codim2_field_of(k, &rates);
  consistent_modes_t modes;
  tf_codim2_modes(&k->contact, &field, &modes);
  return has(modes.solutions.set, slip);
}

// Whether the slip that the exit rule names begins before this time.
static bool exit_begins(const rest_motion_t *rest, unsigned slip,
                        tf_real_t *time) {
  tf_real_t before = 0;
  if (!has_slip_at(rest, slip, *time)) return false;
  for (int i = 0; i < HALVINGS; i++) {
    const tf_real_t middle = before + (*time - before) / 2;
    if (has_slip_at(rest, slip, middle))
      *time = middle;
    else
      before = middle;
  }
  return true;
}

TF_API bool tf_rest_ends(const rest_motion_t *rest, tf_real_t *time) {
  const tf_rule_t rule = rest->machine->contact.rule;
  if (rest->input->alpha == 0) return false;
  const rest_rounding_t off = rounding_at_rest(rest, *time);
  bool ends = leaves_the_law(rest, off, time);
  // RANDOM waits for its draw, which belongs to a step.
  if (rule != TF_RULE_RANDOM) {
    ends |= stick_begins(rest, off, PLUS, time);
    ends |= stick_begins(rest, off, MINUS, time);
  }
  if (rule == TF_RULE_SLIP_PLUS) ends |= exit_begins(rest, TF_SLIP_PLUS, time);
  if (rule == TF_RULE_SLIP_MINUS)
    ends |= exit_begins(rest, TF_SLIP_MINUS, time);
  return ends;
}

// Whether the stick is consistent within a time, but not at its end.
static bool stick_passes(const rest_motion_t *rest, rest_rounding_t off,
                         sign_t s, tf_real_t time) {
  parabola_t above[STICK_BORDERS];
  if (!stick_borders(rest, off, s, above) || all_positive(above, time))
    return false;
  return all_positive(above, 0) || stick_begins(rest, off, s, &time);
}

static bool is_beyond_law(const rest_motion_t *rest, rest_rounding_t off,
                          tf_real_t t) {
  for (int i = 0; i < LAW_BORDERS; i++)
    if (is_positive(beyond_border(rest, off, i, t), t)) return true;
  return false;
}

TF_API bool tf_rest_is_interrupted(const rest_motion_t *rest, tf_real_t time) {
  const rest_rounding_t off = rounding_at_rest(rest, time);
  tf_real_t end = time; // the start may be of no rest, too
  return (!is_beyond_law(rest, off, time) &&
          (is_beyond_law(rest, off, 0) || leaves_the_law(rest, off, &end))) ||
         (rest->machine->contact.rule != TF_RULE_RANDOM &&
          (stick_passes(rest, off, PLUS, time) ||
           stick_passes(rest, off, MINUS, time)));
}
