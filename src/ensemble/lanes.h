// Functions of a step without branches, for one lane of a block: every value is
// computed, then one is picked by a mask, so that the compiler can do several
// lanes at once. The formulas are functions of inclusion.h, tyre_law.h and
// linear.h, hence the same bits; only the choice between them is made here.
// Where a rare case needs more (a square root, a rescaling) the lane is marked
// rare and left to tf_step.
//
// gcc makes branches of ?: where an operation may trap: hence masks.
#ifndef TF_LANES_H
#define TF_LANES_H

#include "../friction/inclusion.h"
#include "../friction/tyre_law.h"
#include "../moreau/linear.h"

// As wide as tf_real_t: all ones for true, 0 for false.
#ifdef TF_REAL_FLOAT
typedef uint32_t mask_t;
#else
typedef uint64_t mask_t;
#endif

// Lanes that a vector of AVX2 has.
#define GROUP ((int)(32 / sizeof(tf_real_t)))

typedef union {
  tf_real_t real;
  mask_t bits;
} lane_bits_t;

TF_INLINE mask_t bits_of(tf_real_t x) { return (lane_bits_t){.real = x}.bits; }

TF_INLINE tf_real_t real_of(mask_t bits) {
  return (lane_bits_t){.bits = bits}.real;
}

TF_INLINE mask_t when(bool condition) {
  return bits_of(condition ? real_of(~(mask_t)0) : 0);
}

// mask ? a : b
TF_INLINE tf_real_t pick(mask_t mask, tf_real_t a, tf_real_t b) {
  return real_of((mask & bits_of(a)) | (~mask & bits_of(b)));
}

// mask ? a : 0
TF_INLINE tf_real_t keep(mask_t mask, tf_real_t a) {
  return real_of(mask & bits_of(a));
}

// mask ? -a : a
TF_INLINE tf_real_t flip_sign(mask_t mask, tf_real_t a) {
  return real_of(bits_of(a) ^ (mask & bits_of(TF_R(-0.0))));
}

// root_within() where its series will do and needs no clipping.
typedef struct {
  tf_real_t x;
  mask_t rare;
} lane_root_t;

TF_INLINE lane_root_t lane_root(tf_real_t c0, tf_real_t c1, tf_real_t c2) {
  const linear_root_t from = linear_root(c0, c1, c2);
  const tf_real_t x = perturbed_root(from.x1, from.q);
  const mask_t series =
      when(series_suffices(from.q)) & ~when(is_negligible(c1));
  return (lane_root_t){x, ~(series & when(within(x, 1)))};
}

// Whether moment_share() is -1, where it is +1 or -1. Masks: g+ > 0 follows
// from s = +1, g+ < 0 from s = -1 (if neither, the share is a root between);
// the slip solves with s = +1, with s = -1; the present g prefers s = +1.
TF_INLINE mask_t share_down(mask_t g_plus, mask_t g_minus, mask_t plus_slips,
                            mask_t minus_slips, mask_t prefer_plus) {
  const mask_t tie = (prefer_plus & plus_slips) | ~(prefer_plus | minus_slips);
  return ~(g_plus & (tie | ~g_minus));
}

// bends()
TF_INLINE mask_t lane_bends(tf_real_t plus, tf_real_t minus, tf_real_t bend) {
  return when(magnitude(plus - minus) < 4 * magnitude(bend));
}

// has_signs_of_mode() of a slip, of a stick (rolls) or of rest.
TF_INLINE mask_t lane_has_signs(mask_t slips, mask_t rolls, mask_t minus,
                                tf_slip_t slip, tf_real_t rounding) {
  const mask_t beside = when(flip_sign(minus, slip.h) >= -rounding);
  const mask_t on = when(within(slip.h, rounding));
  const mask_t forward = when(flip_sign(minus, slip.g) >= -rounding);
  const mask_t rests = when(within(slip.g, rounding));
  return (slips & beside) |
         (~slips & on & ((rolls & forward) | (~rolls & rests)));
}

// may_vanish() without its division, and a little wider: a lane that is rare in
// vain has the same bits.
TF_INLINE mask_t lane_may_vanish(const tf_form_t *f, tf_real_t now) {
  return when(within(now, magnitude(f->c0 - now) +
                              TF_R(1.334) * magnitude(f->cx) +
                              magnitude(f->cy)));
}

// pinning_force(). can: can_be_pinned(), the same for all lanes.
TF_INLINE tf_force_t lane_pin(const tf_machine_t *k, mask_t can,
                              const linear_t *l) {
  const tf_force_t pin = friction_to_rest(k, l);
  return (tf_force_t){pick(can, pin.F, unpinnable.F),
                      pick(can, pin.M, unpinnable.M)};
}

// Which borders between the anchors of cot_psi() lie below the angle, and
// whether it is measured from pi/2.
typedef struct {
  mask_t b0, b1, b2, b3, steep;
} lane_angle_t;

// Entry n or 8 - n of a table of anchors, n counted by the borders crossed.
TF_INLINE tf_real_t anchored(const tf_real_t table[TF_TYRE_ANCHORS],
                             lane_angle_t at, mask_t steep) {
  const tf_real_t t0 = pick(steep, table[8], table[0]);
  const tf_real_t t1 = pick(steep, table[7], table[1]);
  const tf_real_t t2 = pick(steep, table[6], table[2]);
  const tf_real_t t3 = pick(steep, table[5], table[3]);
  return pick(at.b3, table[4],
              pick(at.b2, t3, pick(at.b1, t2, pick(at.b0, t1, t0))));
}

// jump_multipliers() off the neighbourhood of h = g = 0 in which products with
// the anchors would lose bits.
typedef struct {
  tf_real_t x, y;
  mask_t rare;
} lane_multipliers_t;

TF_INLINE lane_multipliers_t lane_multipliers(const tf_tyre_t *tyre,
                                              tf_real_t side, tf_slip_t slip) {
  const tf_real_t h = side * slip.h, H = keep(when(h > 0), h);
  const tf_real_t G = magnitude(slip.g);
  const mask_t steep = when(G > H);
  const tf_real_t low = pick(steep, H, G), high = pick(steep, G, H);
  const lane_angle_t at = {
      when(is_beyond(0, low, high)), when(is_beyond(1, low, high)),
      when(is_beyond(2, low, high)), when(is_beyond(3, low, high)), steep};
  const tf_real_t T = cot_psi_from(tyre, G, H, anchored(anchor_cos, at, steep),
                                   anchored(anchor_cos, at, ~steep),
                                   anchored(tyre->T_anchor, at, steep));
  const multipliers_t m = multipliers_at(tyre, T);
  return (lane_multipliers_t){side * m.x,
                              flip_sign(when(slip.g < 0), side * m.y),
                              when(is_near_underflow(high))};
}

// law_residual() as mode_residual() of report.h calls it: in slip only the
// side is checked.
TF_INLINE tf_real_t lane_residual(const tf_machine_t *k, mask_t slips,
                                  mask_t minus, tf_force_t force,
                                  tf_slip_t slip) {
  const tf_real_t F = pick(slips, flip_sign(minus, 1), force.F);
  const tf_real_t mu = pick(slips, 1, k->contact.tyre.mu);
  const tf_real_t natural = force_residual(mu, F, slip.h);
  const tf_real_t M = k->contact.stick_kappa * force.F;
  const tf_real_t rolling = magnitude(force.M - flip_sign(when(slip.g < 0), M));
  const tf_real_t between = distance_to_segment(force.M, M);
  const tf_real_t of_moment =
      pick(when(slip.g > 0) | when(slip.g < 0), rolling, between);
  return natural + keep(~slips, of_moment);
}

#endif
