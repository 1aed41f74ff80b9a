// First root of a polynomial in an interval.
#include "polynomial.h"

#define MOST_INTERVALS 40
#define MOST_NEWTON 24

// How often the signs of the Bernstein coefficients on [low, high] change.
static int sign_changes(const series_t *s, tf_real_t low, tf_real_t high) {
  tf_real_t b[SERIES_ORDER + 1];
  for (int k = 0; k <= SERIES_ORDER; k++) b[k] = s->c[k];
  for (int j = 0; j < SERIES_ORDER; j++) // Taylor shift to low
    for (int i = SERIES_ORDER - 1; i >= j; i--) b[i] += low * b[i + 1];
  tf_real_t share = 1; // (high - low)^k over the binomial coefficient
  for (int k = 0; k <= SERIES_ORDER; k++) {
    b[k] *= share;
    share *= (high - low) * (tf_real_t)(k + 1) /
             (tf_real_t)(k < SERIES_ORDER ? SERIES_ORDER - k : 1);
  }
  for (int j = 1; j <= SERIES_ORDER; j++)
    for (int i = SERIES_ORDER; i >= j; i--) b[i] += b[i - 1];
  int changes = 0;
  bool above = true;
  for (int i = 0; i <= SERIES_ORDER; i++) {
    if (b[i] == 0 && i == 0) continue; // a root at low does not count
    if ((b[i] > 0) == above) continue;
    above = !above;
    changes++;
  }
  return changes;
}

static tf_real_t slope_at(const series_t *s, tf_real_t t) {
  tf_real_t sum = SERIES_ORDER * s->c[SERIES_ORDER];
  for (int k = SERIES_ORDER - 1; k > 0; k--)
    sum = sum * t + (tf_real_t)k * s->c[k];
  return sum;
}

// One root between low (value > 0) and high (value <= 0).
static tf_real_t refine(const series_t *s, tf_real_t low, tf_real_t high) {
  tf_real_t t = high;
  for (int i = 0; i < MOST_NEWTON; i++) {
    const tf_real_t f = value_at(s, t), slope = slope_at(s, t);
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

TF_API bool tf_first_root(const series_t *s, tf_real_t length,
                          tf_real_t *root) {
  tf_real_t low = 0, high = length, size = 0;
  for (int k = 0; k <= SERIES_ORDER; k++) size += magnitude(s->c[k]);
  if (size == 0) return false; // 0 throughout: it does not cross
  for (int i = 0; i < MOST_INTERVALS; i++) {
    const int changes = sign_changes(s, low, high);
    if (changes == 1) {
      *root = refine(s, low, high);
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
