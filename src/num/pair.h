// Numbers as unevaluated sums hi + lo of two tf_real_t (double-word
// arithmetic), for the compensated step alone. The first four functions are
// error-free transformations (Dekker 1971, Knuth, Shewchuk 1997): exact under
// rounding to nearest without contraction, which rounding.h and the Makefile
// ensure. The others are built from them. There is no fused multiply-add here,
// because a target without the instruction would call a library for it.
#ifndef TF_PAIR_H
#define TF_PAIR_H

#include "kernel.h"

typedef struct {
  tf_real_t hi, lo;
} pair_t;

// a + b = hi + lo exactly, whichever is larger.
TF_INLINE pair_t two_sum(tf_real_t a, tf_real_t b) {
  const tf_real_t hi = a + b, of_b = hi - a, of_a = hi - of_b;
  return (pair_t){hi, (a - of_a) + (b - of_b)};
}

// The same in half the operations where |a| >= |b| or a is 0.
TF_INLINE pair_t fast_two_sum(tf_real_t a, tf_real_t b) {
  const tf_real_t hi = a + b;
  return (pair_t){hi, b - (hi - a)};
}

// x as a sum of two numbers of half as many digits, whose products are exact.
// States and constants stay far below the overflow of this.
TF_INLINE pair_t veltkamp_split(tf_real_t x) {
#ifdef TF_REAL_FLOAT
  const tf_real_t up = x * TF_R(4097.0); // 2^12 + 1
#else
  const tf_real_t up = x * TF_R(134217729.0); // 2^27 + 1
#endif
  const tf_real_t hi = up - (up - x);
  return (pair_t){hi, x - hi};
}

// a b = hi + lo exactly, but for underflow.
TF_INLINE pair_t two_product(tf_real_t a, tf_real_t b) {
  const tf_real_t hi = a * b;
  const pair_t x = veltkamp_split(a), y = veltkamp_split(b);
  return (pair_t){
      hi, x.lo * y.lo - (((hi - x.hi * y.hi) - x.lo * y.hi) - x.hi * y.lo)};
}

// The operations below let lo grow to a few epsilon of the larger operand,
// which does no harm to the next operation. Where operands may have cancelled,
// this makes hi the number nearest to the pair again.
TF_INLINE pair_t pair_normalized(pair_t a) { return two_sum(a.hi, a.lo); }

// a b to about the square of epsilon.
TF_INLINE pair_t pair_product(pair_t a, pair_t b) {
  const pair_t p = two_product(a.hi, b.hi);
  return (pair_t){p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi)};
}

// a s for a number s.
TF_INLINE pair_t pair_times(pair_t a, tf_real_t s) {
  const pair_t p = two_product(a.hi, s);
  return (pair_t){p.hi, p.lo + a.lo * s};
}

// a + b to about the square of epsilon of the larger operand: a sum that nearly
// cancels keeps the digits that its terms had.
TF_INLINE pair_t pair_sum(pair_t a, pair_t b) {
  const pair_t s = two_sum(a.hi, b.hi);
  return (pair_t){s.hi, s.lo + (a.lo + b.lo)};
}

// a + s for a number s.
TF_INLINE pair_t pair_plus(pair_t a, tf_real_t s) {
  const pair_t t = two_sum(a.hi, s);
  return (pair_t){t.hi, t.lo + a.lo};
}

TF_INLINE pair_t pair_negative(pair_t a) { return (pair_t){-a.hi, -a.lo}; }

TF_INLINE pair_t pair_difference(pair_t a, pair_t b) {
  return pair_sum(a, pair_negative(b));
}

// a / b to about the square of epsilon: a quotient and the remainder over b.
TF_INLINE pair_t pair_quotient(pair_t a, pair_t b) {
  const tf_real_t q = a.hi / b.hi;
  const pair_t remainder = pair_difference(a, pair_times(b, q));
  return (pair_t){q, (remainder.hi + remainder.lo) / b.hi};
}

#endif
