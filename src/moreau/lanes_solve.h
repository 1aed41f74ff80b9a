// The first passes of a block: the motion without friction and the whole
// solution set of each lane, in loops without a branch on data. The passes are
// short because a processor works on several iterations at once only as far as
// its window reaches; the roots, a long chain of dependent operations, have a
// pass of their own for that reason.
#ifndef TF_LANES_SOLVE_H
#define TF_LANES_SOLVE_H

#include "lanes.h"
#include "twofold/ensemble.h"

// form_t of all lanes.
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
  tf_real_t pin_F[TF_LANES], pin_M[TF_LANES]; // pinning force
  // h at x = +1 and x = -1, each with s = +1 and s = -1.
  tf_real_t h_upper[2][TF_LANES], h_lower[2][TF_LANES];
  mask_t above[TF_LANES], below[TF_LANES]; // sign of g+; neither: both
  mask_t nearer_minus[TF_LANES];           // the stick near g, if stick-
  mask_t down[2][TF_LANES];                // slip+, slip-: moment share -1
  mask_t g_plus[2][TF_LANES], g_minus[2][TF_LANES]; // see share_down()
  mask_t none[2][TF_LANES];                         // no stick+, no stick-
  // The roots to be found: stick+, stick-, a share of the moment.
  tf_real_t c0[3][TF_LANES], c1[3][TF_LANES], c2[3][TF_LANES];
  mask_t root_rare[3][TF_LANES];
  tf_real_t root[3][TF_LANES];
  tf_real_t h_limit[2][TF_LANES]; // solutions_t
  mask_t set[TF_LANES], attracting[TF_LANES];
  mask_t stays[TF_LANES];             // r is as it was: it may stall
  mask_t rare[TF_LANES];              // tf_step has to do it
  uint8_t mode[TF_LANES];             // chosen
  uint8_t slipping[TF_LANES];         // indices of the lanes that slip
  tf_real_t side[TF_LANES];           // of the chosen slip, else 0
  tf_real_t roll[TF_LANES];           // sign of g of the chosen stick, else 0
  tf_real_t x[TF_LANES], y[TF_LANES]; // multipliers
  tf_real_t F[TF_LANES], M[TF_LANES]; // end_state_t
  tf_real_t r[TF_LANES], v[TF_LANES], w[TF_LANES];
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

TF_INLINE void put_form(lane_form_t *to, const form_t *f, int i) {
  to->c0[i] = f->c0;
  to->cx[i] = f->cx;
  to->cy[i] = f->cy;
  to->cxx[i] = f->cxx;
  to->cxy[i] = f->cxy;
  to->cyy[i] = f->cyy;
}

TF_INLINE form_t form_of(const lane_form_t *f, int i) {
  return (form_t){f->c0[i],  f->cx[i],  f->cy[i],
                  f->cxx[i], f->cxy[i], f->cyy[i]};
}

static void linearise_all(const tf_machine_t *restrict k,
                          const tf_state_block_t *restrict b,
                          const tf_input_t *restrict u, work_t *restrict work) {
  // Of all lanes at once, and so that no lane branches.
  const mask_t given = when(input_in_range(u));
  for (int i = 0; i < TF_LANES; i++) {
    const tf_state_t state = {.r = b->r[i], .v = b->v[i], .w = b->w[i]};
    const linear_t l = linearise(k, &state, u);
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
    form_t h, g;
    slip_forms(k, &end, free, &h, &g);
    work->p_by_x[i] = end.by_x.p;
    work->z_by_x[i] = end.by_x.z;
    work->p_by_y[i] = end.by_y.p;
    work->z_by_y[i] = end.by_y.z;
    put_form(&work->h, &h, i);
    put_form(&work->g, &g, i);
  }
}

static void pin_all(const tf_machine_t *restrict k, work_t *restrict work) {
  for (int i = 0; i < TF_LANES; i++) {
    const linear_t l = linear_of(work, 0, i);
    const tf_force_t pin = lane_pin(k, &l);
    const tf_real_t x = pin.F * k->inv_mu, y = pin.M * k->inv_kappa_mu;
    work->pin_F[i] = pin.F;
    work->pin_M[i] = pin.M;
    work->set[i] = when(rests_under(k->rest, x, y)) & TF_MODE_BIT(TF_PINNED);
  }
}

// The signs of g+, and the root to be found for the share of the moment. At
// most one slip has such a root: slip+ needs g.cy <= 0 for it, slip- g.cy >= 0,
// up to the bends; slips_all() calls the lane rare where both have.
static void g_along_all(work_t *restrict work) {
  for (int i = 0; i < TF_LANES; i++) {
    const form_t g = form_of(&work->g, i);
    const quadratic_t g0 = along(&g, 0), g1 = along(&g, 1);
    const mask_t up0 = when(g0.at_upper > 0), down0 = when(g0.at_lower > 0);
    const mask_t up1 = when(g1.at_upper < 0), down1 = when(g1.at_lower < 0);
    const mask_t up = ~(up0 | up1);
    const quadratic_t share =
        over_share(pick(up, g0.at_upper, g0.at_lower),
                   pick(up, g1.at_upper, g1.at_lower), g.cyy);
    const mask_t one = when(magnitude(g.c0) > most_change(&g));
    work->above[i] = one & when(g.c0 > 0);
    work->below[i] = one & when(g.c0 < 0);
    work->rare[i] |= ~one & (lane_bends(g0.at_upper, g1.at_upper, g.cyy) |
                             lane_bends(g0.at_lower, g1.at_lower, g.cyy));
    work->g_plus[0][i] = up0;
    work->g_plus[1][i] = down0;
    work->g_minus[0][i] = up1;
    work->g_minus[1][i] = down1;
    work->c0[2][i] = share.c0;
    work->c1[2][i] = share.c1;
    work->c2[2][i] = share.c2;
  }
}

static void h_along_all(const tf_machine_t *restrict k,
                        const tf_state_block_t *restrict b,
                        const tf_input_t *restrict u, work_t *restrict work) {
  const tf_real_t turn = turn_of_step(k, u);
  for (int i = 0; i < TF_LANES; i++) {
    const form_t h = form_of(&work->h, i);
    const quadratic_t h0 = along(&h, 0), h1 = along(&h, 1);
    const mask_t above = work->above[i], below = work->below[i];
    const mask_t up0 = when(slip_plus_solves(&h0));
    const mask_t up1 = when(slip_plus_solves(&h1));
    const mask_t down0 = when(slip_minus_solves(&h0));
    const mask_t down1 = when(slip_minus_solves(&h1));
    const mask_t one0 = up0 ^ down0, one1 = up1 ^ down1;
    const mask_t two0 = when(has_extremum_inside(&h0));
    const mask_t two1 = when(has_extremum_inside(&h1));
    const tf_slip_t now =
        slip_at_instant(k, turn, b->r[i], work->p[i], work->z[i]);
    const mask_t prefer = when(now.g >= 0);
    work->down[0][i] =
        share_down(work->g_plus[0][i], work->g_minus[0][i], up0, up1, prefer);
    work->down[1][i] = share_down(work->g_plus[1][i], work->g_minus[1][i],
                                  down0, down1, prefer);
    work->nearer_minus[i] = below | ~(above | prefer);
    work->none[0][i] = one0 | below;
    work->none[1][i] = one1 | above;
    work->attracting[i] =
        (when(stick_attracts(&h0)) & ~below & TF_MODE_BIT(TF_STICK_PLUS)) |
        (when(stick_attracts(&h1)) & ~above & TF_MODE_BIT(TF_STICK_MINUS));
    work->rare[i] |=
        (~below & one0 & two0) | (~above & one1 & two1) |
        (~(above | below) & (lane_bends(h0.at_upper, h1.at_upper, h.cyy) |
                             lane_bends(h0.at_lower, h1.at_lower, h.cyy)));
    work->c0[0][i] = work->c0[1][i] = h.c0;
    work->c1[0][i] = h0.c1;
    work->c1[1][i] = h1.c1;
    work->c2[0][i] = h0.c2;
    work->c2[1][i] = h1.c2;
    work->h_upper[0][i] = h0.at_upper;
    work->h_upper[1][i] = h1.at_upper;
    work->h_lower[0][i] = h0.at_lower;
    work->h_lower[1][i] = h1.at_lower;
  }
}

static void roots_all(work_t *restrict work) {
  for (int n = 0; n < 3; n++)
    for (int i = 0; i < TF_LANES; i++) {
      const lane_root_t root =
          lane_root(work->c0[n][i], work->c1[n][i], work->c2[n][i]);
      work->root[n][i] = root.x;
      work->root_rare[n][i] = root.rare;
    }
}

static void sticks_all(work_t *restrict work) {
  for (int i = 0; i < TF_LANES; i++) {
    const mask_t above = work->above[i], below = work->below[i];
    const mask_t none0 = work->none[0][i], none1 = work->none[1][i];
    const form_t g = form_of(&work->g, i);
    const quadratic_t g0 = along(&g, 0), g1 = along(&g, 1);
    const tf_real_t g_end0 = quadratic_at(&g0, work->root[0][i]);
    const tf_real_t g_end1 = quadratic_at(&g1, work->root[1][i]);
    const mask_t rolls0 = when(has_sign_of_g(g_end0, 0, true));
    const mask_t rolls1 = when(has_sign_of_g(g_end1, 1, true));
    work->rare[i] |=
        (~none0 & work->root_rare[0][i]) | (~none1 & work->root_rare[1][i]);
    work->set[i] = (~(above | below) & work->set[i]) |
                   (~none0 & (above | rolls0) & TF_MODE_BIT(TF_STICK_PLUS)) |
                   (~none1 & (below | rolls1) & TF_MODE_BIT(TF_STICK_MINUS));
  }
}

static void slips_all(work_t *restrict work) {
  for (int i = 0; i < TF_LANES; i++) {
    const mask_t up = ~(work->g_plus[0][i] | work->g_minus[0][i]);
    const mask_t down = ~(work->g_plus[1][i] | work->g_minus[1][i]);
    const tf_real_t tau = work->root[2][i];
    const tf_real_t p0 = work->h_upper[0][i], p1 = work->h_upper[1][i];
    const tf_real_t m0 = work->h_lower[0][i], m1 = work->h_lower[1][i];
    const tf_real_t h0 = pick(up, p0, m0), h1 = pick(up, p1, m1);
    const tf_real_t h_end = slip_end_at(tau, h0, h1, work->h.cyy[i]);
    const tf_real_t h_up = pick(up, h_end, pick(work->down[0][i], p1, p0));
    const tf_real_t h_down = pick(down, h_end, pick(work->down[1][i], m1, m0));
    const tf_real_t size =
        magnitude(p0) + magnitude(p1) + magnitude(m0) + magnitude(m1);
    work->set[i] |= (when(h_up > 0) & TF_MODE_BIT(TF_SLIP_PLUS)) |
                    (when(h_down < 0) & TF_MODE_BIT(TF_SLIP_MINUS));
    work->rare[i] |= (up & down) | ((up | down) & work->root_rare[2][i]) |
                     ~when(size <= TF_REAL_MAX / 16);
    work->h_limit[0][i] = h_up;
    work->h_limit[1][i] = h_down;
  }
}

#endif
