// First root of a polynomial in an interval. Most fall throughout: their one
// root, or none, is there without a look at the signs of coefficients.
#include "polynomial.h"

// How often an interval is halved: roots closer to each other than what is left
// of it then are no crossing. In float that is more than its digits are.
#ifdef TF_REAL_FLOAT
#define MAX_INTERVALS 24
#else
#define MAX_INTERVALS 40
#endif
#define MAX_NEWTON 24

// How often the signs of the Bernstein coefficients on [low, high] change.
static int sign_changes(const series_t *s, int degree, tf_real_t low,
                        tf_real_t high) {
  tf_real_t b[SERIES_ORDER + 1];
  for (int n = 0; n <= degree; n++) b[n] = s->c[n];
  for (int j = 0; j < degree && low != 0; j++) // Taylor shift to low
    for (int i = degree - 1; i >= j; i--) b[i] += low * b[i + 1];
  tf_real_t share = 1; // (high - low)^n over the binomial coefficient
  for (int n = 1; n <= degree; n++) {
    share *= (high - low) * (tf_real_t)n * reciprocal[degree - n + 1];
    b[n] *= share;
  }
  for (int j = 1; j <= degree; j++)
    for (int i = degree; i >= j; i--) b[i] += b[i - 1];
  int changes = 0;
  bool above = true;
  for (int i = 0; i <= degree; i++) {
    if (b[i] == 0 && i == 0) continue; // a root at low does not count
    if ((b[i] > 0) == above) continue;
    above = !above;
    changes++;
  }
  return changes;
}

// Whether s falls throughout (0, length]: whether its first slope outweighs
// what the others add to it.
static bool falls(const series_t *s, int degree, tf_real_t length) {
  tf_real_t sum = 0;
  for (int n = degree; n > 1; n--)
    sum = (sum + (tf_real_t)n * magnitude(s->c[n])) * length;
  return s->c[1] < -sum;
}

// One root between low (value > 0) and high (value <= 0).
static tf_real_t refine(const series_t *s, int degree, tf_real_t low,
                        tf_real_t high) {
  tf_real_t t = high;
  for (int i = 0; i < MAX_NEWTON; i++) {
    tf_real_t f = s->c[degree], slope = 0;
    for (int n = degree - 1; n >= 0; n--) {
      slope = slope * t + f;
      f = f * t + s->c[n];
    }
    if (f > 0)
      low = t;
    else
      high = t;
    const tf_real_t step = f / slope;
    if (within(step, TF_REAL_EPSILON * high)) return t;
    const tf_real_t next = t - step;
    t = next > low && next < high ? next : low + (high - low) / 2;
  }
  return t;
}

TF_API bool tf_first_root(const series_t *s, int degree, tf_real_t length,
                          tf_real_t *root) {
  if (s->c[0] > 0 && falls(s, degree, length)) {
    if (value_at(s, degree, length) > 0) return false;
    *root = refine(s, degree, 0, length);
    return true;
  }
  tf_real_t low = 0, high = length, size = 0;
  for (int n = 0; n <= degree; n++) size += magnitude(s->c[n]);
  if (size == 0) return false; // 0 throughout: it does not cross
  for (int i = 0; i < MAX_INTERVALS; i++) {
    const int changes = sign_changes(s, degree, low, high);
    if (changes == 1) {
      *root = refine(s, degree, low, high);
      return true;
    }
    if (changes > 1) {
      high = low + (high - low) / 2;
      continue;
    }
    if (!(high < length)) return false;
    const tf_real_t wider = high + 2 * (high - low);
    low = high;
    high = wider < length ? wider : length;
  }
  // The polynomial touches zero, or comes so near that halving cannot decide:
  // no crossing.
  return false;
}
