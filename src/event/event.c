// The first event of a segment. An event is where a function of time vanishes
// that has one sign throughout the segment: h, g, mu - |lambda|, A, or kappa
// |F| - |M|. These are polynomials here, so their first roots are isolated by
// Descartes' rule on Bernstein coefficients (polynomial.h). Event-driven
// solvers that compare signs at the ends of steps, as in Piiroinen and
// Kuznetsov (2008), may pass over a pair of roots.
#include "segment.h"

// (of_p p + of_q q) / t^zeros, for a sum with a zero of that order at t = 0.
TF_INLINE tf_series_t combined_series(const tf_taylor_t *x, tf_real_t of_p,
                                      tf_real_t of_q, int zeros) {
  tf_series_t out;
  for (int n = 0; n <= TF_ORDER; n++)
    out.c[n] = n + zeros <= TF_ORDER
                   ? of_p * x->p.c[n + zeros] + of_q * x->q.c[n + zeros]
                   : 0;
  return out;
}

// |h|, by its sign in the segment. (h), (g) are linear in p and q.
TF_INLINE tf_series_t magnitude_of_h(const tf_taylor_t *x,
                                     const tf_segment_t *segment) {
  const tf_real_t sign = (tf_real_t)segment->sign_h;
  return combined_series(x, slip_from_pq(x->machine, sign, 0).h,
                         slip_from_pq(x->machine, 0, sign).h,
                         segment->h_zero_order);
}

// |g|, likewise.
TF_INLINE tf_series_t magnitude_of_g(const tf_taylor_t *x,
                                     const tf_segment_t *segment) {
  const tf_real_t sign = (tf_real_t)segment->sign_g;
  return combined_series(x, slip_from_pq(x->machine, sign, 0).g,
                         slip_from_pq(x->machine, 0, sign).g,
                         segment->g_starts_at_zero ? 1 : 0);
}

// bound - sign * series: how far the series is from the bound.
TF_INLINE tf_series_t margin_of(const tf_series_t *series, tf_real_t sign,
                                tf_real_t bound) {
  tf_series_t out;
  for (int n = 0; n <= TF_ORDER; n++) out.c[n] = -sign * series->c[n];
  out.c[0] += bound;
  return out;
}

// m (beta^2 + r^2) |A|, which is a quadratic in r; over t where A starts at 0.
TF_INLINE tf_series_t magnitude_of_A(const tf_taylor_t *x,
                                     const tf_segment_t *segment) {
  const delassus_quadratic_t at =
      delassus_quadratic(x->machine, (tf_real_t)segment->sign_g);
  tf_series_t A;
  for (int n = 0; n <= TF_ORDER; n++) A.c[n] = x->r2.c[n] + at.b * x->r.c[n];
  A.c[0] += at.c;
  if (segment->A_starts_at_zero) {
    for (int n = 0; n < TF_ORDER; n++) A.c[n] = A.c[n + 1];
    A.c[TF_ORDER] = 0;
  }
  if (A.c[0] < 0)
    for (int n = 0; n <= TF_ORDER; n++) A.c[n] = -A.c[n];
  return A;
}

// Whether a series that begins above 0 vanishes before *time, which then
// becomes its first root. Most series are far from 0, which costs little to
// see.
TF_INLINE bool vanishes_before(const tf_series_t *series, tf_real_t *time) {
  tf_real_t root;
  if (is_rootless(series, *time) || !tf_first_root(series, *time, &root))
    return false;
  *time = root;
  return true;
}

static tf_event_t event_in_slip(const tf_taylor_t *x,
                                const tf_segment_t *segment, tf_real_t capture,
                                tf_real_t *time) {
  const tf_series_t h = magnitude_of_h(x, segment);
  tf_event_t event =
      vanishes_before(&h, time) ? TF_EVENT_H_ZERO : TF_EVENT_NONE;
  if (x->machine->stick_kappa == 0) return event;
  const tf_series_t g = magnitude_of_g(x, segment);
  if (vanishes_before(&g, time)) event = TF_EVENT_G_ZERO;
  if (event == TF_EVENT_NONE) return event;
  const tf_real_t p = value_at(&x->p, *time), q = value_at(&x->q, *time);
  return magnitude(p) + magnitude(q) <= capture ? TF_EVENT_CODIM2 : event;
}

static tf_event_t event_in_stick(const tf_taylor_t *x,
                                 const tf_segment_t *segment, tf_real_t *time) {
  const tf_machine_t *k = x->machine;
  tf_event_t event = TF_EVENT_NONE;
  const tf_series_t below = margin_of(&x->F, 1, k->tyre.mu);
  const tf_series_t above = margin_of(&x->F, -1, k->tyre.mu);
  if (vanishes_before(&below, time)) event = TF_EVENT_RELEASE;
  if (vanishes_before(&above, time)) event = TF_EVENT_RELEASE;
  if (k->stick_kappa == 0) return event;
  const tf_series_t g = magnitude_of_g(x, segment);
  if (vanishes_before(&g, time)) event = TF_EVENT_CODIM2;
  const tf_series_t A = magnitude_of_A(x, segment);
  if (vanishes_before(&A, time)) event = TF_EVENT_TWO_FOLD;
  return event;
}

static tf_event_t event_while_pinned(const tf_taylor_t *x, tf_real_t *time) {
  const tf_machine_t *k = x->machine;
  const tf_real_t sign_F = x->F.c[0] < 0 ? TF_R(-1.0) : TF_R(1.0);
  tf_event_t event = TF_EVENT_NONE;
  const tf_series_t force = margin_of(&x->F, sign_F, k->tyre.mu);
  if (vanishes_before(&force, time)) event = TF_EVENT_UNPINNED;
  for (int sign_M = -1; sign_M <= 1; sign_M += 2) {
    tf_series_t moment; // kappa |F| -+ M
    for (int n = 0; n <= TF_ORDER; n++)
      moment.c[n] =
          sign_F * k->stick_kappa * x->F.c[n] - (tf_real_t)sign_M * x->M.c[n];
    if (vanishes_before(&moment, time)) event = TF_EVENT_UNPINNED;
  }
  return event;
}

TF_API tf_event_t tf_next_event(const tf_taylor_t *x,
                                const tf_segment_t *segment, tf_real_t length,
                                tf_real_t capture, tf_real_t *time) {
  *time = length;
  switch (segment->contact) {
    case TF_CONTACT_SLIP:
    case TF_CONTACT_CODIM2_SLIP:
      return event_in_slip(x, segment, capture, time);
    case TF_CONTACT_STICK:
    case TF_CONTACT_TWO_FOLD_STICK:
      return event_in_stick(x, segment, time);
    case TF_CONTACT_PINNED:
      return event_while_pinned(x, time);
    case TF_CONTACT_NONE:
    default:
      break;
  }
  return TF_EVENT_NONE;
}
