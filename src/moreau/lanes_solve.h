// The first passes of a block: the motion without friction and the whole
// solution set of each lane, in loops without a branch on data. The passes are
// short because a processor works on several iterations at once only as far as
// its window reaches; the roots, a long chain of dependent operations, have a
// pass of their own for that reason.
#ifndef TF_LANES_SOLVE_H
#define TF_LANES_SOLVE_H

#include "lanes.h"
#include "twofold/ensemble.h"

// tf_form_t of all lanes.
typedef struct {
  tf_real_t c0[TF_LANES], F[TF_LANES], M[TF_LANES];
  tf_real_t FF[TF_LANES], FM[TF_LANES], MM[TF_LANES];
} lane_form_t;

// What one pass hands to the next, member by member.
typedef struct {
  tf_real_t p[TF_LANES], z[TF_LANES]; // tf_linear_t
  tf_real_t free_p[TF_LANES], free_z[TF_LANES];
  tf_real_t r_explicit[TF_LANES], arm[TF_LANES];
  tf_real_t p_b[TF_LANES], p_t[TF_LANES], p_c[TF_LANES];
  tf_real_t z_t[TF_LANES], z_c[TF_LANES];
  tf_real_t F_p[TF_LANES], F_z[TF_LANES]; // answers to F = mu
  tf_real_t M_p[TF_LANES], M_z[TF_LANES]; // and to M = kappa mu
  lane_form_t h, g;
  tf_real_t pin_F[TF_LANES], pin_M[TF_LANES]; // pinning force
  // h at x = +1 and x = -1, each with s = +1 and s = -1.
  tf_real_t h_plus[2][TF_LANES], h_minus[2][TF_LANES];
  mask_t above[TF_LANES], below[TF_LANES]; // sign of g+; neither: both
  mask_t nearer_minus[TF_LANES];           // the stick near g, if stick-
  mask_t down[2][TF_LANES];                // slip+, slip-: moment share -1
  mask_t g_plus[2][TF_LANES], g_minus[2][TF_LANES]; // see share_down()
  mask_t none[2][TF_LANES];                         // no stick+, no stick-
  // The roots to be found: stick+, stick-, a share of the moment.
  tf_real_t c0[3][TF_LANES], c1[3][TF_LANES], c2[3][TF_LANES];
  mask_t root_odd[3][TF_LANES];
  tf_real_t root[3][TF_LANES];
  tf_real_t h_limit[2][TF_LANES]; // tf_solutions_t
  mask_t set[TF_LANES], attracting[TF_LANES];
  mask_t odd[TF_LANES];               // tf_step has to do it
  uint8_t mode[TF_LANES];             // chosen
  uint8_t slipping[TF_LANES];         // indices of the lanes that slip
  tf_real_t side[TF_LANES];           // of the chosen slip, else 0
  tf_real_t roll[TF_LANES];           // sign of g of the chosen stick, else 0
  tf_real_t x[TF_LANES], y[TF_LANES]; // multipliers
  tf_real_t F[TF_LANES], M[TF_LANES]; // tf_end_t
  tf_real_t r[TF_LANES], v[TF_LANES], w[TF_LANES];
} work_t;

TF_INLINE tf_linear_t linear_of(const work_t *w, tf_real_t omega0, int i) {
  return (tf_linear_t){.omega0 = omega0,
                       .p = w->p[i],
                       .z = w->z[i],
                       .free = {w->free_p[i], w->free_z[i]},
                       .r_explicit = w->r_explicit[i],
                       .arm = w->arm[i],
                       .p_b = w->p_b[i],
                       .p_t = w->p_t[i],
                       .p_c = w->p_c[i],
                       .z_t = w->z_t[i],
                       .z_c = w->z_c[i]};
}

TF_INLINE void put_form(lane_form_t *to, const tf_form_t *f, int i) {
  to->c0[i] = f->c0;
  to->F[i] = f->F;
  to->M[i] = f->M;
  to->FF[i] = f->FF;
  to->FM[i] = f->FM;
  to->MM[i] = f->MM;
}

TF_INLINE tf_form_t form_of(const lane_form_t *f, int i) {
  return (tf_form_t){f->c0[i], f->F[i], f->M[i], f->FF[i], f->FM[i], f->MM[i]};
}

static void linearise_all(const tf_machine_t *restrict k,
                          const tf_state_block_t *restrict b,
                          const tf_input_t *restrict u, work_t *restrict w) {
  for (int i = 0; i < TF_LANES; i++) {
    const tf_state_t state = {.r = b->r[i], .v = b->v[i], .w = b->w[i]};
    const tf_linear_t l = linearise(k, &state, u);
    w->odd[i] = ~(when(in_range(&state, u)) & when(l.definite));
    w->p[i] = l.p;
    w->z[i] = l.z;
    w->free_p[i] = l.free.p;
    w->free_z[i] = l.free.z;
    w->r_explicit[i] = l.r_explicit;
    w->arm[i] = l.arm;
    w->p_b[i] = l.p_b;
    w->p_t[i] = l.p_t;
    w->p_c[i] = l.p_c;
    w->z_t[i] = l.z_t;
    w->z_c[i] = l.z_c;
  }
}

static void forms_all(const tf_machine_t *restrict k, work_t *restrict w) {
  for (int i = 0; i < TF_LANES; i++) {
    const tf_linear_t l = linear_of(w, 0, i);
    const tf_free_end_t end = free_end(k, &l);
    const tf_slip_t free = slip_from_pq(k, end.p, end.r * end.z);
    tf_form_t h, g;
    slip_forms(k, &end, free, &h, &g);
    w->F_p[i] = end.F.p;
    w->F_z[i] = end.F.z;
    w->M_p[i] = end.M.p;
    w->M_z[i] = end.M.z;
    put_form(&w->h, &h, i);
    put_form(&w->g, &g, i);
  }
}

static void pin_all(const tf_machine_t *restrict k, work_t *restrict w) {
  for (int i = 0; i < TF_LANES; i++) {
    const tf_linear_t l = linear_of(w, 0, i);
    const tf_force_t pin = lane_pin(k, &l);
    const tf_real_t x = magnitude(pin.F * k->inv_mu);
    const tf_real_t y = magnitude(pin.M * k->inv_kappa_mu);
    w->pin_F[i] = pin.F;
    w->pin_M[i] = pin.M;
    w->set[i] = when(x <= 1) & when(y <= x) & TF_MODE_BIT(TF_PINNED);
  }
}

// The signs of g+, and the root to be found for the share of the moment. At
// most one slip has such a root: slip+ needs g.M <= 0 for it, slip- g.M >= 0,
// up to the bends; slips_all() calls the lane odd where both have.
static void g_along_all(work_t *restrict w) {
  for (int i = 0; i < TF_LANES; i++) {
    const tf_form_t g = form_of(&w->g, i);
    const quadratic_t g0 = along(&g, 0), g1 = along(&g, 1);
    const mask_t up0 = when(g0.plus > 0), down0 = when(g0.minus > 0);
    const mask_t up1 = when(g1.plus < 0), down1 = when(g1.minus < 0);
    const mask_t up = ~(up0 | up1);
    const tf_real_t share0 = pick(up, g0.plus, g0.minus);
    const tf_real_t share1 = pick(up, g1.plus, g1.minus);
    w->above[i] =
        when(g.c0 > 0) & up0 & down0 & when(g1.plus > 0) & when(g1.minus > 0);
    w->below[i] =
        when(g.c0 < 0) & up1 & down1 & when(g0.plus < 0) & when(g0.minus < 0);
    w->g_plus[0][i] = up0;
    w->g_plus[1][i] = down0;
    w->g_minus[0][i] = up1;
    w->g_minus[1][i] = down1;
    w->c0[2][i] = (share0 + share1) / 2 - g.MM;
    w->c1[2][i] = (share0 - share1) / 2;
    w->c2[2][i] = g.MM;
  }
}

static void h_along_all(const tf_machine_t *restrict k,
                        const tf_state_block_t *restrict b,
                        work_t *restrict w) {
  for (int i = 0; i < TF_LANES; i++) {
    const tf_form_t h = form_of(&w->h, i);
    const quadratic_t h0 = along(&h, 0), h1 = along(&h, 1);
    const mask_t above = w->above[i], below = w->below[i];
    const mask_t up0 = when(h0.plus > 0), down0 = when(h0.minus < 0);
    const mask_t up1 = when(h1.plus > 0), down1 = when(h1.minus < 0);
    const mask_t one0 = up0 ^ down0, one1 = up1 ^ down1;
    const mask_t two0 = when(magnitude(h0.c1) < 2 * magnitude(h0.c2));
    const mask_t two1 = when(magnitude(h1.c1) < 2 * magnitude(h1.c2));
    const tf_slip_t now = slip_from_pq(k, w->p[i], b->r[i] * w->z[i]);
    const mask_t prefer = when(now.g >= 0);
    w->down[0][i] =
        share_down(w->g_plus[0][i], w->g_minus[0][i], up0, up1, prefer);
    w->down[1][i] =
        share_down(w->g_plus[1][i], w->g_minus[1][i], down0, down1, prefer);
    w->nearer_minus[i] = below | ~(above | prefer);
    w->none[0][i] = one0 | below;
    w->none[1][i] = one1 | above;
    w->attracting[i] = (when(h0.c1 < 0) & ~below & TF_MODE_BIT(TF_STICK_PLUS)) |
                       (when(h1.c1 < 0) & ~above & TF_MODE_BIT(TF_STICK_MINUS));
    w->odd[i] |= (~below & one0 & two0) | (~above & one1 & two1);
    w->c0[0][i] = w->c0[1][i] = h.c0;
    w->c1[0][i] = h0.c1;
    w->c1[1][i] = h1.c1;
    w->c2[0][i] = h0.c2;
    w->c2[1][i] = h1.c2;
    w->h_plus[0][i] = h0.plus;
    w->h_plus[1][i] = h1.plus;
    w->h_minus[0][i] = h0.minus;
    w->h_minus[1][i] = h1.minus;
  }
}

static void roots_all(work_t *restrict w) {
  for (int n = 0; n < 3; n++)
    for (int i = 0; i < TF_LANES; i++) {
      const lane_root_t root = lane_root(w->c0[n][i], w->c1[n][i], w->c2[n][i]);
      w->root[n][i] = root.x;
      w->root_odd[n][i] = root.odd;
    }
}

static void sticks_all(work_t *restrict w) {
  for (int i = 0; i < TF_LANES; i++) {
    const mask_t above = w->above[i], below = w->below[i];
    const mask_t none0 = w->none[0][i], none1 = w->none[1][i];
    const tf_form_t g = form_of(&w->g, i);
    const quadratic_t g0 = along(&g, 0), g1 = along(&g, 1);
    const tf_real_t x0 = w->root[0][i], x1 = w->root[1][i];
    const mask_t rolls0 = when(g0.c0 + x0 * (g0.c1 + x0 * g0.c2) > 0);
    const mask_t rolls1 = when(g1.c0 + x1 * (g1.c1 + x1 * g1.c2) < 0);
    w->odd[i] |= (~none0 & w->root_odd[0][i]) | (~none1 & w->root_odd[1][i]);
    w->set[i] = (~(above | below) & w->set[i]) |
                (~none0 & (above | rolls0) & TF_MODE_BIT(TF_STICK_PLUS)) |
                (~none1 & (below | rolls1) & TF_MODE_BIT(TF_STICK_MINUS));
  }
}

static void slips_all(work_t *restrict w) {
  for (int i = 0; i < TF_LANES; i++) {
    const mask_t up = ~(w->g_plus[0][i] | w->g_minus[0][i]);
    const mask_t down = ~(w->g_plus[1][i] | w->g_minus[1][i]);
    const tf_real_t tau = w->root[2][i];
    const tf_real_t p0 = w->h_plus[0][i], p1 = w->h_plus[1][i];
    const tf_real_t m0 = w->h_minus[0][i], m1 = w->h_minus[1][i];
    const tf_real_t h0 = pick(up, p0, m0), h1 = pick(up, p1, m1);
    const tf_real_t h_end =
        ((1 + tau) * h0 + (1 - tau) * h1) / 2 - (1 - tau * tau) * w->h.MM[i];
    const tf_real_t h_up = pick(up, h_end, pick(w->down[0][i], p1, p0));
    const tf_real_t h_down = pick(down, h_end, pick(w->down[1][i], m1, m0));
    const tf_real_t size =
        magnitude(p0) + magnitude(p1) + magnitude(m0) + magnitude(m1);
    w->set[i] |= (when(h_up > 0) & TF_MODE_BIT(TF_SLIP_PLUS)) |
                 (when(h_down < 0) & TF_MODE_BIT(TF_SLIP_MINUS));
    w->odd[i] |= (up & down) | ((up | down) & w->root_odd[2][i]) |
                 ~when(size <= TF_REAL_MAX / 16);
    w->h_limit[0][i] = h_up;
    w->h_limit[1][i] = h_down;
  }
}

#endif
