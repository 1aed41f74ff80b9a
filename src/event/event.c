// A located step under way, and the first event on a segment of it.
#include "../model/rates.h"
#include "trajectory.h"

TF_API rates_t tf_trajectory_rates(const trajectory_t *path) {
  return rates_at(path->motion.machine, path->motion.input, path->now.r,
                  path->now.p, path->now.z, path->omega);
}

TF_API bool tf_begin_series(trajectory_t *path) {
  taylor_t *motion = &path->motion;
  begin_taylor(motion, motion->machine, motion->input, path->omega, path->now);
  return tf_taylor_coefficients(motion, &path->segment, path->remaining);
}

TF_API span_t tf_segment_span(const trajectory_t *path) {
  const taylor_t *motion = &path->motion;
  if (motion->order < highest_order(motion))
    return (span_t){path->remaining, motion->allowed};
  const series_error_t allowed = {motion->at_once,
                                  motion->allowed - motion->at_once};
  const tf_real_t length = tf_segment_length(motion, path->remaining, allowed);
  return (span_t){
      length, allowed.at_once + allowed.by_change * (length / path->remaining)};
}

TF_API void tf_advance(trajectory_t *path, tf_real_t from, tf_real_t to) {
  const taylor_t *motion = &path->motion;
  const tf_real_t time = to - from;
  const int order = motion->order;
  phase_point_t now = {motion->r.c[order], motion->p.c[order],
                       motion->z.c[order]};
  for (int n = order - 1; n >= 0; n--) {
    now.r = now.r * to + motion->r.c[n];
    now.p = now.p * to + motion->p.c[n];
    now.z = now.z * to + motion->z.c[n];
  }
  path->now = now;
  if (motion->machine->with_angle) {
    path->angle += tf_angle_change(motion, to);
    if (from != 0) path->angle -= tf_angle_change(motion, from);
  }
  path->omega += motion->input->alpha * time;
  path->remaining = time < path->remaining ? path->remaining - time : 0;
}

TF_API void tf_take_force(trajectory_t *path, tf_real_t time) {
  const taylor_t *motion = &path->motion;
  path->force = (tf_force_t){value_at(&motion->F, motion->order, time),
                             value_at(&motion->M, motion->order, time)};
}

TF_API void tf_project(trajectory_t *path) {
  const tf_machine_t *k = path->motion.machine;
  const tf_real_t arm = path->now.r * k->cos_gamma;
  const tf_real_t J_over_m = gyration2_at(k, path->now.r);
  // m times the Delassus scalar of a force without moment.
  const tf_real_t mA = k->sin_gamma * k->sin_gamma + arm * arm / J_over_m;
  if (mA == 0) return;
  const tf_real_t impulse_over_m = trajectory_slip(path).h / mA;
  path->now.p += impulse_over_m * k->sin_gamma;
  path->now.z += impulse_over_m * arm / J_over_m;
}

// The first event of a segment: where one of some polynomials vanishes, found
// by Descartes' rule on Bernstein coefficients (polynomial.h), which misses
// none.

// An event function that is linear in p and q: (of_p p + of_q q) / t^zeros, for
// a sum with a zero of that order at t = 0.
typedef struct {
  tf_real_t of_p, of_q;
  int zeros;
} event_function_t;

TF_INLINE tf_real_t event_term(const taylor_t *motion, event_function_t f,
                               int n) {
  return f.of_p * motion->p.c[n] + f.of_q * motion->q.c[n];
}

// |h|, by its sign in the segment. (h), (g) are linear in p and q.
TF_INLINE event_function_t magnitude_of_h(const taylor_t *motion,
                                          const segment_t *segment) {
  const tf_real_t sign = unit(segment->sign_h);
  return (event_function_t){slip_from_pq(motion->machine, sign, 0).h,
                            slip_from_pq(motion->machine, 0, sign).h,
                            segment->h_zero_order};
}

// |g|, likewise.
TF_INLINE event_function_t magnitude_of_g(const taylor_t *motion,
                                          const segment_t *segment) {
  const tf_real_t sign = unit(segment->sign_g);
  return (event_function_t){slip_from_pq(motion->machine, sign, 0).g,
                            slip_from_pq(motion->machine, 0, sign).g,
                            segment->g_starts_at_zero ? 1 : 0};
}

// bound - sign * series: how far the series is from the bound.
TF_INLINE void margin_of(const series_t *series, int order, sign_t sign,
                         tf_real_t bound, series_t *out) {
  for (int n = 1; n <= order; n++) out->c[n] = with_sign(sign, -series->c[n]);
  out->c[0] = bound - with_sign(sign, series->c[0]);
}

// m (beta^2 + r^2) |A|, which is a quadratic in r; over t where A starts at 0.
TF_INLINE void magnitude_of_A(const taylor_t *motion, delassus_quadratic_t at,
                              int zeros, series_t *out) {
  const series_t *r = &motion->r;
  const int order = motion->order;
  tf_real_t first = square_term(r, zeros) + at.b * r->c[zeros];
  if (zeros == 0) first += at.c;
  const tf_real_t sign = unit(sign_of(first));
  out->c[0] = sign * first;
  for (int n = 1; n <= order; n++)
    out->c[n] =
        n + zeros <= order
            ? sign * (square_term(r, n + zeros) + at.b * r->c[n + zeros])
            : 0;
}

// Whether a series that begins above 0 vanishes before *time, which then
// becomes its first root. Most series are far from 0, which costs little to
// see.
TF_INLINE bool vanishes_before(const series_t *series, int order,
                               tf_real_t *time) {
  tf_real_t root;
  if (is_rootless(series, order, *time) ||
      !tf_first_root(series, order, *time, &root))
    return false;
  *time = root;
  return true;
}

// How much the terms of p and q beyond their lines may add within a time.
typedef struct {
  tf_real_t p, q;
} beyond_t;

TF_INLINE beyond_t changes_beyond_lines(const taylor_t *motion,
                                        tf_real_t length) {
  const int n = motion->order;
  const tf_real_t *p = motion->p.c, *q = motion->q.c;
  beyond_t sum = {magnitude(p[n]), magnitude(q[n])};
  for (int i = n - 1; i > 1; i--) {
    sum.p = sum.p * length + magnitude(p[i]);
    sum.q = sum.q * length + magnitude(q[i]);
  }
  // is_rootless() would see no more than that, but for its rounding.
  const tf_real_t more = (1 + 64 * TF_REAL_EPSILON) * length * length;
  return (beyond_t){sum.p * more, sum.q * more};
}

// Whether an event function keeps its sign whatever that adds: then
// is_rootless() would find so, too. Most are settled by this, without their own
// terms.
TF_INLINE bool event_function_stays(const taylor_t *motion, event_function_t f,
                                    beyond_t beyond, tf_real_t length) {
  const tf_real_t change = event_term(motion, f, 1) * length;
  return f.zeros == 0 &&
         event_term(motion, f, 0) + (change < 0 ? change : 0) >
             magnitude(f.of_p) * beyond.p + magnitude(f.of_q) * beyond.q;
}

TF_INLINE bool event_function_vanishes(const taylor_t *motion,
                                       event_function_t f, tf_real_t *time) {
  const int degree = motion->order - f.zeros;
  series_t series;
  for (int n = 0; n <= degree; n++)
    series.c[n] = event_term(motion, f, n + f.zeros);
  return vanishes_before(&series, degree, time);
}

// Whether A keeps its sign while r changes by what its terms can at most. Most
// segments are settled by this.
TF_INLINE bool delassus_stays(const taylor_t *motion, delassus_quadratic_t at,
                              tf_real_t length) {
  const tf_real_t r = motion->r.c[0];
  const tf_real_t change =
      magnitude(motion->r.c[1]) * length +
      change_beyond_line(&motion->r, motion->order, length);
  return magnitude(delassus_quadratic_at(at, r)) >
         (magnitude(delassus_quadratic_rate(at, r, 1)) + change) * change;
}

TF_INLINE bool delassus_vanishes(const taylor_t *motion,
                                 const segment_t *segment, tf_real_t *time) {
  const delassus_quadratic_t at =
      delassus_quadratic(motion->machine, segment->sign_g);
  if (!segment->A_starts_at_zero && delassus_stays(motion, at, *time))
    return false;
  series_t A;
  magnitude_of_A(motion, at, segment->A_starts_at_zero ? 1 : 0, &A);
  return vanishes_before(&A, motion->order, time);
}

static event_t event_in_slip(const taylor_t *motion, const segment_t *segment,
                             tf_real_t *time) {
  const event_function_t h = magnitude_of_h(motion, segment);
  const event_function_t g = magnitude_of_g(motion, segment);
  const beyond_t beyond = changes_beyond_lines(motion, *time);
  event_t event = EVENT_NONE;
  if (!event_function_stays(motion, h, beyond, *time) &&
      event_function_vanishes(motion, h, time))
    event = EVENT_H_ZERO;
  if (motion->machine->contact.stick_kappa == 0) return event;
  if (!event_function_stays(motion, g, beyond, *time) &&
      event_function_vanishes(motion, g, time))
    event = EVENT_G_ZERO;
  return event;
}

// |lambda| reaches mu.
TF_INLINE bool is_released(const taylor_t *motion, tf_real_t *time) {
  const int order = motion->order;
  const series_t *lambda = &motion->F;
  const tf_real_t mu = motion->machine->contact.tyre.mu;
  const tf_real_t others = change_beyond_line(lambda, order, *time);
  const tf_real_t at_end = lambda->c[0] + lambda->c[1] * *time; // of the line
  if (magnitude(lambda->c[0]) + others < mu && magnitude(at_end) + others < mu)
    return false;
  series_t below, above;
  margin_of(lambda, order, PLUS, mu, &below);
  margin_of(lambda, order, MINUS, mu, &above);
  const bool from_below = vanishes_before(&below, order, time);
  return vanishes_before(&above, order, time) || from_below;
}

static event_t event_in_stick(const taylor_t *motion, const segment_t *segment,
                              tf_real_t *time) {
  event_t event = is_released(motion, time) ? EVENT_RELEASE : EVENT_NONE;
  if (motion->machine->contact.stick_kappa == 0) return event;
  if (event_function_vanishes(motion, magnitude_of_g(motion, segment), time))
    event = EVENT_CODIM2;
  if (delassus_vanishes(motion, segment, time)) event = EVENT_TWO_FOLD;
  return event;
}

static event_t event_at_rest(const taylor_t *motion, tf_real_t *time) {
  const rest_motion_t rest = tf_rest_motion(motion->machine, motion->input,
                                            motion->r.c[0], motion->w.c[0]);
  return tf_rest_ends(&rest, time) ? EVENT_UNPINNED : EVENT_NONE;
}

TF_API event_t tf_next_event(const taylor_t *motion, const segment_t *segment,
                             tf_real_t length, tf_real_t *time) {
  *time = length;
  switch (segment->kind) {
    case SEGMENT_SLIP:
    case SEGMENT_CODIM2_SLIP:
      return event_in_slip(motion, segment, time);
    case SEGMENT_STICK:
    case SEGMENT_TWO_FOLD_STICK:
      return event_in_stick(motion, segment, time);
    case SEGMENT_PINNED:
      return event_at_rest(motion, time);
    case SEGMENT_FREE:
    default:
      break;
  }
  return EVENT_NONE;
}
