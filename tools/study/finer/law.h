// Laws without a jump: the paper's law with sign(h) replaced by phi(x), x =
// h / width. In the layer |x| = O(1) they are stick, and as the width goes to 0
// each but the last becomes the law with the jump.
#ifndef FINER_LAW_H
#define FINER_LAW_H

#include "real.h"

typedef enum {
  FORM_ALGEBRAIC, // x / sqrt(1 + x^2), the core's law `smooth`
  FORM_TANH,      // tanh x
  FORM_ARCTAN,    // (2/pi) atan x
  FORM_CUBIC,     // (3 x - x^3)/2, +-1 from |x| = 1 on
  FORM_SKEW,      // algebraic, and for x > 0 three times as steep near 0: not
                  // odd
  FORM_CORNER,    // |h|, |g| are sqrt(h^2 + width^2), sqrt(g^2 + width^2) in
                  // the force and the moment: smooth at h = g = 0, too
  FORM_ANGLE,     // x = h / (width |g|), clipped: the string's linear start
  FORM_TWO_PIECE, // Appendix B before the jump, k = 1 / width
  FORMS
} form_t;

typedef struct {
  double m, d, beta, k2, c1, c2, r0, omega0, mu, kappa, gamma; // as in scenes
  double width; // of the layer: m/s, or rad (ANGLE), or 1/k (TWO_PIECE)
  form_t form;
} machine_t;

// What the law needs, in the real type.
typedef struct {
  real_t mu, kappa, a, width, right;
  form_t form;
} law_t;

typedef struct {
  real_t F, M;
} force_t;

extern const char *const form_names[FORMS];

law_t law_of(const machine_t *machine);
real_t share(const law_t *law, real_t x); // phi
force_t force_at(const law_t *law, real_t h, real_t g);

#endif
