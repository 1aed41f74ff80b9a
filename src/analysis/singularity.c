// Where two-folds lie and what they are. h' = N - A lambda on h = 0, so that a
// two-fold is A = N = 0. See the header for the scheme of each function.
#include "twofold/singularity.h"

#include "field.h"

// Below this sin(gamma) is rounding of gamma = 0 or pi.
#define NO_SINE (4 * TF_REAL_EPSILON)

TF_API const char *tf_absence_name(unsigned lack) {
  static const char *const names[TF_ABSENCES] = {
      "there is one", "the friction does not jump at h = 0",
      "without a moment in stick the Delassus scalar is positive everywhere",
      "kappa |cos gamma| < 2 beta |sin gamma|: the Delassus scalar is positive "
      "everywhere",
      "where the Delassus scalar vanishes, nothing balances h with the sign of "
      "g that this takes"};
  return lack < TF_ABSENCES ? names[lack] : "unknown";
}

TF_API const char *tf_folds_name(unsigned type) {
  static const char *const names[TF_FOLDS] = {
      "invisible", "visible", "visible-invisible", "degenerate", "continuous"};
  return type < TF_FOLDS ? names[type] : "unknown";
}

TF_INLINE tf_real_t largest(tf_real_t a, tf_real_t b) { return a > b ? a : b; }

// Real roots of a x^2 + b x + c, the one of larger magnitude first; equal ones
// once, and 0 not where it is a double one. Scaled by the largest coefficient,
// so that no square overflows.
static int roots(tf_real_t a, tf_real_t b, tf_real_t c, tf_real_t x[2]) {
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

// The r > 0 or r < 0 of A(r, s) = 0 for s kappa cos(gamma) = b:
//   r^2 + b r + beta^2 sin^2(gamma) = 0.
// Its discriminant is (|b| - 2 beta |sin|)(|b| + 2 beta |sin|): no square that
// cancels another.
static int singular_radii(tf_real_t b, tf_real_t beta2, tf_real_t sine,
                          tf_real_t r[2]) {
  const tf_real_t size = magnitude(b);
  const tf_real_t reach = 2 * square_root(beta2) * magnitude(sine);
  if (!(size >= reach)) return 0; // size = 0: cos = 0, then sin is not
  const tf_real_t root = square_root((size - reach) * (size + reach));
  const tf_real_t outer = (size + root) / 2;
  const tf_real_t inner = beta2 * sine / outer * sine;
  r[0] = b > 0 ? -outer : outer;
  r[1] = b > 0 ? -inner : inner;
  return inner > 0 && inner < outer ? 2 : 1;
}

// N(g) = n[0] + n[1] g + n[2] g^2 along h = 0 at one r: w = omega0 + zeta g,
// v = nu g. Q_r, Q_phi and v z collected by powers of g.
static void balance(const tf_machine_t *k, const tf_input_t *input,
                    tf_real_t sine, tf_real_t r, tf_real_t n[3]) {
  const tf_real_t cosine = k->cos_gamma, m = k->m, w0 = input->omega0;
  const tf_real_t zeta = sine / r, nu = k->d * zeta - cosine;
  const tf_real_t Q_r[3] = {
      k->k2 * (input->r0 - r) + input->force + m * r * w0 * w0,
      2 * m * w0 * sine - k->c2 * nu, m * sine * zeta};
  const tf_real_t Q_phi[3] = {input->torque - k->c1 * w0,
                              -k->c1 * zeta - 2 * m * r * nu * w0,
                              -2 * m * nu * sine};
  const tf_real_t share = cosine * r / inertia_at(k, r);
  for (int i = 0; i < 3; i++)
    n[i] = -sine * Q_r[i] / m - share * (Q_phi[i] + k->d * Q_r[i]);
  n[0] += input->alpha * (r * cosine - k->d * sine);
  n[2] -= cosine * nu * zeta;
}

// The places of one r and s.
static int places_at(const tf_machine_t *k, const tf_input_t *input,
                     tf_real_t sine, tf_real_t r, bool minus,
                     tf_surface_point_t *out) {
  tf_real_t n[3], g[2];
  balance(k, input, sine, r, n);
  const int most = roots(n[2], n[1], n[0], g);
  int count = 0;
  for (int i = 0; i < most; i++) {
    const tf_real_t z = sine / r * g[i];
    const tf_surface_point_t place = {r, k->d * z - k->cos_gamma * g[i],
                                      input->omega0 + z, g[i]};
    if ((minus ? g[i] < 0 : g[i] > 0) && in_reach(r, place.v, place.w))
      out[count++] = place;
  }
  return count;
}

// What there is no two-fold without, whatever the motion.
static tf_absence_t lack_of(const tf_machine_t *k, tf_real_t sine) {
  tf_real_t r[2];
  if (!tf_tyre_is_set_valued(k->tyre.law) || !(k->tyre.mu > 0))
    return TF_ABSENCE_LAW;
  if (!(k->stick_kappa > 0)) return TF_ABSENCE_MOMENT;
  return singular_radii(k->stick_kappa * k->cos_gamma, k->beta2, sine, r) > 0
             ? TF_ABSENCE_NONE
             : TF_ABSENCE_ARM;
}

TF_API tf_status_t tf_two_folds(const tf_machine_t *machine,
                                const tf_input_t *input,
                                tf_surface_point_t places[TF_TWO_FOLDS],
                                int *count, tf_absence_t *lack) {
  const tf_machine_t *k = machine;
  const tf_state_t still = {.r = 0};
  if (!in_range(&still, input)) return TF_BAD_STATE;
  const tf_real_t sine =
      within(k->sin_gamma, NO_SINE) ? TF_R(0.0) : k->sin_gamma;
  const tf_real_t b = k->stick_kappa * k->cos_gamma;
  const tf_absence_t why = lack_of(k, sine);
  int found = 0;
  for (int s = 0; s < 2 && why == TF_ABSENCE_NONE; s++) {
    tf_real_t r[2];
    const int radii = singular_radii(s ? -b : b, k->beta2, sine, r);
    for (int i = 0; i < radii; i++)
      found += places_at(k, input, sine, r[i], s > 0, places + found);
  }
  *count = found;
  if (lack)
    *lack = why != TF_ABSENCE_NONE || found > 0 ? why : TF_ABSENCE_BALANCE;
  return TF_OK;
}

// d/dt of N along f(x, lambda).
static tf_real_t slope_of_N(const tf_machine_t *k, const tf_input_t *input,
                            const field_point_t *x, tf_real_t lambda) {
  const tf_rate_t f = field(k, input, x, lambda);
  const tf_real_t r = x->r, v = x->v, w = x->w, m = k->m, J = x->J;
  const tf_real_t dr = f.r, dv = f.v, dw = f.w, dz = f.w - input->alpha;
  const tf_real_t dQ_r = radial_force_rate(k, r, w, dr, dv, dw);
  const tf_real_t dQ_phi = disc_torque_rate(k, r, v, w, dr, dv, dw);
  const tf_real_t turn =
      (dQ_phi + k->d * dQ_r - (x->a.z + input->alpha) * 2 * m * r * dr) / J;
  const tf_real_t dq = dr * x->a.z + r * turn + dv * x->z + v * dz;
  return -k->sin_gamma * dQ_r / m - k->cos_gamma * dq;
}

// d/dt of A = sin^2(gamma)/m + arm (arm + s kappa)/J, under any lambda: A
// depends on r alone, and dr/dt = v.
static tf_real_t slope_of_A(const tf_machine_t *k, const field_point_t *x) {
  const tf_real_t darm = x->v * k->cos_gamma, dJ = 2 * k->m * x->r * x->v;
  return (darm * (x->turn + x->arm) - x->arm * x->lever * dJ) / x->J;
}

// plus is not 0.
static tf_direction_t ray_of(const tf_two_fold_t *at, tf_real_t value,
                             tf_real_t plus, tf_real_t minus, tf_real_t mu) {
  tf_direction_t ray = {.value = value};
  const tf_real_t size = magnitude(plus) + magnitude(minus);
  const tf_real_t unit = plus < 0 ? -size : size;
  ray.plus = plus / unit;
  ray.minus = minus / unit;
  ray.sticks = ray.minus >= 0;
  ray.lambda = ray.sticks ? mu * (ray.plus - ray.minus) : 0;
  ray.velocity = (tf_rate_t){ray.plus * at->plus.r + ray.minus * at->minus.r,
                             ray.plus * at->plus.v + ray.minus * at->minus.v,
                             ray.plus * at->plus.w + ray.minus * at->minus.w};
  return ray;
}

// scale = sqrt|K++ K--| is 0 only where one of them is: a root of the least
// number is far from the least number.
static unsigned type_of(const tf_machine_t *k, const tf_two_fold_t *at,
                        tf_real_t scale) {
  if (within(k->sin_gamma, NO_SINE)) return TF_FOLDS_CONTINUOUS;
  if (!(scale > 0)) return TF_FOLDS_DEGENERATE;
  if ((at->Kpp > 0) == (at->Kmm > 0)) return TF_FOLDS_MIXED;
  return at->Kpp < 0 ? TF_FOLDS_INVISIBLE : TF_FOLDS_VISIBLE;
}

// Cases 1 to 3; case 3 is J1 J2 < 1.
static unsigned regime_of(const tf_two_fold_t *at) {
  if (at->type != TF_FOLDS_INVISIBLE) return 0;
  const tf_real_t product = at->J1 * at->J2;
  if (product < 1) return 3;
  if (!(product > 1)) return 0;
  return at->J1 < 0 ? 1 : 2;
}

// A depends on r alone, so that K-+ - K++ = K-- - K+- = 2 mu dA/dt, and the
// eigenvalues need no square root: (L+, L-) = (K++, K--) goes with the former,
// and (1, 1), which is r = const, with K++ - K+-.
static void classify(const tf_machine_t *k, tf_two_fold_t *at,
                     tf_real_t through) {
  const tf_real_t mu = k->tyre.mu;
  const tf_real_t scale =
      square_root(magnitude(at->Kpp)) * square_root(magnitude(at->Kmm));
  at->type = (uint8_t)type_of(k, at, scale);
  if (!(scale > 0)) return;
  at->J1 = at->Kmp / scale;
  at->J2 = -at->Kpm / scale;
  at->regime = (uint8_t)regime_of(at);
  at->through = ray_of(at, through / scale, at->Kmm, -at->Kpp, mu);
  at->across = ray_of(at, (at->Kpp - at->Kpm) / scale, 1, -1, mu);
}

TF_API tf_status_t tf_normal_form(const tf_machine_t *machine,
                                  const tf_input_t *input,
                                  const tf_surface_point_t *place,
                                  tf_two_fold_t *out) {
  const tf_machine_t *k = machine;
  const tf_state_t state = {.r = place->r, .v = place->v, .w = place->w};
  const tf_real_t mu = k->tyre.mu;
  if (!tf_tyre_is_set_valued(k->tyre.law)) return TF_BAD_PARAMETER;
  if (!in_range(&state, input) || place->r == 0 ||
      !(place->g > 0 || place->g < 0))
    return TF_BAD_STATE;
  const field_point_t x =
      point_at(k, input, place->r, place->v, place->w, place->g < 0);
  const tf_real_t A = x.a.A[x.s];
  const tf_real_t plus = slope_of_N(k, input, &x, mu);
  const tf_real_t minus = slope_of_N(k, input, &x, -mu);
  const tf_real_t slope = mu * slope_of_A(k, &x);
  tf_two_fold_t at = {.place = *place,
                      .rest = magnitude(x.a.N) + mu * magnitude(A),
                      .clock = x.J,
                      .Kpp = plus - slope,
                      .Kpm = minus - slope,
                      .Kmp = plus + slope,
                      .Kmm = minus + slope,
                      .plus = field(k, input, &x, mu),
                      .minus = field(k, input, &x, -mu)};
  if (!within(magnitude(at.Kpp) + magnitude(at.Kpm) + magnitude(at.Kmp) +
                  magnitude(at.Kmm) + size_of_rate(&at.plus) +
                  size_of_rate(&at.minus),
              TF_REAL_MAX))
    return TF_BAD_STATE;
  classify(k, &at, 2 * slope);
  *out = at;
  return TF_OK;
}
