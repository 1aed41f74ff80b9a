#include "law.h"

const char *const form_names[FORMS] = {"algebraic", "tanh",     "arctan",
                                       "cubic",     "skew",     "corner",
                                       "angle",     "two_piece"};

law_t law_of(const machine_t *machine) {
  const real_t kappa = (real_t)machine->kappa, right = angle(1, 0);
  return (law_t){(real_t)machine->mu,    kappa, angle(6 * kappa, 1) / right,
                 (real_t)machine->width, right, machine->form};
}

static real_t clipped(real_t x) { return x > 1 ? 1 : x < -1 ? -1 : x; }

real_t share(const law_t *law, real_t x) {
  real_t e;
  switch (law->form) {
    case FORM_TANH:
      e = exponential(-2 * absolute(x));
      return (x < 0 ? e - 1 : 1 - e) / (1 + e);
    case FORM_ARCTAN:
      return (x < 0 ? -angle(-x, 1) : angle(x, 1)) / law->right;
    case FORM_CUBIC:
      x = clipped(x);
      return x * (3 - x * x) / 2;
    case FORM_ANGLE:
      return clipped(x);
    case FORM_SKEW: // x + (sqrt(1 + x^2) + x - 1) rises from -1 to 3 x
      x += root(1 + x * x) + x - 1;
      return x / root(1 + x * x);
    case FORM_ALGEBRAIC:
    case FORM_CORNER:
    case FORM_TWO_PIECE:
    case FORMS:
    default:
      return x / root(1 + x * x);
  }
}

// Corrected formulas of Appendix B: linear up to cot = 18 k kappa^2.
static force_t two_piece(const law_t *law, real_t H, real_t G) {
  const real_t steep = 18 * law->kappa * law->kappa / law->width;
  if (steep * H < G)
    return (force_t){steep * H / G, law->kappa * steep * H / G};
  const real_t cot = G / (steep * H);
  return (force_t){REAL(4.0) / 3 - cot / 3, law->kappa * cot};
}

// With T = cot psi = tan(a atan(G / H)): F = mu (4/3 - T/(18 kappa)), M = mu
// T/6, times the share of the sign of h, and M times that of g.
force_t force_at(const law_t *law, real_t h, real_t g) {
  const real_t w = law->width;
  real_t H = absolute(h), G = absolute(g), of_h, of_g = g < 0 ? -1 : 1;
  force_t f;
  if (law->form == FORM_CORNER) {
    H = root(h * h + w * w);
    G = root(g * g + w * w);
    of_h = h / H;
    of_g = g / G;
  } else if (law->form == FORM_TWO_PIECE) {
    of_h = h < 0 ? -1 : 1;
  } else if (law->form == FORM_ANGLE) {
    of_h = H < w * G ? h / (w * G) : h < 0 ? -1 : 1;
  } else {
    of_h = share(law, h / w);
  }
  if (law->form == FORM_TWO_PIECE) {
    f = two_piece(law, H, G);
  } else {
    const real_t T = tangent(law->a * angle(G, H));
    f = (force_t){REAL(4.0) / 3 - T / (18 * law->kappa), T / 6};
  }
  // |phi| times the law of the side: a skew phi may be < 0 at h > 0.
  return (force_t){law->mu * of_h * f.F, law->mu * of_h * of_g * f.M};
}
