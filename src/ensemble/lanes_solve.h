// The first passes of a block: the motion without friction and the whole
// solution set of each lane, in loops without a branch on data. Most lanes have
// a g+ of one sign, and one root is all that they need. Where it can have both,
// near h = g = 0, two more roots and the forces of rest are wanted, 7 of 12
// divisions: a group of lanes that a vector holds goes through these passes
// only where one of them needs that. They hand on by memory what would make
// compilers thread one comparison into the next, which leaves branches.
//
// Only ensemble.c includes this. Compiled as a source of its own it makes a
// block take up to 4 % more instructions (gcc, float with AVX2).
#ifndef TF_LANES_SOLVE_H
#define TF_LANES_SOLVE_H

#include "lanes.h"
#include "twofold/ensemble.h"

// tf_form_t of all lanes.
typedef struct {
  tf_real_t c0[TF_LANES], cx[TF_LANES], cy[TF_LANES];
  tf_real_t cxx[TF_LANES], cxy[TF_LANES], cyy[TF_LANES];
} lane_form_t;

// What one pass hands to the next, member by member.
typedef struct {
  tf_real_t p[TF_LANES], z[TF_LANES]; // linear_t
  tf_real_t free_p[TF_LANES], free_z[TF_LANES];
  tf_real_t r_explicit[TF_LANES], arm[TF_LANES];
  tf_real_t p_b[TF_LANES], p_t[TF_LANES], p_c[TF_LANES];
  tf_real_t z_t[TF_LANES], z_c[TF_LANES];
  tf_real_t p_by_x[TF_LANES], z_by_x[TF_LANES]; // responses to F = mu
  tf_real_t p_by_y[TF_LANES], z_by_y[TF_LANES]; // and to M = kappa mu
  lane_form_t h, g;
  mask_t above[TF_LANES], below[TF_LANES]; // sign of g+; neither: both
  tf_real_t root[2][TF_LANES];             // x of stick+, stick-
  tf_real_t tau[2][TF_LANES]; // tf_contact_modes_t, as what follows
  tf_real_t departure[2][TF_LANES];
  mask_t set[TF_LANES], attracting[TF_LANES];
  mask_t nearer_minus[TF_LANES];              // near_stick is stick-
  tf_real_t pin_F[TF_LANES], pin_M[TF_LANES]; // pinning force
  mask_t rare[TF_LANES];                      // tf_step has to do it
  mask_t bit[TF_LANES];       // TF_MODE_BIT of the mode; at first 0: pinned
  uint8_t mode[TF_LANES];     // chosen
  uint8_t slipping[TF_LANES]; // indices of the lanes that slip
  mask_t slips[TF_LANES], rolls[TF_LANES]; // whether the mode is slip, stick
  mask_t minus[TF_LANES];                  // slip- or stick-
  tf_real_t now_g[TF_LANES];               // at the start of a slip
  tf_real_t first_x[TF_LANES], first_y[TF_LANES]; // multipliers there
  tf_real_t theta_x[TF_LANES], theta_y[TF_LANES]; // and at the theta point
  tf_real_t x[TF_LANES], y[TF_LANES];             // multipliers
  tf_real_t F[TF_LANES], M[TF_LANES];             // end_state_t
  tf_real_t r[TF_LANES], v[TF_LANES], w[TF_LANES];
  tf_real_t end_h[TF_LANES], end_g[TF_LANES]; // slip there
  mask_t stays[TF_LANES];                     // r is as it was: it may stall
} work_t;

TF_INLINE linear_t linear_of(const work_t *work, tf_real_t omega0, int i) {
  return (linear_t){.omega0 = omega0,
                    .p = work->p[i],
                    .z = work->z[i],
                    .free = {work->free_p[i], work->free_z[i]},
                    .r_explicit = work->r_explicit[i],
                    .arm = work->arm[i],
                    .p_b = work->p_b[i],
                    .p_t = work->p_t[i],
                    .p_c = work->p_c[i],
                    .z_t = work->z_t[i],
                    .z_c = work->z_c[i]};
}

TF_INLINE void put_form(lane_form_t *to, const tf_form_t *f, int i) {
  to->c0[i] = f->c0;
  to->cx[i] = f->cx;
  to->cy[i] = f->cy;
  to->cxx[i] = f->cxx;
  to->cxy[i] = f->cxy;
  to->cyy[i] = f->cyy;
}

TF_INLINE tf_form_t form_of(const lane_form_t *f, int i) {
  return (tf_form_t){f->c0[i],  f->cx[i],  f->cy[i],
                     f->cxx[i], f->cxy[i], f->cyy[i]};
}

static void linearise_all(const tf_machine_t *restrict k,
                          const tf_state_block_t *restrict b,
                          const tf_input_t *restrict u, work_t *restrict work) {
  // Of all lanes at once, and so that no lane branches.
  const mask_t given = when(input_in_range(u));
  for (int i = 0; i < TF_LANES; i++) {
    const tf_state_t state = {.r = b->r[i], .v = b->v[i], .w = b->w[i]};
    const linear_t l =
        linearise(k, &state, u, velocities(k, &state, u->omega0));
    work->rare[i] =
        ~(given & when(in_reach(b->r[i], b->v[i], b->w[i])) & when(l.definite));
    work->p[i] = l.p;
    work->z[i] = l.z;
    work->free_p[i] = l.free.p;
    work->free_z[i] = l.free.z;
    work->r_explicit[i] = l.r_explicit;
    work->arm[i] = l.arm;
    work->p_b[i] = l.p_b;
    work->p_t[i] = l.p_t;
    work->p_c[i] = l.p_c;
    work->z_t[i] = l.z_t;
    work->z_c[i] = l.z_c;
  }
}

static void forms_all(const tf_machine_t *restrict k, work_t *restrict work) {
  for (int i = 0; i < TF_LANES; i++) {
    const linear_t l = linear_of(work, 0, i);
    const free_end_t end = free_end(k, &l);
    const tf_slip_t free = slip_from_pq(k, end.p, end.r * end.z);
    tf_form_t h, g;
    slip_forms(k, &end, free, &h, &g);
    work->p_by_x[i] = end.by_x.p;
    work->z_by_x[i] = end.by_x.z;
    work->p_by_y[i] = end.by_y.p;
    work->z_by_y[i] = end.by_y.z;
    put_form(&work->h, &h, i);
    put_form(&work->g, &g, i);
  }
}

// The modes in which the lanes begin, but for pinned ones, which are rare.
static void modes_all(const tf_state_block_t *restrict b,
                      work_t *restrict work) {
  uint8_t bit[TF_LANES];
  for (int i = 0; i < TF_LANES; i++) {
    const uint8_t mode = b->mode[i];
    bit[i] =
        (uint8_t)((mode == TF_SLIP_PLUS ? TF_MODE_BIT(TF_SLIP_PLUS) : 0) |
                  (mode == TF_SLIP_MINUS ? TF_MODE_BIT(TF_SLIP_MINUS) : 0) |
                  (mode == TF_STICK_PLUS ? TF_MODE_BIT(TF_STICK_PLUS) : 0) |
                  (mode == TF_STICK_MINUS ? TF_MODE_BIT(TF_STICK_MINUS) : 0));
  }
  for (int i = 0; i < TF_LANES; i++) work->bit[i] = bit[i];
}

// enumerate_one_law(). Lanes whose g+ can have both signs are done as those
// with g+ > 0, of which sticks_of() keeps stick+.
static void enumerate_all(work_t *restrict work) {
  for (int i = 0; i < TF_LANES; i++) {
    const tf_real_t g = work->g.c0[i];
    const tf_form_t of_g = form_of(&work->g, i);
    const mask_t one_sign = when(magnitude(g) > most_change(&of_g));
    const mask_t minus = one_sign & when(g < 0);
    tf_form_t f = form_of(&work->h, i);
    f.cy = flip_sign(minus, f.cy);
    f.cxy = flip_sign(minus, f.cxy);
    const quadratic_t h = along(&f, PLUS);
    const mask_t up = when(slip_plus_solves(&h));
    const mask_t down = when(slip_minus_solves(&h)), one = up ^ down;
    const mask_t stick = (minus & TF_MODE_BIT(TF_STICK_MINUS)) |
                         (~minus & TF_MODE_BIT(TF_STICK_PLUS));
    const lane_root_t root = lane_root(h.c0, h.c1, h.c2);
    work->above[i] = one_sign & ~minus;
    work->below[i] = minus;
    work->nearer_minus[i] = minus;
    work->set[i] = (up & TF_MODE_BIT(TF_SLIP_PLUS)) |
                   (down & TF_MODE_BIT(TF_SLIP_MINUS)) | (~one & stick);
    work->attracting[i] = when(stick_attracts(&h)) & stick;
    work->root[0][i] = work->root[1][i] = root.x;
    work->tau[0][i] = work->tau[1][i] = flip_sign(minus, 1);
    work->departure[0][i] = h.at_upper;
    work->departure[1][i] = h.at_lower;
    work->pin_F[i] = work->pin_M[i] = 0;
    work->rare[i] |= (one & when(has_extremum_inside(&h))) | (~one & root.rare);
  }
}

// What the passes over a group whose g+ can have both signs hand on: at the
// ends x = +1 (0) and x = -1 (1) whether g+ > 0 for s = +1, g+ < 0 for s = -1,
// and whether neither holds, so that the share of the moment is a root.
typedef struct {
  mask_t plus[2][GROUP], minus[2][GROUP], open[2][GROUP];
  tf_real_t c0[GROUP], c1[GROUP], c2[GROUP]; // of that root
  mask_t prefer[GROUP];                      // the present g prefers s = +1
} group_t;

// The signs of g+, and the root to be found for the share of the moment. At
// most one slip has such a root: slip+ needs g.cy <= 0 for it, slip- g.cy >= 0,
// up to the bends; slips_of() calls the lane rare where both have.
static void shares_of(const tf_machine_t *restrict k,
                      const tf_state_block_t *restrict b,
                      const tf_input_t *restrict u, int from,
                      work_t *restrict work, group_t *restrict group) {
  const tf_real_t turn = turn_of_step(k, u);
  for (int n = 0; n < GROUP; n++) {
    const int i = from + n;
    const tf_form_t g = form_of(&work->g, i);
    const quadratic_t g0 = along(&g, PLUS), g1 = along(&g, MINUS);
    const mask_t up0 = when(g0.at_upper > 0), down0 = when(g0.at_lower > 0);
    const mask_t up1 = when(g1.at_upper < 0), down1 = when(g1.at_lower < 0);
    const mask_t up = ~(up0 | up1);
    const quadratic_t share =
        over_share(pick(up, g0.at_upper, g0.at_lower),
                   pick(up, g1.at_upper, g1.at_lower), g.cyy);
    const tf_slip_t now =
        slip_at_instant(k, turn, b->r[i], work->p[i], work->z[i]);
    group->plus[0][n] = up0;
    group->plus[1][n] = down0;
    group->minus[0][n] = up1;
    group->minus[1][n] = down1;
    group->open[0][n] = up;
    group->open[1][n] = ~(down0 | down1);
    group->c0[n] = share.c0;
    group->c1[n] = share.c1;
    group->c2[n] = share.c2;
    group->prefer[n] = when(is_nearer_plus(now.g, g.c0));
    work->rare[i] |= ~(work->above[i] | work->below[i]) &
                     (lane_bends(g0.at_upper, g1.at_upper, g.cyy) |
                      lane_bends(g0.at_lower, g1.at_lower, g.cyy));
  }
}

// solve_slip() of both slips.
static void slips_of(int from, const group_t *restrict group,
                     work_t *restrict work) {
  for (int n = 0; n < GROUP; n++) {
    const int i = from + n;
    const mask_t both = ~(work->above[i] | work->below[i]);
    const tf_form_t h = form_of(&work->h, i);
    const quadratic_t h0 = along(&h, PLUS), h1 = along(&h, MINUS);
    const tf_real_t p0 = h0.at_upper, p1 = h1.at_upper;
    const tf_real_t m0 = h0.at_lower, m1 = h1.at_lower;
    const mask_t up = group->open[0][n], down = group->open[1][n];
    const mask_t prefer = group->prefer[n];
    const mask_t s_up = share_down(group->plus[0][n], group->minus[0][n],
                                   when(p0 > 0), when(p1 > 0), prefer);
    const mask_t s_down = share_down(group->plus[1][n], group->minus[1][n],
                                     when(m0 < 0), when(m1 < 0), prefer);
    const lane_root_t root =
        lane_root(group->c0[n], group->c1[n], group->c2[n]);
    const tf_real_t h_end =
        slip_end_at(root.x, pick(up, p0, m0), pick(up, p1, m1), h.cyy);
    const tf_real_t h_up = pick(up, h_end, pick(s_up, p1, p0));
    const tf_real_t h_down = pick(down, h_end, pick(s_down, m1, m0));
    const tf_real_t size =
        magnitude(p0) + magnitude(p1) + magnitude(m0) + magnitude(m1);
    work->departure[0][i] = pick(both, h_up, work->departure[0][i]);
    work->departure[1][i] = pick(both, h_down, work->departure[1][i]);
    work->tau[0][i] =
        pick(both, pick(up, root.x, flip_sign(s_up, 1)), work->tau[0][i]);
    work->tau[1][i] =
        pick(both, pick(down, root.x, flip_sign(s_down, 1)), work->tau[1][i]);
    work->set[i] = (~both & work->set[i]) |
                   (both & when(h_up > 0) & TF_MODE_BIT(TF_SLIP_PLUS)) |
                   (both & when(h_down < 0) & TF_MODE_BIT(TF_SLIP_MINUS));
    work->rare[i] |=
        both & ((up & down) | ((up | down) & root.rare) |
                ~when(size <= TF_REAL_MAX / 16) | lane_bends(p0, p1, h.cyy) |
                lane_bends(m0, m1, h.cyy));
  }
}

// solve_stick() of both sticks, and rest; enumerate_all() has the root of
// stick+.
static void sticks_of(const tf_machine_t *restrict k, int from,
                      const group_t *restrict group, work_t *restrict work) {
  const mask_t can = when(can_be_pinned(k));
  for (int n = 0; n < GROUP; n++) {
    const int i = from + n;
    const mask_t both = ~(work->above[i] | work->below[i]);
    const tf_form_t h = form_of(&work->h, i), g = form_of(&work->g, i);
    const quadratic_t h0 = along(&h, PLUS), h1 = along(&h, MINUS);
    const quadratic_t g0 = along(&g, PLUS), g1 = along(&g, MINUS);
    const mask_t one0 =
        when(slip_plus_solves(&h0)) ^ when(slip_minus_solves(&h0));
    const mask_t one1 =
        when(slip_plus_solves(&h1)) ^ when(slip_minus_solves(&h1));
    const lane_root_t root = lane_root(h1.c0, h1.c1, h1.c2);
    const tf_real_t g_end0 = quadratic_at(&g0, work->root[0][i]);
    const tf_real_t g_end1 = quadratic_at(&g1, root.x);
    const mask_t rolls0 = when(has_sign_of_g(g_end0, PLUS, false));
    const mask_t rolls1 = when(has_sign_of_g(g_end1, MINUS, false));
    const linear_t l = linear_of(work, 0, i);
    const tf_force_t pin = lane_pin(k, can, &l);
    const tf_real_t x = pin.F * k->contact.inv_mu,
                    y = pin.M * k->contact.inv_kappa_mu;
    const mask_t rests = when(rests_under(k->contact.rest, x, y));
    work->pin_F[i] = pin.F;
    work->pin_M[i] = pin.M;
    work->set[i] |= both & ((~one0 & rolls0 & TF_MODE_BIT(TF_STICK_PLUS)) |
                            (~one1 & rolls1 & TF_MODE_BIT(TF_STICK_MINUS)) |
                            (rests & TF_MODE_BIT(TF_PINNED)));
    work->attracting[i] |=
        both & when(stick_attracts(&h1)) & TF_MODE_BIT(TF_STICK_MINUS);
    work->nearer_minus[i] |= both & ~group->prefer[n];
    work->root[1][i] = pick(both, root.x, work->root[1][i]);
    work->rare[i] |=
        both & ((one1 & when(has_extremum_inside(&h1))) | (~one1 & root.rare));
  }
}

// enumerate_both_signs() for a group of lanes that are done at once; lanes of
// one sign keep what they have.
TF_INLINE void enumerate_both(const tf_machine_t *restrict k,
                              const tf_state_block_t *restrict b,
                              const tf_input_t *restrict u, int from,
                              work_t *restrict work) {
  group_t group;
  shares_of(k, b, u, from, work, &group);
  slips_of(from, &group, work);
  sticks_of(k, from, &group, work);
}

static bool any_both(const work_t *restrict work, int from) {
  mask_t both = 0;
  for (int n = 0; n < GROUP; n++)
    both |= ~(work->above[from + n] | work->below[from + n]);
  return both != 0;
}

// The whole solution set of each lane.
static void solve(const tf_machine_t *restrict k,
                  const tf_state_block_t *restrict b,
                  const tf_input_t *restrict u, work_t *restrict work) {
  modes_all(b, work);
  linearise_all(k, b, u, work);
  forms_all(k, work);
  enumerate_all(work);
  for (int n = 0; n < TF_LANES / GROUP; n++)
    if (any_both(work, n * GROUP)) enumerate_both(k, b, u, n * GROUP, work);
}

#endif
