// What a linearly implicit step does to the energy. Its rows (6) are those of
// a step that balances energy exactly, but for what linearisation leaves out.
// So the energy that the step creates is known in closed form: a sum of
// products of differences, in which nothing large cancels. With v_t = v +
// theta dv, w_t alike, v_a, w_a and r_a the means of the two ends, J_a the mean
// of m (beta^2 + r^2) and eta = theta - 1/2,
//   E+ - E = work of inputs, dampers and friction at (v_t, w_t), arm r_t, + D
//   D = (J_a - J(r_t)) w_t dw - eta (m dP^2 + J_a dw^2 + k2 dt^2 v_t^2)
//       + m dt [ r_a v_t (w_a^2 + dw^2/4) - r_t v_t (w_t^2 + theta^2 dw^2)
//                + 2 theta^2 r_t w_t dv dw ]                          (17)
#ifndef TF_BALANCE_H
#define TF_BALANCE_H

#include "../friction/mode_set.h"
#include "linear.h"

// The most energy that a step may create, as a share of the mean of its ends: n
// steps create at most exp(n / 4096) - 1 of the energy, so that the 4000 steps
// of docs/BENCH.md, Stability, stay within its factor of 4.
#define TF_CREATED_SHARE TF_R(0x1p-12)

// The most of that in the periods of a stiff spring, see grows(), where the
// balanced step of balanced.c takes the place of one that creates more.
#define TF_GROWTH_SHARE TF_R(0x1p-20)

// The most that friction may put in, where h passes 0 within the step: once, of
// second order in dt, and friction takes it out again.
#define TF_FRICTION_SHARE TF_R(0x1p-4)

// What an impulse changes, squared, as a share of the sum of both ends: more
// than a third of the velocities.
#define TF_IMPULSE_SHARE TF_R(0x1p-4)

// What a slip that ends in a step that is not split may change, squared.
#define TF_ENDING_SHARE TF_R(0x1p-12)

// What the turn of a force within a step may change, squared, likewise.
#define TF_TURN_SHARE TF_R(0x1p-11)

// How much of it a step with theta > 1/2 may damp out.
#define TF_DAMPED_SHARE TF_R(0.25)

// (17) for every theta.
TF_INLINE tf_real_t created_by_theta(const tf_machine_t *k, tf_real_t r,
                                     tf_real_t v, tf_real_t w, tf_real_t dv,
                                     tf_real_t dw) {
  const tf_real_t th = k->theta, th2 = th * th, eta = th - TF_R(0.5);
  const tf_real_t dt = k->dt, dP = ground_speed(k, dv, dw), dw2 = dw * dw;
  const tf_real_t vt = v + th * dv, wt = w + th * dw, wa = w + dw / 2;
  const tf_real_t travel = dt * vt, rt = r_at_theta(k, r, v);
  const tf_real_t ahead = dt * (th * dv / 2 - eta * v), ra = rt + ahead;
  const tf_real_t dJ =
      ahead * (ra + rt) + travel * travel / 4; // (J_a - J(r_t)) / m
  const tf_real_t centrifugal =
      ra * (wa * wa + dw2 / 4) - rt * (wt * wt + th2 * dw2);
  const tf_real_t damped = dP * dP + (k->beta2 + rt * rt + dJ) * dw2;
  return k->m * (dJ * wt * dw + travel * centrifugal +
                 2 * th2 * dt * rt * wt * dv * dw - eta * damped) -
         eta * k->k2 * (travel * travel);
}

// What a step has done, from a state (r, v, w) to an end under a force F. With
// P = v - d w, s = r - r0:
typedef struct {
  tf_real_t created;  // D, (17) [J]
  tf_real_t friction; // dt times -F h_t: > 0 where friction puts energy in [J]
  tf_real_t product;  // m (P P+ + (beta^2 + r r+) w w+) + k2 s s+ [J]
  tf_real_t across;   // r r+: <= 0 across the axis [m^2]
} balance_t;

// At theta = 1/2
//   D = m [w_t dw (r_t dt dv + dt^2 v+^2/4) + dt^2 v_t dv w^2/4]
TF_INLINE bool is_midpoint(const tf_machine_t *k) {
  return k->theta == TF_R(0.5);
}

// midpoint: is_midpoint(k), formed once for all lanes.
TF_INLINE balance_t balance_of(const tf_machine_t *k, bool midpoint,
                               const tf_input_t *u, end_state_t from,
                               end_state_t end, tf_real_t F) {
  const tf_real_t r = from.r, v = from.v, w = from.w;
  const tf_real_t dv = end.v - v, dw = end.w - w, dt_dv = k->dt * dv;
  const tf_real_t vt = v + k->theta * dv, wt = w + k->theta * dw;
  const tf_real_t rt = r_at_theta(k, r, v), move = k->theta_dt * vt;
  const tf_real_t P = ground_speed(k, v, w);
  const tf_real_t end_P = ground_speed(k, end.v, end.w);
  const tf_real_t half = k->theta_dt * end.v;
  balance_t b;
  b.created = midpoint ? k->m * (wt * dw * (rt * dt_dv + half * half) +
                                 move * dt_dv * (w * w) / 2)
                       : created_by_theta(k, r, v, w, dv, dw);
  // -h of slip_from_pq, written out for 1 % of a step: F on the arm r_t, the
  // turntable of the theta point under the wheel as it moves.
  const tf_real_t omega0 = speed_at_theta(k, u);
  b.friction = k->dt * F *
               (slider_speed(k, vt, wt - omega0) * k->sin_gamma +
                (rt * wt - (r + move) * omega0) * k->cos_gamma);
  b.across = r * end.r;
  b.product = k->m * (P * end_P + (k->beta2 + b.across) * (w * end.w)) +
              k->k2 * ((r - u->r0) * (end.r - u->r0));
  return b;
}

// Whether a step needs no further check. The product is at most twice the mean
// energy of the ends, which need not be known then.
TF_INLINE bool is_balanced(const balance_t *b) {
  const tf_real_t most = TF_GROWTH_SHARE / 2 * b->product;
  const tf_real_t share = TF_CREATED_SHARE / 2 * b->product;
  return (b->created <= most) & (-b->created <= share) &
         (b->created + b->friction <= share) & (b->across > 0);
}

// The mean energy of the ends of a step.
TF_INLINE tf_real_t mean_energy(const tf_machine_t *k, const tf_input_t *u,
                                end_state_t from, end_state_t to) {
  return (twice_energy(k, from.r, from.v, from.w, u->r0) +
          twice_energy(k, to.r, to.v, to.w, u->r0)) /
         4;
}

// Whether a slip that goes on, or a motion without friction, creates more than
// it may in every period of a spring: where dt times its rate is 1/45 rad or
// more. What a pass of r = 0 creates it takes back. A slip that changes sides
// passes h = 0 as the law says and not as the balanced step does.
TF_INLINE bool grows(const tf_machine_t *k, const balance_t *b,
                     tf_real_t energy, bool slips_on) {
  return slips_on && b->created > TF_GROWTH_SHARE * energy &&
         TF_R(0x1p13) * k->a >= k->m;
}

TF_INLINE bool creates_energy(const balance_t *b, tf_real_t energy) {
  return !(b->created <= TF_CREATED_SHARE * energy &&
           b->created + b->friction <= TF_FRICTION_SHARE * energy);
}

// Whether a slip ends in stick or rest within a step: then the direction of
// its force has changed to that at the end, the only one the step computes.
TF_INLINE bool ends_slip(unsigned from, unsigned mode) {
  return is_slip(from) && !is_slip(mode);
}

// Whether a slip loses its mode within a step. One that is consistent goes on.
TF_INLINE bool loses_slip(unsigned from, unsigned mode) {
  return is_slip(from) && mode != from;
}

// Whether the motion turns by 1/sqrt(n) rad or more in a step: the disc, or the
// slider past the axis.
TF_INLINE bool turns_by_much(const tf_machine_t *k, end_state_t at,
                             tf_real_t n) {
  const tf_real_t R2 = gyration2_at(k, at.r);
  const tf_real_t travel2 = at.v * at.v + R2 * (at.w * at.w);
  return !(n * (k->dt * k->dt) * travel2 < R2);
}

// Whether dt times a rate of the motion is large: of its turn 1/sqrt(n) rad, of
// spring and damper 1 rad (a is theta^2 dt^2 k2 where they are stiff).
TF_INLINE bool is_fast(const tf_machine_t *k, end_state_t at, tf_real_t n) {
  const tf_real_t R2 = gyration2_at(k, at.r), d2 = k->d * k->d;
  return 4 * k->a * (R2 + d2) >= k->m * R2 || turns_by_much(k, at, n);
}

// Whether a step is too long for a pass of the axis: it takes the wheel across
// by more than 2 beta, or begins or ends so fast beside the axis that one such
// step more is a turn of 1.5 rad. It skips that the inertia changes by a factor
// of (beta^2 + r^2)/beta^2 and that the disc may turn by half a turn.
TF_INLINE bool jumps_axis(const tf_machine_t *k, const balance_t *b,
                          end_state_t from, end_state_t to) {
  const tf_real_t by = to.r - from.r, n = TF_R(0.444); // 1/1.5^2
  return (b->across <= 0 && by * by > 4 * k->beta2) ||
         turns_by_much(k, from, n) || turns_by_much(k, to, n);
}

// Whether a step is too long for the motion: in the norm of the energy the
// phase advances by more than a right angle, or theta > 1/2 damps it visibly;
// and not because outer forces do that where it has next to no energy.
TF_INLINE bool is_too_coarse(const tf_machine_t *k, const balance_t *b,
                             tf_real_t energy, end_state_t from,
                             end_state_t to) {
  const bool keeps = b->product >= 0 && b->created >= -TF_DAMPED_SHARE * energy;
  return !keeps && (is_fast(k, from, 1) || is_fast(k, to, 1));
}

#endif
