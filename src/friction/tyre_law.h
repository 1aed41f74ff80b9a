// The paper's tyre law, which is evaluated twice in a step of slip; tyre.c has
// the other laws.
#ifndef TF_TYRE_LAW_H
#define TF_TYRE_LAW_H

#include "../num/kernel.h"
#include "mode_set.h"
#include "twofold/contact.h"

// cos(n pi/16); sin(n pi/16) is the same table read backwards.
static const tf_real_t anchor_cos[TF_TYRE_ANCHORS] = {
    TF_R(1.0),
    TF_R(0.98078528040323044913),
    TF_R(0.92387953251128675613),
    TF_R(0.83146961230254523708),
    TF_R(0.70710678118654752440),
    TF_R(0.55557023301960222474),
    TF_R(0.38268343236508977173),
    TF_R(0.19509032201612826785),
    TF_R(0.0)};

// tan((2n+1) pi/32): borders between the anchors below pi/4.
static const tf_real_t border[4] = {
    TF_R(0.098491403357164253077), TF_R(0.30334668360734239168),
    TF_R(0.53451113595079172950), TF_R(0.82067879082866033097)};

// Whether the angle whose tangent is low/high <= 1 lies beyond that border.
TF_INLINE bool is_beyond(int n, tf_real_t low, tf_real_t high) {
  return low > border[n] * high;
}

// tan(a w) of a small angle w by its tangent, |w| <= pi/32: a short odd series,
// whose first left-out term is below small^16/17 = 5e-18 (double), small^8/9 =
// 1e-9 (float) of the first, because |y| <= tan(pi/32) = 0.0985. What
// comes after the first term is summed in pairs, each of which is computed
// while the sum waits for those before it: 5 to 9 % less time of a step.
TF_INLINE tf_real_t cot_psi_near_zero(const tf_tyre_t *tyre, tf_real_t y) {
  const tf_real_t *c = tyre->T_series;
  const tf_real_t y2 = y * y, y4 = y2 * y2;
  tf_real_t sum = c[TF_TYRE_TERMS - 1];
  for (int n = TF_TYRE_TERMS - 3; n > 0; n -= 2)
    sum = c[n] + c[n + 1] * y2 + sum * y4;
  return y * (c[0] + sum * y2);
}

// tan(x + y) by T = tan x and u = tan y. From an anchor at most pi/32 away the
// denominator is >= 1 - tan(a 7 pi/16) tan(a pi/32) > 0.5.
TF_INLINE tf_real_t cot_psi_beyond(tf_real_t T, tf_real_t u) {
  return (T + u) / (1 - T * u);
}

// cot_psi() from an anchor at most pi/32 away: its cosine c, its sine s and its
// entry T of the table.
TF_INLINE tf_real_t cot_psi_from(const tf_tyre_t *tyre, tf_real_t G,
                                 tf_real_t H, tf_real_t c, tf_real_t s,
                                 tf_real_t T) {
  const tf_real_t y = (G * c - H * s) / (H * c + G * s);
  return cot_psi_beyond(T, cot_psi_near_zero(tyre, y));
}

// Whether products with the anchors would lose bits to underflow.
TF_INLINE bool is_near_underflow(tf_real_t high) {
  return high < TF_REAL_MIN / TF_REAL_EPSILON;
}

TF_INLINE tf_real_t cot_psi(const tf_tyre_t *tyre, tf_real_t G, tf_real_t H) {
  const bool steep = G > H;
  tf_real_t low = steep ? H : G, high = steep ? G : H;
  if (is_near_underflow(high)) { // a power of two changes no quotient
    const tf_real_t scale = 1 / (TF_REAL_MIN * 2);
    G *= scale;
    H *= scale;
    low *= scale;
    high *= scale;
    if (high == 0) return 0;
  }
  const int from_axis = is_beyond(0, low, high) + is_beyond(1, low, high) +
                        is_beyond(2, low, high) + is_beyond(3, low, high);
  const int anchor = steep ? 8 - from_axis : from_axis;
  return cot_psi_from(tyre, G, H, anchor_cos[anchor], anchor_cos[8 - anchor],
                      tyre->T_anchor[anchor]);
}

// As a function, to save code size.
#define tf_cot_psi TF_LINK(tf_cot_psi)
TF_API tf_real_t tf_cot_psi(const tf_tyre_t *tyre, tf_real_t G, tf_real_t H);

// The law of slip, (force) and (moment), is affine in T:
//   F = F0 + F1 T,  M = M1 T,
// with T >= 0 and, by the signs of h and g, F0 = sign(h) 4 mu/3, F1 = -sign(h)
// mu/(18 kappa), M1 = sign(h) sign(g) mu/6.
// So |F| falls from 4 mu/3, where |h| << |g|, by 1/(3 kappa) of |M|.
#define MAX_SLIP_FORCE(mu) ((mu)*4 / 3)
#define MOMENT_BY_FORCE TF_R(3.0) // -d(|M|/kappa)/d|F|

TF_INLINE tf_real_t slip_F0(const tf_tyre_t *tyre, sign_t sign) {
  return with_sign(sign, MAX_SLIP_FORCE(tyre->mu));
}

TF_INLINE tf_real_t slip_F1(const tf_tyre_t *tyre, sign_t sign) {
  return with_sign(sign, -tyre->mu * tyre->inv_18_kappa);
}

TF_INLINE tf_real_t slip_M1(const tf_tyre_t *tyre, sign_t sign) {
  return with_sign(sign, tyre->mu / 6);
}

// The same in units of mu and kappa mu, for positive signs.
typedef struct {
  tf_real_t x, y;
} multipliers_t;

TF_INLINE multipliers_t multipliers_at(const tf_tyre_t *tyre, tf_real_t T) {
  return (multipliers_t){MAX_SLIP_FORCE(TF_R(1.0)) - T * tyre->inv_18_kappa,
                         T * tyre->inv_6_kappa};
}

// Whether the force of a slip differs by more than 1/16 of the largest from
// that of its start.
TF_INLINE bool force_turns(multipliers_t first, multipliers_t then) {
  return magnitude(then.x - first.x) + magnitude(then.y - first.y) >
         TF_R(0x1p-4);
}

// With the signs of h and g.
TF_INLINE multipliers_t signed_multipliers(multipliers_t m, sign_t sign_h,
                                           sign_t sign_g) {
  const tf_real_t side = unit(sign_h);
  return (multipliers_t){side * m.x, with_sign(sign_g, side * m.y)};
}

TF_INLINE multipliers_t jump_multipliers(const tf_tyre_t *tyre, sign_t side,
                                         tf_slip_t at) {
  const tf_real_t H = unit(side) * at.h;
  const tf_real_t T = cot_psi(tyre, magnitude(at.g), H > 0 ? H : 0);
  return signed_multipliers(multipliers_at(tyre, T), side, sign_of(at.g));
}

// The same as a function, to save code size.
#define tf_jump_multipliers TF_LINK(tf_jump_multipliers)
TF_API multipliers_t tf_jump_multipliers(const tf_tyre_t *tyre, sign_t side,
                                         tf_slip_t at);

// The constants of a contact from its parameters: for tf_contact_prepare, and
// for tf_prepare, which has more laws.

// Ranges: of mu [N], kappa [m] and a rate [1/s].
#define MAX_MU 1e9
#define MIN_KAPPA 1e-9
#define MAX_KAPPA 1e6
#define MAX_RATE 1e9

// The tables of the angle kernel, and the constants of its multipliers.
#define tf_prepare_angle_kernel TF_LINK(tf_prepare_angle_kernel)
TF_API void tf_prepare_angle_kernel(tf_tyre_t *tyre, tf_real_t kappa);

// All that is not its tyre, which is complete.
#define tf_complete_contact TF_LINK(tf_complete_contact)
TF_API void tf_complete_contact(tf_contact_t *contact, tf_rest_law_t rest,
                                tf_rule_t rule, tf_real_t rate_dt);

#endif
