/// The one integrator; see extrapolate.h.
#include "extrapolate.h"

typedef ref_real_t real_t;

enum { COLUMNS = 14 };

int ref_columns(real_t tolerance) {
  return tolerance > (real_t)1e-14L   ? 6
         : tolerance > (real_t)1e-20L ? 8
                                      : COLUMNS;
}

static ref_state_t along(ref_state_t x, real_t t, ref_state_t f) {
  x.r += t * f.r;
  x.p += t * f.p;
  x.z += t * f.z;
  x.t += t * f.t;
  return x;
}

ref_state_t ref_extrapolate(ref_slope_t slope, void *context, ref_state_t x,
                            real_t H, int columns, ref_state_t *coarser) {
  const ref_state_t start = slope(context, x);
  ref_state_t row[COLUMNS], end = x;
  *coarser = x;
  for (int k = 0; k < columns; ++k) {
    const int n = 2 * (k + 1);
    const real_t dt = H / (real_t)n;
    ref_state_t last = x, next = along(x, dt, start);
    for (int i = 1; i < n; ++i) {
      const ref_state_t after = along(last, 2 * dt, slope(context, next));
      last = next;
      next = after;
    }
    for (int j = 1; j <= k; ++j) {
      const real_t ratio = (real_t)(k + 1) / (real_t)(k + 1 - j);
      const real_t factor = 1 / (ratio * ratio - 1);
      const ref_state_t old = row[j - 1];
      const ref_state_t change = {next.r - old.r, next.p - old.p,
                                  next.z - old.z, next.t - old.t, 0};
      row[j - 1] = next;
      next = along(next, factor, change);
    }
    *coarser = k > 0 ? row[k - 1] : next;
    row[k] = end = next;
  }
  return end;
}

real_t ref_step_factor(real_t e, int columns) {
  const real_t by_order = -1 / (real_t)(2 * columns - 1);
  if (!(e <= 1))
    return ref_larger((real_t)0.9L * ref_pow(e, by_order), (real_t)0.1L);
  e = ref_larger(e, (real_t)1e-12L);
  return ref_smaller(4, (real_t)0.9L * ref_pow(e, by_order));
}

real_t ref_locate(ref_after_t after, void *context, real_t low, real_t high,
                  ref_state_t *at) {
  real_t f_low = after(context, low, at);
  real_t f_high = after(context, high, at);
  for (int i = 0; i < 120 && high - low > REF_EPSILON * high; ++i) {
    real_t mid = (low * f_high - high * f_low) / (f_high - f_low);
    if (!(mid > low && mid < high) || i > 60) mid = (low + high) / 2;
    const real_t f = after(context, mid, at);
    if (f > 0) {
      low = mid;
      f_low = f;
      f_high /= 2;
    } else {
      high = mid;
      f_high = f;
      f_low /= 2;
      if (f == 0) break;
    }
  }
  after(context, high, at);
  return high;
}
