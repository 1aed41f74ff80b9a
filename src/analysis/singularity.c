// Where two-folds lie and what they are (Filippov 1988, Teixeira 1990). On h =
// 0, h' = N - A lambda, so that a two-fold is A = N = 0. See the header for the
// scheme of each function.
#include "twofold/singularity.h"

#include <stddef.h>

#include "field.h"

// Below this sin(gamma) is rounding of gamma = 0 or pi.
#define NO_SINE (4 * TF_REAL_EPSILON)

TF_API const char *tf_absence_name(unsigned absence) {
  static const char *const names[TF_ABSENCES] = {
      "there is one", "the friction does not jump at h = 0",
      "without a moment in stick the Delassus scalar is positive everywhere",
      "kappa |cos gamma| < 2 beta |sin gamma|: the Delassus scalar is positive "
      "everywhere",
      "where the Delassus scalar vanishes, nothing balances h with the sign of "
      "g that this takes"};
  return absence < TF_ABSENCES ? names[absence] : "unknown";
}

TF_API const char *tf_folds_name(unsigned type) {
  static const char *const names[TF_FOLDS] = {
      "invisible", "visible", "visible-invisible", "degenerate", "continuous"};
  return type < TF_FOLDS ? names[type] : "unknown";
}

TF_INLINE tf_real_t largest(tf_real_t a, tf_real_t b) { return a > b ? a : b; }

// Real roots of a x^2 + b x + c, the one of larger magnitude first. A double
// root is given once, and not if it is 0. Scaled by the largest coefficient, so
// that no square overflows.
static int quadratic_roots(tf_real_t a, tf_real_t b, tf_real_t c,
                           tf_real_t x[2]) {
  const tf_real_t size =
      largest(magnitude(a), largest(magnitude(b), magnitude(c)));
  if (!(size > 0 && size <= TF_REAL_MAX)) return 0;
  a /= size;
  b /= size;
  c /= size;
  if (a == 0) {
    if (b == 0) return 0;
    x[0] = -c / b;
    return 1;
  }
  const tf_real_t discriminant = b * b - 4 * a * c;
  if (!(discriminant >= 0)) return 0;
  const tf_real_t root = square_root(discriminant);
  const tf_real_t q = -(b < 0 ? b - root : b + root) / 2;
  if (q == 0) return 0; // b = c = 0
  x[0] = q / a;
  x[1] = c / q;
  return root > 0 ? 2 : 1;
}

// The radii of A(r, s) = 0, from A J = r^2 + b r + beta^2 sin^2(gamma). The
// discriminant is (|b| - 2 beta |sin|)(|b| + 2 beta |sin|), in which no square
// cancels another.
static int singular_radii(const tf_machine_t *k, tf_real_t sine, sign_t s,
                          tf_real_t r[2]) {
  const tf_real_t b = delassus_quadratic(k, s).b;
  const tf_real_t size = magnitude(b);
  const tf_real_t least = 2 * square_root(k->beta2) * magnitude(sine);
  if (!(size >= least)) return 0; // so size > 0: sine or cosine is not 0
  const tf_real_t root = square_root((size - least) * (size + least));
  const tf_real_t outer = (size + root) / 2;
  const tf_real_t inner = k->beta2 * sine / outer * sine;
  r[0] = b > 0 ? -outer : outer;
  r[1] = b > 0 ? -inner : inner;
  return inner > 0 && inner < outer ? 2 : 1;
}

// N(g) = n[0] + n[1] g + n[2] g^2 along h = 0 at one r, where w = omega0 +
// zeta g and v = nu g: (2), (3) and v z by powers of g.
static void N_by_powers_of_g(const tf_machine_t *k, const tf_input_t *input,
                             tf_real_t sine, tf_real_t r, tf_real_t n[3]) {
  const tf_real_t cosine = k->cos_gamma;
  const tf_real_t zeta = sine / r, nu = k->d * zeta - cosine;
  const forces_along_g_t f = forces_along_g(k, input, sine, r, zeta, nu);
  const tf_real_t share = cosine * r / inertia_at(k, r);
  for (int i = 0; i < 3; i++)
    n[i] = -sine * f.Q_r[i] / k->m - share * (f.Q_phi[i] + k->d * f.Q_r[i]);
  n[0] += input->alpha * (r * cosine - k->d * sine);
  n[2] -= cosine * nu * zeta;
}

// The two-folds of one r and s.
static int two_folds_at(const tf_machine_t *k, const tf_input_t *input,
                        tf_real_t sine, tf_real_t r, sign_t s,
                        tf_surface_point_t *out) {
  tf_real_t n[3], g[2];
  N_by_powers_of_g(k, input, sine, r, n);
  const int most = quadratic_roots(n[2], n[1], n[0], g);
  int count = 0;
  for (int i = 0; i < most; i++) {
    const tf_real_t z = sine / r * g[i];
    const tf_surface_point_t point =
        surface_point(k, r, z, input->omega0 + z, g[i]);
    if (with_sign(s, g[i]) > 0 && in_reach(r, point.v, point.w))
      out[count++] = point;
  }
  return count;
}

// What keeps the machine from having a two-fold in any motion.
static tf_absence_t absence_in(const tf_machine_t *k, tf_real_t sine) {
  tf_real_t r[2];
  if (!tf_tyre_is_set_valued(k->contact.tyre.law) || !(k->contact.tyre.mu > 0))
    return TF_ABSENCE_LAW;
  if (!(k->contact.stick_kappa > 0)) return TF_ABSENCE_MOMENT;
  return singular_radii(k, sine, PLUS, r) > 0 ? TF_ABSENCE_NONE
                                              : TF_ABSENCE_ARM;
}

TF_API tf_status_t tf_two_folds(const tf_machine_t *machine,
                                const tf_input_t *input,
                                tf_surface_point_t points[TF_TWO_FOLDS],
                                int *count, tf_absence_t *absence) {
  const tf_machine_t *k = machine;
  const tf_state_t still = {.r = 0};
  if (!in_range(&still, input)) return TF_BAD_STATE;
  const tf_real_t sine =
      within(k->sin_gamma, NO_SINE) ? TF_R(0.0) : k->sin_gamma;
  const tf_absence_t why = absence_in(k, sine);
  int found = 0;
  for (int n = 0; n < 2 && why == TF_ABSENCE_NONE; n++) {
    const sign_t s = n == 0 ? PLUS : MINUS;
    tf_real_t r[2];
    const int radii = singular_radii(k, sine, s, r);
    for (int i = 0; i < radii; i++)
      found += two_folds_at(k, input, sine, r[i], s, points + found);
  }
  *count = found;
  if (absence)
    *absence = why != TF_ABSENCE_NONE || found > 0 ? why : TF_ABSENCE_BALANCE;
  return TF_OK;
}

// dN/dt along f(x, lambda), N = -sin(gamma) p' - cos(gamma) q' at lambda = 0.
static tf_real_t rate_of_N(const tf_machine_t *k, const tf_input_t *input,
                           const field_point_t *x, tf_real_t lambda) {
  const tf_rate_t f = field_under(k, input, x, lambda);
  const tf_real_t r = x->r, v = x->v, w = x->w, m = k->m, J = x->J;
  const tf_real_t dr = f.r, dv = f.v, dw = f.w, dz = f.w - input->alpha;
  const tf_real_t dQ_r = radial_force_rate(k, r, w, dr, dv, dw);
  const tf_real_t dQ_phi = disc_torque_rate(k, r, v, w, dr, dv, dw);
  const tf_real_t ddz =
      (dQ_phi + k->d * dQ_r - (x->rates.dz + input->alpha) * 2 * m * r * dr) /
      J;
  const tf_real_t ddq = dr * x->rates.dz + r * ddz + dv * x->z + v * dz;
  return -k->sin_gamma * dQ_r / m - k->cos_gamma * ddq;
}

// The straight orbit with these shares of f(x, +mu) and f(x, -mu); plus != 0.
static tf_direction_t direction_of(const tf_two_fold_t *at, tf_real_t value,
                                   tf_real_t plus, tf_real_t minus,
                                   tf_real_t mu) {
  tf_direction_t out = {.value = value};
  const tf_real_t size = magnitude(plus) + magnitude(minus);
  const tf_real_t signed_size = plus < 0 ? -size : size;
  out.plus = plus / signed_size;
  out.minus = minus / signed_size;
  out.sticks = out.minus >= 0;
  out.lambda = out.sticks ? mu * (out.plus - out.minus) : 0;
  out.velocity = (tf_rate_t){out.plus * at->plus.r + out.minus * at->minus.r,
                             out.plus * at->plus.v + out.minus * at->minus.v,
                             out.plus * at->plus.w + out.minus * at->minus.w};
  return out;
}

// scale = sqrt|K++ K--| is 0 only where one of them is, as the product of two
// roots: the root of the smallest number is far larger than that.
static unsigned type_of(const tf_machine_t *k, const tf_two_fold_t *at,
                        tf_real_t scale) {
  if (within(k->sin_gamma, NO_SINE)) return TF_FOLDS_CONTINUOUS;
  if (!(scale > 0)) return TF_FOLDS_DEGENERATE;
  if ((at->Kpp > 0) == (at->Kmm > 0)) return TF_FOLDS_MIXED;
  return at->Kpp < 0 ? TF_FOLDS_INVISIBLE : TF_FOLDS_VISIBLE;
}

// The paper's cases 1 to 3, 0 for none; case 3 is J1 J2 < 1.
static unsigned paper_case_of(const tf_two_fold_t *at) {
  if (at->type != TF_FOLDS_INVISIBLE) return 0;
  const tf_real_t J1_J2 = at->J1 * at->J2;
  if (J1_J2 < 1) return 3;
  if (!(J1_J2 > 1)) return 0;
  return at->J1 < 0 ? 1 : 2;
}

// A depends on r alone, so that K-+ - K++ = K-- - K+- = 2 mu dA/dt, and the
// eigenvalues need no square root: that is the one of (L+, L-) = (K++, K--),
// and K++ - K+- that of (1, 1), along which r is constant.
static void classify(const tf_machine_t *k, tf_two_fold_t *at,
                     tf_real_t through) {
  const tf_real_t mu = k->contact.tyre.mu;
  const tf_real_t scale =
      square_root(magnitude(at->Kpp)) * square_root(magnitude(at->Kmm));
  at->type = (uint8_t)type_of(k, at, scale);
  if (!(scale > 0)) return;
  at->J1 = at->Kmp / scale;
  at->J2 = -at->Kpm / scale;
  at->paper_case = (uint8_t)paper_case_of(at);
  at->through = direction_of(at, through / scale, at->Kmm, -at->Kpp, mu);
  at->across = direction_of(at, (at->Kpp - at->Kpm) / scale, 1, -1, mu);
}

TF_API tf_status_t tf_normal_form(const tf_machine_t *machine,
                                  const tf_input_t *input,
                                  const tf_surface_point_t *point,
                                  tf_two_fold_t *out) {
  const tf_machine_t *k = machine;
  const tf_state_t state = {.r = point->r, .v = point->v, .w = point->w};
  const tf_real_t mu = k->contact.tyre.mu;
  if (!tf_tyre_is_set_valued(k->contact.tyre.law)) return TF_BAD_PARAMETER;
  if (!in_range(&state, input) || point->r == 0 ||
      !(point->g > 0 || point->g < 0))
    return TF_BAD_STATE;
  const field_point_t x =
      field_point_at(k, input, point->r, point->v, point->w, sign_of(point->g));
  const tf_real_t A = x.rates.A[x.s];
  const tf_real_t plus = rate_of_N(k, input, &x, mu);
  const tf_real_t minus = rate_of_N(k, input, &x, -mu);
  const tf_real_t slope = mu * delassus_rate(k, x.r, x.v, x.s, x.J);
  tf_two_fold_t at = {.point = *point,
                      .residual = magnitude(x.rates.N) + mu * magnitude(A),
                      .time_scale = x.J,
                      .Kpp = plus - slope,
                      .Kpm = minus - slope,
                      .Kmp = plus + slope,
                      .Kmm = minus + slope,
                      .plus = field_under(k, input, &x, mu),
                      .minus = field_under(k, input, &x, -mu)};
  if (!within(magnitude(at.Kpp) + magnitude(at.Kpm) + magnitude(at.Kmp) +
                  magnitude(at.Kmm) + size_of_rate(&at.plus) +
                  size_of_rate(&at.minus),
              TF_REAL_MAX))
    return TF_BAD_STATE;
  classify(k, &at, 2 * slope);
  *out = at;
  return TF_OK;
}

// kappa and k2 for a two-fold at a given point. There A = 0, which gives kappa,
// and N = 0, which the spring enters linearly.

static bool in_its_range(size_t offset, tf_real_t value) {
  int i = 0;
  for (int n = 0; n < TF_PARAMETERS; n++)
    if (tf_parameter_ranges[n].offset == offset) i = n;
  return value >= tf_parameter_ranges[i].low &&
         value <= tf_parameter_ranges[i].high;
}

// What can be said before anything is computed.
static tf_design_obstacle_t obstacle_at(const tf_machine_t *k,
                                        const tf_input_t *input, tf_real_t r,
                                        tf_real_t w) {
  const tf_state_t at_r = {.r = r}, at_w = {.w = w};
  if (k->contact.tyre.law != TF_TYRE_JUMP || !(k->contact.tyre.mu > 0))
    return TF_DESIGN_LAW;
  if (!(magnitude(k->sin_gamma) >= TF_MIN_SINE) ||
      !(magnitude(k->cos_gamma) >= TF_MIN_SINE))
    return TF_DESIGN_GAMMA;
  if (r == 0 || !in_range(&at_r, input)) return TF_DESIGN_R;
  if (w - input->omega0 == 0 || !in_range(&at_w, input)) return TF_DESIGN_OMEGA;
  return TF_DESIGN_FOUND;
}

// (singKappa): s kappa from A(r, s) = 0, and (singK2): k2 from N = 0. N is that
// of a spring at rest less k2 times what the spring does to h'.
static tf_design_obstacle_t solve_parameters(const tf_machine_t *k,
                                             const tf_input_t *input,
                                             const tf_surface_point_t *point,
                                             tf_design_t *out) {
  const tf_real_t r = point->r, arm = r * k->cos_gamma;
  const tf_real_t minus_s_kappa = (r * r + delassus_quadratic(k, PLUS).c) / arm;
  tf_input_t spring_at_rest = *input;
  spring_at_rest.r0 = r;
  const field_point_t x =
      field_point_at(k, &spring_at_rest, r, point->v, point->w, PLUS);
  const tf_real_t h_rate_per_k2 =
      (k->sin_gamma / k->m + k->d * arm / x.J) * (input->r0 - r);
  out->kappa = with_sign(sign_of(point->g), -minus_s_kappa);
  if (h_rate_per_k2 == 0) return TF_DESIGN_SPRING;
  out->k2 = x.rates.N / h_rate_per_k2;
  if (!within(out->kappa, TF_REAL_MAX)) return TF_DESIGN_R;
  if (!within(out->k2, TF_REAL_MAX)) return TF_DESIGN_SPRING;
  if (!in_its_range(offsetof(tf_params_t, kappa), out->kappa))
    return TF_DESIGN_KAPPA;
  if (!in_its_range(offsetof(tf_params_t, k2), out->k2)) return TF_DESIGN_K2;
  return TF_DESIGN_FOUND;
}

static tf_design_obstacle_t design_at(const tf_machine_t *machine,
                                      const tf_input_t *input, tf_real_t r,
                                      tf_real_t w, tf_design_t *out) {
  // (stickV): the point of h = 0 at (r, w).
  const tf_real_t z = w - input->omega0, g = r * z / machine->sin_gamma;
  const tf_surface_point_t point = surface_point(machine, r, z, w, g);
  const tf_design_obstacle_t obstacle =
      solve_parameters(machine, input, &point, out);
  if (obstacle == TF_DESIGN_R || obstacle == TF_DESIGN_SPRING) return obstacle;
  // The normal form reads no other constant that depends on kappa or k2.
  tf_machine_t designed = *machine;
  designed.contact.stick_kappa = out->kappa;
  designed.k2 = out->k2;
  return tf_normal_form(&designed, input, &point, &out->two_fold) == TF_OK
             ? obstacle
             : TF_DESIGN_R;
}

TF_API tf_status_t tf_design_two_fold(const tf_machine_t *machine,
                                      const tf_input_t *input, tf_real_t r,
                                      tf_real_t w, tf_design_t *out) {
  tf_design_t design = {0};
  tf_design_obstacle_t obstacle = obstacle_at(machine, input, r, w);
  if (obstacle == TF_DESIGN_FOUND)
    obstacle = design_at(machine, input, r, w, &design);
  if (obstacle != TF_DESIGN_FOUND && obstacle < TF_DESIGN_KAPPA)
    design = (tf_design_t){0};
  design.obstacle = (uint8_t)obstacle;
  *out = design;
  return obstacle == TF_DESIGN_FOUND ? TF_OK : TF_BAD_PARAMETER;
}
