// The solution set of one step's inclusion (incl), where codimension two is
// within reach, so that g+ may have either sign; friction_core.h has the rest.
#include "friction_core.h"

// The share s of the moment in a slip at h -> 0, where g(s) is the quadratic
// through g_plus at 1 and g_minus at -1 with leading term bend. Where g+ is > 0
// for s = +1 and < 0 for s = -1 both solve; then the present sign of g is kept
// unless it contradicts the slip. Where neither solves, the angle passes
// through g = 0 at an s between them.
static tf_real_t moment_share(tf_real_t g_plus, tf_real_t g_minus,
                              tf_real_t bend, bool plus_slips, bool minus_slips,
                              bool prefer_plus) {
  if (g_plus > 0 && g_minus < 0)
    return (prefer_plus ? plus_slips : !minus_slips) ? TF_R(1.0) : TF_R(-1.0);
  if (g_plus > 0) return 1;
  if (g_minus < 0) return -1;
  return root_within((g_plus + g_minus) / 2 - bend, (g_plus - g_minus) / 2,
                     bend, 1);
}

// Whether a stick with s and lambda = x ends with that sign of g. Without a
// moment both s are one solution; it goes by the sign of g, and g = 0 has to
// go somewhere.
static bool rolls_as(const tf_inclusion_t *in, int s, tf_real_t x) {
  const tf_real_t g = in->g_free + x * (in->g1[s] + x * in->g2[s]);
  return s ? g < 0 : g > 0 || (g == 0 && in->kappa == 0);
}

// g+ may have either sign: codimension two is within reach of this step.
static unsigned solve_both_signs(const tf_inclusion_t *in,
                                 tf_solutions_t *out) {
  tf_real_t h[2][2], g[2][2]; // [slip+, slip-][s] at h -> 0
  unsigned set = 0;
  for (int s = 0; s < 2; s++) {
    const ends_t hs = at_ends(in->h_free, in->h1[s], in->h2[s], in->mu);
    const ends_t gs = at_ends(in->g_free, in->g1[s], in->g2[s], in->mu);
    h[0][s] = hs.plus;
    h[1][s] = hs.minus;
    g[0][s] = gs.plus;
    g[1][s] = gs.minus;
    const bool above = hs.plus > 0, one = above != (hs.minus < 0);
    const bool two =
        one && dips(in->h_free, in->h1[s], in->h2[s], in->mu, above);
    if (one && !two) continue; // one slip, no stick
    tf_real_t x = root_within(in->h_free, in->h1[s], in->h2[s], in->mu);
    if (two && !rolls_as(in, s, x)) x = -in->h1[s] / in->h2[s] - x;
    out->lambda[s] = x;
    if (rolls_as(in, s, x)) set |= TF_MODE_BIT(TF_STICK_PLUS + s);
  }
  const tf_real_t M = in->kappa * in->mu;
  for (int slip = 0; slip < 2; slip++) {
    const tf_real_t side = slip ? TF_R(-1.0) : TF_R(1.0);
    const tf_real_t *hs = h[slip], *gs = g[slip];
    const tf_real_t tau =
        moment_share(gs[0], gs[1], M * M * in->g_MM, side * hs[0] > 0,
                     side * hs[1] > 0, in->g_now >= 0);
    const tf_real_t h_end = ((1 + tau) * hs[0] + (1 - tau) * hs[1]) / 2 -
                            (1 - tau * tau) * (M * M * in->h_MM);
    out->tau[slip] = tau;
    out->h_limit[slip] = h_end;
    if (side * h_end > 0) set |= TF_MODE_BIT(TF_SLIP_PLUS + slip);
  }
  // Without a moment a pinned wheel is a stick with g+ = 0: not a sixth mode.
  if (in->kappa > 0 && within(in->pin.F, in->mu) &&
      within(in->pin.M, in->kappa * magnitude(in->pin.F)))
    set |= TF_MODE_BIT(TF_PINNED);
  return set;
}

TF_API void tf_friction_solve(const tf_inclusion_t *in, tf_solutions_t *out) {
  unsigned set;
  if (in->signs == 3) {
    set = solve_both_signs(in, out);
    out->attracting =
        (uint8_t)((in->h1[0] < 0 ? TF_MODE_BIT(TF_STICK_PLUS) : 0) |
                  (in->h1[1] < 0 ? TF_MODE_BIT(TF_STICK_MINUS) : 0));
  } else {
    const unsigned s = in->signs >> 1;
    set = solve_one_sign(in->mu, in->h_free, in->h1[s], in->h2[s], s, out);
  }
  out->near_stick = in->g_now >= 0 ? TF_STICK_PLUS : TF_STICK_MINUS;
  out->set = (uint8_t)set;
}

TF_API tf_real_t tf_law_residual(tf_real_t mu, tf_real_t kappa,
                                 tf_force_t force, tf_real_t h, tf_real_t g) {
  return law_residual(mu, kappa, force, h, g);
}
