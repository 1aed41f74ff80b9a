// The first switch on a segment.
#include "segment.h"

// scale (x p + y q), divided by t^zeros where it has a zero at 0.
TF_INLINE tf_series_t combined(const tf_taylor_t *s, tf_real_t x, tf_real_t y,
                               int zeros) {
  tf_series_t out;
  for (int n = 0; n <= TF_ORDER; n++)
    out.c[n] = n + zeros <= TF_ORDER
                   ? x * s->p.c[n + zeros] + y * s->q.c[n + zeros]
                   : 0;
  return out;
}

TF_INLINE tf_series_t h_series(const tf_taylor_t *s, int side, int zeros) {
  const tf_real_t sign = (tf_real_t)side;
  return combined(s, sign * s->machine->minus_sin_gamma,
                  -sign * s->machine->cos_gamma, zeros);
}

TF_INLINE tf_series_t g_series(const tf_taylor_t *s, int roll, int zeros) {
  const tf_real_t sign = (tf_real_t)roll;
  return combined(s, -sign * s->machine->cos_gamma,
                  sign * s->machine->sin_gamma, zeros);
}

// The root of a series if it comes before *when, which it then becomes.
TF_INLINE bool earlier(const tf_series_t *s, tf_real_t *when) {
  tf_real_t root;
  if (is_rootless(s, *when) || !tf_first_root(s, *when, &root)) return false;
  *when = root;
  return true;
}

static tf_event_t event_in_slip(const tf_taylor_t *s, const tf_segment_t *g,
                                tf_real_t capture, tf_real_t *when) {
  const tf_series_t h = h_series(s, g->side, g->h_zeros);
  tf_event_t found = earlier(&h, when) ? TF_EVENT_H_ZERO : TF_EVENT_NONE;
  if (s->machine->stick_kappa == 0) return found;
  const tf_series_t roll = g_series(s, g->roll, g->g_is_0 ? 1 : 0);
  if (earlier(&roll, when)) found = TF_EVENT_G_ZERO;
  if (found == TF_EVENT_NONE) return found;
  const tf_real_t p = value_at(&s->p, *when), q = value_at(&s->q, *when);
  return magnitude(p) + magnitude(q) <= capture ? TF_EVENT_CODIM2 : found;
}

// bound - sign * series.
TF_INLINE tf_series_t room(const tf_series_t *s, tf_real_t sign,
                           tf_real_t bound) {
  tf_series_t out;
  for (int n = 0; n <= TF_ORDER; n++) out.c[n] = -sign * s->c[n];
  out.c[0] += bound;
  return out;
}

static tf_event_t event_in_stick(const tf_taylor_t *s, const tf_segment_t *g,
                                 tf_real_t *when) {
  const tf_machine_t *k = s->machine;
  tf_event_t found = TF_EVENT_NONE;
  const tf_series_t up = room(&s->F, 1, k->tyre.mu);
  const tf_series_t down = room(&s->F, -1, k->tyre.mu);
  if (earlier(&up, when)) found = TF_EVENT_RELEASE;
  if (earlier(&down, when)) found = TF_EVENT_RELEASE;
  if (k->stick_kappa == 0) return found;
  const tf_series_t roll = g_series(s, g->roll, g->g_is_0 ? 1 : 0);
  if (earlier(&roll, when)) found = TF_EVENT_CODIM2;
  // m (beta^2 + r^2) A(r, s): a quadratic of r, and no division.
  const delassus_quadratic_t at = delassus_quadratic(k, (tf_real_t)g->roll);
  tf_series_t A;
  for (int n = 0; n <= TF_ORDER; n++) A.c[n] = s->rr.c[n] + at.b * s->r.c[n];
  A.c[0] += at.c;
  if (g->A_is_0) {
    for (int n = 0; n < TF_ORDER; n++) A.c[n] = A.c[n + 1];
    A.c[TF_ORDER] = 0;
  }
  if (A.c[0] < 0)
    for (int n = 0; n <= TF_ORDER; n++) A.c[n] = -A.c[n];
  if (earlier(&A, when)) found = TF_EVENT_TWO_FOLD;
  return found;
}

static tf_event_t event_while_pinned(const tf_taylor_t *s, tf_real_t *when) {
  const tf_machine_t *k = s->machine;
  const tf_real_t sign = s->F.c[0] < 0 ? TF_R(-1.0) : TF_R(1.0);
  tf_event_t found = TF_EVENT_NONE;
  const tf_series_t force = room(&s->F, sign, k->tyre.mu);
  if (earlier(&force, when)) found = TF_EVENT_UNPINNED;
  for (int turn = -1; turn <= 1; turn += 2) { // kappa |F| -+ M
    tf_series_t moment;
    for (int n = 0; n <= TF_ORDER; n++)
      moment.c[n] =
          sign * k->stick_kappa * s->F.c[n] - (tf_real_t)turn * s->M.c[n];
    if (earlier(&moment, when)) found = TF_EVENT_UNPINNED;
  }
  return found;
}

TF_API tf_event_t tf_next_event(const tf_taylor_t *s, const tf_segment_t *g,
                                tf_real_t length, tf_real_t capture,
                                tf_real_t *when) {
  *when = length;
  switch (g->closure) {
    case TF_CONTACT_SLIP:
    case TF_CONTACT_CODIM2_SLIP:
      return event_in_slip(s, g, capture, when);
    case TF_CONTACT_STICK:
    case TF_CONTACT_TWO_FOLD_STICK:
      return event_in_stick(s, g, when);
    case TF_CONTACT_PINNED:
      return event_while_pinned(s, when);
    case TF_CONTACT_NONE:
    default:
      break;
  }
  return TF_EVENT_NONE;
}
