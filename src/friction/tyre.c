// Tyre laws: friction force and aligning moment from the slip angle.
#include "tyre_law.h"

TF_API tf_real_t tf_cot_psi(const tf_tyre_t *tyre, tf_real_t G, tf_real_t H) {
  return cot_psi(tyre, G, H);
}

TF_API multipliers_t tf_jump_multipliers(const tf_tyre_t *tyre, sign_t side,
                                         tf_slip_t at) {
  const tf_real_t H = unit(side) * at.h;
  const tf_real_t T = tf_cot_psi(tyre, magnitude(at.g), H > 0 ? H : 0);
  return signed_multipliers(multipliers_at(tyre, T), side, sign_of(at.g));
}

static tf_force_t jump_force(const tf_tyre_t *tyre, sign_t side, tf_real_t h,
                             tf_real_t g) {
  const multipliers_t m = jump_multipliers(tyre, side, (tf_slip_t){h, g});
  return (tf_force_t){tyre->mu * m.x, tyre->kappa * tyre->mu * m.y};
}

// The jump smoothed: sign(h) becomes h / sqrt(h^2 + epsilon^2).
static tf_force_t smooth_force(const tf_tyre_t *tyre, tf_real_t h,
                               tf_real_t g) {
  const tf_real_t epsilon = tyre->epsilon;
  const tf_real_t share = h / square_root(h * h + epsilon * epsilon);
  const tf_force_t f = jump_force(tyre, sign_of(h), h, g);
  return (tf_force_t){magnitude(share) * f.F, magnitude(share) * f.M};
}

// Appendix B, integrated over its two zones. With y = a + sigma - x the
// distance behind the point where the string would be at rest, the string
// sticks for sigma <= y <= l = (delta/k) |g/h| and slides beyond:
//   F = rho delta (x_s + a) + k t (l^2 - sigma^2)/2,        k t = delta / l
//   M = rho delta (a^2 - x_s^2)/2
//       - k t ((a + sigma)(l^2 - sigma^2)/2 - (l^3 - sigma^3)/3)
// with l - sigma taken out of the brackets and 1/l into u = sigma/l <= 1.
static tf_force_t string_force(const tf_tyre_t *tyre, tf_real_t h,
                               tf_real_t g) {
  const tf_real_t a = tyre->a, sigma = tyre->sigma, delta = tyre->delta;
  if (h == 0) return (tf_force_t){0, 0}; // also h = g = 0: no angle, no force
  // Only the ratio counts; the larger becomes 1, so that nothing underflows.
  const bool steep = magnitude(g) > magnitude(h);
  const tf_real_t ratio = magnitude(steep ? h / g : g / h);
  const tf_real_t H = steep ? ratio : 1, G = steep ? 1 : ratio;
  const tf_real_t reach = delta * G; // k l H
  const tf_real_t l = reach / (tyre->stiffness * H);
  tf_real_t F, M;
  if (reach >= tyre->stiffness * (2 * a + sigma) * H) { // x_s <= -a: no slip
    const tf_real_t kt = tyre->stiffness * (H / G);
    F = 2 * a * (a + sigma) * kt;
    M = 2 * a * a * a / 3 * kt;
  } else if (l > sigma) { // partial slip
    const tf_real_t u = sigma / l, x_s = a + sigma - l;
    const tf_real_t stuck = delta * (l - sigma);
    F = tyre->rho * delta * (x_s + a) + stuck * (1 + u) / 2;
    M = tyre->rho * delta * (a - x_s) * (a + x_s) / 2 -
        stuck * ((a + sigma) * (1 + u) / 2 - (l + sigma + sigma * u) / 3);
  } else { // x_s >= a: full slip
    F = 2 * a * tyre->rho * delta;
    M = 0;
  }
  F *= tyre->mu;
  M *= tyre->mu;
  return (tf_force_t){h < 0 ? -F : F, (h < 0) != (g < 0) ? -M : M};
}

static const char *const law_names[] = {"jump",   "coulomb", "two_piece",
                                        "string", "smooth",  "none"};
enum {
  each_law_has_a_name =
      1 / (sizeof law_names / sizeof *law_names == TF_TYRE_LAWS)
};

TF_API const char *tf_tyre_law_name(unsigned law) {
  return law < TF_TYRE_LAWS ? law_names[law] : "unknown law";
}

TF_API tf_force_t tf_tyre_force(const tf_tyre_t *tyre, tf_real_t side,
                                tf_real_t h, tf_real_t g) {
  switch (tyre->law) {
    case TF_TYRE_JUMP:
      return jump_force(tyre, sign_of(side), h, g);
    case TF_TYRE_COULOMB:
      return (tf_force_t){side * tyre->mu, 0};
    case TF_TYRE_TWO_PIECE:
    case TF_TYRE_STRING:
      return string_force(tyre, h, g);
    case TF_TYRE_SMOOTH:
      return smooth_force(tyre, h, g);
    case TF_TYRE_NONE:
    default:
      break;
  }
  return (tf_force_t){0, 0};
}
