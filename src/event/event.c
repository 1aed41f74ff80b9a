// The first event of a segment. An event is where a function of time vanishes
// that has one sign throughout the segment: h, g, mu - |lambda|, A, or kappa
// |F| - |M|. These are polynomials here, so their first roots are isolated by
// Descartes' rule on Bernstein coefficients (polynomial.h). Event-driven
// solvers that compare signs at the ends of steps, as in Piiroinen and
// Kuznetsov (2008), may pass over a pair of roots.
#include "../friction/rest_law.h"
#include "segment.h"

// (of_p p + of_q q) / t^zeros, for a sum with a zero of that order at t = 0.
TF_INLINE series_t combined_series(const taylor_t *motion, tf_real_t of_p,
                                   tf_real_t of_q, int zeros) {
  series_t out;
  for (int n = 0; n <= SERIES_ORDER; n++)
    out.c[n] = n + zeros <= SERIES_ORDER ? of_p * motion->p.c[n + zeros] +
                                               of_q * motion->q.c[n + zeros]
                                         : 0;
  return out;
}

// |h|, by its sign in the segment. (h), (g) are linear in p and q.
TF_INLINE series_t magnitude_of_h(const taylor_t *motion,
                                  const segment_t *segment) {
  const tf_real_t sign = (tf_real_t)segment->sign_h;
  return combined_series(motion, slip_from_pq(motion->machine, sign, 0).h,
                         slip_from_pq(motion->machine, 0, sign).h,
                         segment->h_zero_order);
}

// |g|, likewise.
TF_INLINE series_t magnitude_of_g(const taylor_t *motion,
                                  const segment_t *segment) {
  const tf_real_t sign = (tf_real_t)segment->sign_g;
  return combined_series(motion, slip_from_pq(motion->machine, sign, 0).g,
                         slip_from_pq(motion->machine, 0, sign).g,
                         segment->g_starts_at_zero ? 1 : 0);
}

// bound - sign * series: how far the series is from the bound.
TF_INLINE series_t margin_of(const series_t *series, tf_real_t sign,
                             tf_real_t bound) {
  series_t out;
  for (int n = 0; n <= SERIES_ORDER; n++) out.c[n] = -sign * series->c[n];
  out.c[0] += bound;
  return out;
}

// m (beta^2 + r^2) |A|, which is a quadratic in r; over t where A starts at 0.
TF_INLINE series_t magnitude_of_A(const taylor_t *motion,
                                  const segment_t *segment) {
  const delassus_quadratic_t at =
      delassus_quadratic(motion->machine, (tf_real_t)segment->sign_g);
  series_t A;
  for (int n = 0; n <= SERIES_ORDER; n++)
    A.c[n] = motion->r2.c[n] + at.b * motion->r.c[n];
  A.c[0] += at.c;
  if (segment->A_starts_at_zero) {
    for (int n = 0; n < SERIES_ORDER; n++) A.c[n] = A.c[n + 1];
    A.c[SERIES_ORDER] = 0;
  }
  if (A.c[0] < 0)
    for (int n = 0; n <= SERIES_ORDER; n++) A.c[n] = -A.c[n];
  return A;
}

// Whether a series that begins above 0 vanishes before *time, which then
// becomes its first root. Most series are far from 0, which costs little to
// see.
TF_INLINE bool vanishes_before(const series_t *series, tf_real_t *time) {
  tf_real_t root;
  if (is_rootless(series, *time) || !tf_first_root(series, *time, &root))
    return false;
  *time = root;
  return true;
}

static event_t event_in_slip(const taylor_t *motion, const segment_t *segment,
                             tf_real_t capture, tf_real_t *time) {
  const series_t h = magnitude_of_h(motion, segment);
  event_t event = vanishes_before(&h, time) ? EVENT_H_ZERO : EVENT_NONE;
  if (motion->machine->stick_kappa == 0) return event;
  const series_t g = magnitude_of_g(motion, segment);
  if (vanishes_before(&g, time)) event = EVENT_G_ZERO;
  if (event == EVENT_NONE) return event;
  const tf_real_t p = value_at(&motion->p, *time),
                  q = value_at(&motion->q, *time);
  return magnitude(p) + magnitude(q) <= capture ? EVENT_CODIM2 : event;
}

static event_t event_in_stick(const taylor_t *motion, const segment_t *segment,
                              tf_real_t *time) {
  const tf_machine_t *k = motion->machine;
  event_t event = EVENT_NONE;
  const series_t below = margin_of(&motion->F, 1, k->tyre.mu);
  const series_t above = margin_of(&motion->F, -1, k->tyre.mu);
  if (vanishes_before(&below, time)) event = EVENT_RELEASE;
  if (vanishes_before(&above, time)) event = EVENT_RELEASE;
  if (k->stick_kappa == 0) return event;
  const series_t g = magnitude_of_g(motion, segment);
  if (vanishes_before(&g, time)) event = EVENT_CODIM2;
  const series_t A = magnitude_of_A(motion, segment);
  if (vanishes_before(&A, time)) event = EVENT_TWO_FOLD;
  return event;
}

// bound - |a| + slope |b| as long as a and b have these signs; for all signs
// together it is that at every time.
TF_INLINE series_t margin_of_rest(const series_t *a, tf_real_t sign_a,
                                  tf_real_t bound, const series_t *b,
                                  tf_real_t slope) {
  series_t out = margin_of(a, sign_a, bound);
  for (int n = 0; n <= SERIES_ORDER; n++) out.c[n] += slope * b->c[n];
  return out;
}

// |F| and |M| reach their bounds under the law of rest. Where a bound grows
// with the other one (the bow tie) only the present sign of that one counts.
static event_t event_while_pinned(const taylor_t *motion, tf_real_t *time) {
  const tf_machine_t *k = motion->machine;
  const rest_bounds_t at = rest_bounds(k->rest);
  const tf_real_t mu = k->tyre.mu, kappa = k->stick_kappa;
  const tf_real_t sign_F = motion->F.c[0] < 0 ? TF_R(-1.0) : TF_R(1.0);
  event_t event = EVENT_NONE;
  for (int s = -1; s <= 1; s += 2) {
    const tf_real_t sign = (tf_real_t)s;
    for (int t = -1; t <= 1; t += 2) {
      const series_t force =
          margin_of_rest(&motion->F, sign, at.x0 * mu, &motion->M,
                         (tf_real_t)t * at.x1 / kappa);
      if (vanishes_before(&force, time)) event = EVENT_UNPINNED;
    }
    const series_t moment = margin_of_rest(&motion->M, sign, at.y0 * kappa * mu,
                                           &motion->F, sign_F * kappa * at.y1);
    if (vanishes_before(&moment, time)) event = EVENT_UNPINNED;
  }
  return event;
}

TF_API event_t tf_next_event(const taylor_t *motion, const segment_t *segment,
                             tf_real_t length, tf_real_t capture,
                             tf_real_t *time) {
  *time = length;
  switch (segment->contact) {
    case CONTACT_SLIP:
    case CONTACT_CODIM2_SLIP:
      return event_in_slip(motion, segment, capture, time);
    case CONTACT_STICK:
    case CONTACT_TWO_FOLD_STICK:
      return event_in_stick(motion, segment, time);
    case CONTACT_PINNED:
      return event_while_pinned(motion, time);
    case CONTACT_NONE:
    default:
      break;
  }
  return EVENT_NONE;
}
