// Polynomials of a degree up to SERIES_ORDER on [0, length]: value and first
// root. A root is where the value falls from above 0 to 0; for one where it
// rises, pass the polynomial with its sign changed.
#ifndef TF_POLYNOMIAL_H
#define TF_POLYNOMIAL_H

#include "kernel.h"

// Highest order of the Taylor series of tf_step_located, below FINE_TOLERANCE
// and else: DESIGN.md, section 9, compares it with others.
#ifdef TF_REAL_FLOAT
#define SERIES_ORDER 6
#define USUAL_ORDER 6
#else
#define SERIES_ORDER 10
#define USUAL_ORDER 8
#endif
#define FINE_TOLERANCE TF_R(1e-8)

// 1/1, 1/2 ... to 1/(SERIES_ORDER + 1): they save a division for each term.
static const tf_real_t reciprocal[] = {
    0,
    TF_R(1.0) / 1,
    TF_R(1.0) / 2,
    TF_R(1.0) / 3,
    TF_R(1.0) / 4,
    TF_R(1.0) / 5,
    TF_R(1.0) / 6,
    TF_R(1.0) / 7,
    TF_R(1.0) / 8,
    TF_R(1.0) / 9,
#ifndef TF_REAL_FLOAT // SERIES_ORDER
    TF_R(1.0) / 10,
    TF_R(1.0) / 11,
#endif
};

typedef struct {
  tf_real_t c[SERIES_ORDER + 1];
} series_t;

TF_INLINE tf_real_t value_at(const series_t *s, int degree, tf_real_t t) {
  tf_real_t sum = s->c[degree];
  for (int n = degree - 1; n >= 0; n--) sum = sum * t + s->c[n];
  return sum;
}

// What the terms beyond c0 + c1 t together can add within the length, at most.
TF_INLINE tf_real_t change_beyond_line(const series_t *s, int degree,
                                       tf_real_t length) {
  tf_real_t sum = magnitude(s->c[degree]);
  for (int n = degree - 1; n > 1; n--) sum = sum * length + magnitude(s->c[n]);
  return sum * length * length;
}

// Whether that line stays above as much. Then there is no root; most segments
// are settled by this. Of a series on the stack no term beyond the degree,
// which is not 0, is set or read.
TF_INLINE bool is_rootless(const series_t *s, int degree, tf_real_t length) {
  // cppcheck-suppress ctuuninitvar
  const tf_real_t change = s->c[1] * length;
  return s->c[0] + (change < 0 ? change : 0) >
         change_beyond_line(s, degree, length);
}

// The smallest root in (0, length], by the signs of the Bernstein coefficients
// (Descartes: no change, no root; one change, one root) on intervals that are
// halved from the left, then by Newton's method within the bracket. c0 > 0, or
// c0 = 0, and then the root at 0 does not count. Returns whether there is one.
#define tf_first_root TF_LINK(tf_first_root)
TF_API bool tf_first_root(const series_t *s, int degree, tf_real_t length,
                          tf_real_t *root);

#endif
