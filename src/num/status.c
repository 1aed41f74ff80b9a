// Names of the status codes; and the arithmetic, tried in a unit of the core as
// every other: pragma and flags are those of a step.
#include "twofold/status.h"

#include "kernel.h"

TF_API const char *tf_status_name(tf_status_t status) {
  switch (status) {
    case TF_OK:
      return "ok";
    case TF_DEGRADED:
      return "degraded: no mode was consistent and admissible";
    case TF_COARSE:
      return "too long for this motion: bounded, but not resolved";
    case TF_STALLED:
      return "the motion stalls: its change is lost in rounding";
    case TF_FELL_BACK:
      return "located step fell back on the Moreau-Jean step";
    case TF_BAD_PARAMETER:
      return "parameter out of its range";
    case TF_BAD_STATE:
      return "state or input not finite, out of range or impossible";
    case TF_DIVERGED:
      return "the motion leaves the range of states";
    case TF_STEP_TOO_LONG:
      return "step too long for this motion";
    default:
      return "unknown status";
  }
}

// A number that the compiler does not know, so that it folds nothing; and one
// that it has rounded.
static tf_real_t unknown(tf_real_t x) {
  const volatile tf_real_t kept = x;
  return kept;
}

static tf_real_t sum(tf_real_t x, tf_real_t y) {
  return unknown(unknown(x) + unknown(y));
}

// Upwards, downwards and towards 0 each miss one; the last is a tie.
static bool rounds_to_nearest(void) {
  const tf_real_t e = TF_REAL_EPSILON;
  const tf_real_t above = sum(1, e / 4), below = sum(-1, -e / 4);
  const tf_real_t outside = sum(1, 3 * e / 4), tie = sum(1, e / 2);
  return (above == 1) & (below == -1) & (outside == 1 + e) & (tie == 1);
}

static bool keeps_subnormals(void) {
  const tf_real_t half = unknown(unknown(TF_REAL_MIN) / 2);
  return unknown(half * 2) == TF_REAL_MIN;
}

// (1 + e)^2 = 1 + 2 e + e^2, of which rounding drops the last. A product that
// had a second use would not be fused.
static bool rounds_products(void) {
  const tf_real_t a = unknown(1 + TF_REAL_EPSILON), b = unknown(a);
  const tf_real_t c = unknown(1 + 2 * TF_REAL_EPSILON);
  const tf_real_t first = unknown(a * a - c), last = unknown(c - b * b);
  return (first == 0) & (last == 0);
}

static bool keeps_order(void) {
  const tf_real_t one = unknown(1), large = unknown(4 / TF_REAL_EPSILON);
  return unknown((one + large) - large) == 0;
}

// A reciprocal pays where several quotients share it; 5/3 and 7/3 differ.
static bool divides(void) {
  const tf_real_t b = unknown(3), n5 = unknown(5), n7 = unknown(7);
  const tf_real_t one = 1 / b, five = n5 / b, seven = n7 / b;
  const tf_real_t q1 = unknown(one), q5 = unknown(five), q7 = unknown(seven);
  return (q1 == TF_R(1.0) / 3) & (q5 == TF_R(5.0) / 3) & (q7 == TF_R(7.0) / 3);
}

static bool extracts_roots(void) {
  const tf_real_t two = unknown(square_root(unknown(2)));
  const tf_real_t three = unknown(square_root(unknown(3)));
  const tf_real_t five = unknown(square_root(unknown(5)));
  return (two == TF_R(1.41421356237309504880)) &
         (three == TF_R(1.73205080756887729353)) &
         (five == TF_R(2.23606797749978969641));
}

static bool keeps_sign_of_0(void) {
  return !__builtin_signbit(unknown(TF_R(-0.0)) + TF_R(0.0));
}

TF_API tf_arithmetic_t tf_arithmetic(void) {
  const bool holds[TF_ARITHMETICS] = {true,
                                      rounds_to_nearest(),
                                      keeps_subnormals(),
                                      rounds_products(),
                                      keeps_order(),
                                      divides(),
                                      extracts_roots(),
                                      keeps_sign_of_0()};
  for (int i = 1; i < TF_ARITHMETICS; i++)
    if (!holds[i]) return (tf_arithmetic_t)i;
  return TF_ARITHMETIC_OK;
}

TF_API const char *tf_arithmetic_name(tf_arithmetic_t arithmetic) {
  switch (arithmetic) {
    case TF_ARITHMETIC_OK:
      return "ok";
    case TF_ARITHMETIC_ROUNDING:
      return "sums are not rounded to nearest: fesetround(FE_TONEAREST) first";
    case TF_ARITHMETIC_SUBNORMAL:
      return "subnormal numbers count as 0: clear FTZ and DAZ, which code "
             "linked with -ffast-math sets";
    case TF_ARITHMETIC_FUSED:
      return "a b - c is rounded once: compile without -ffp-contract=fast";
    case TF_ARITHMETIC_REORDERED:
      return "sums are reordered: compile without -fassociative-math";
    case TF_ARITHMETIC_QUOTIENT:
      return "a / b is not rounded correctly: compile without "
             "-freciprocal-math, which -funsafe-math-optimizations implies";
    case TF_ARITHMETIC_ROOT:
      return "sqrt is not rounded correctly: compile without "
             "-funsafe-math-optimizations";
    case TF_ARITHMETIC_ZERO:
      return "-0 + 0 is -0: compile without -fno-signed-zeros";
    case TF_ARITHMETICS:
    default:
      return "unknown arithmetic";
  }
}
