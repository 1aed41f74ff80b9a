/* Segments of a located step: how h begins in one, and that the parts of its
 * series make up the whole. */
#include "codim2_field.h"
#include "event/trajectory.h"

/* The parts of a series, one after the other, turn the disc as far as the whole
 * does: a slip that follows a limit direction begins in the middle of one. */
TEST(angle_of_a_series_is_the_sum_of_its_parts) {
  for (int n = 0; n < 200; n++) {
    tf_params_t params = any_params(n);
    params.law = TF_TYRE_NONE;
    params.with_angle = true;
    const tf_machine_t k = prepared(&params);
    const tf_input_t u = tf_input_default(&k);
    static trajectory_t whole, part;
    whole =
        (trajectory_t){.motion = {.machine = &k, .input = &u},
                       .omega = u.omega0,
                       .remaining = TF_R(0.02),
                       .now = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}};
    CHECK(tf_begin_series(&whole));
    part = whole;
    const tf_real_t middle = uniform(0.005, 0.015);
    tf_advance(&part, 0, middle);
    tf_advance(&part, middle, whole.remaining);
    tf_advance(&whole, 0, whole.remaining);
    CHECK_NEAR(wide(part.angle), wide(whole.angle), 64 * EPSILON);
  }
}

/* A stick whose force has come to mu, on a trajectory that nothing else has
 * happened to: the load makes it so. */
static void begin_at_release(trajectory_t *path, const tf_machine_t *k,
                             tf_input_t *u, unsigned mode, real lambda) {
  const int s = mode == TF_STICK_MINUS;
  const tf_real_t r = uniform(0.1, 0.6), z = uniform(-1, 1);
  const tf_real_t p = -r * z * k->cos_gamma / k->sin_gamma;
  const rates_t rates = rates_at(k, u, r, p, z, u->omega0);
  *path = (trajectory_t){
      .motion = {.machine = k, .input = u},
      .omega = u->omega0,
      .remaining = k->dt,
      .now = {r, p, z},
      .mode = mode,
      .force = {.F = (tf_real_t)lambda},
      .segment = {.kind = SEGMENT_STICK, .sign_g = s ? MINUS : PLUS}};
  /* A force f changes N by -sin f/m - r cos d f/J. */
  const real missing = wide(rates.A[s]) * lambda - wide(rates.N);
  const real J = wide(inertia_at(k, r)), sine = wide(k->sin_gamma);
  u->force += (tf_real_t)(missing / (-sine / wide(k->m) -
                                     wide(r * k->cos_gamma) * wide(k->d) / J));
}

/* An attracting stick is left along h = 0, with t^2, and an escaping one at an
 * angle, with t: the order of the zero that is divided out of h. */
TEST(released_slip_begins_with_its_order) {
  int of_order[3] = {0};
  for (int n = 0; n < 4000; n++) {
    const tf_params_t params = any_params(n);
    const tf_machine_t k = prepared(&params);
    tf_input_t u = tf_input_default(&k);
    static trajectory_t path;
    const unsigned mode = n & 1 ? TF_STICK_MINUS : TF_STICK_PLUS;
    const real lambda = (n & 2 ? 1 : -1) * wide(params.mu);
    begin_at_release(&path, &k, &u, mode, lambda);
    const tf_slip_t slip = trajectory_slip(&path);
    if (fabsl(wide(u.force)) > 100 || (slip.g < 0) != (n & 1)) continue;
    const real A = wide(tf_trajectory_rates(&path).A[n & 1]);
    CHECK(tf_next_segment(&path, EVENT_RELEASE) && tf_begin_series(&path));
    const real h1 =
        wide(slip_from_pq(&k, path.motion.p.c[1], path.motion.q.c[1]).h);
    const real sign = wide(unit(path.segment.sign_h));
    const int order = path.segment.h_zero_order;
    if (A > 0)
      CHECK_NEAR(h1, 0, 1e5L * EPSILON);
    else
      CHECK_NEAR(sign * h1, 2 * fabsl(A * lambda), 1e5L * EPSILON * (1 - A));
    CHECK(order == (A > 0 ? 2 : 1));
    of_order[order]++;
  }
  for (int i = 1; i <= 2; i++) CHECK_ABOVE(of_order[i], 100);
}

/* The series of a stick keeps h at 0 as far as it goes, with as many terms as
 * the tolerance asks for; above 8 only below 1e-8. */
TEST(series_of_a_stick_keeps_h_at_zero) {
  int of_order[SERIES_ORDER + 1] = {0};
  for (int n = 0; n < 4000; n++) {
    tf_params_t params = any_params(n);
    params.tolerance = (tf_real_t)pow(10, (double)uniform(-12, -3.1));
    const tf_machine_t k = prepared(&params);
    tf_input_t u = tf_input_default(&k);
    static trajectory_t path;
    const unsigned mode = n & 1 ? TF_STICK_MINUS : TF_STICK_PLUS;
    begin_at_release(&path, &k, &u, mode, 0);
    path.remaining = (tf_real_t)pow(10, (double)uniform(-6, 0));
    if (!tf_begin_series(&path)) continue;
    const span_t span = tf_segment_span(&path);
    CHECK(path.motion.order <= 8 || params.tolerance < 1e-8);
    of_order[path.motion.order]++;
    tf_advance(&path, 0, span.length);
    const tf_real_t off = magnitude(trajectory_slip(&path).h);
    CHECK_NEAR(wide(off), 0,
               16 * wide(span.error + 64 * trajectory_rounding(&path)));
  }
  for (int i = 3; i <= SERIES_ORDER; i++) CHECK_ABOVE(of_order[i], 10);
}

/* A step in slip under a tolerance below 1e-8, with up to ten terms, ends where
 * one of the next tolerance does. */
TEST(series_of_a_slip_holds_its_tolerance) {
  int fine = 0;
  for (int n = 0; n < 3000; n++) {
    tf_params_t params = any_params(n);
    tf_state_t end[2] = {{.r = uniform(-1, 1),
                          .v = uniform(-1, 1),
                          .w = uniform(-2, 2),
                          .mode = TF_NO_MODE}};
    tf_status_t status = TF_OK;
    params.dt = (tf_real_t)pow(10, (double)uniform(-4, -1));
    end[1] = end[0];
    for (int i = 0; i < 2 && status == TF_OK; i++) {
      tf_report_t report;
      params.tolerance = i ? TF_R(1e-11) : TF_R(1e-9);
      const tf_machine_t k = prepared(&params);
      const tf_input_t u = tf_input_default(&k);
      status = tf_begin(&k, &end[i], &u, &report);
      if (status == TF_OK) status = tf_step_located(&k, &end[i], &u, &report);
      if (!tf_mode_is_slip(end[i].mode)) status = TF_COARSE;
    }
    if (status != TF_OK || end[0].mode != end[1].mode) continue;
    fine++;
    const real size = 1 + fabsl(wide(end[0].v)) + fabsl(wide(end[0].w));
    CHECK_NEAR(wide(end[0].v), wide(end[1].v), (1e-6L + 1e3L * EPSILON) * size);
  }
  CHECK_ABOVE(fine, 100);
}

/* The paper's A m (beta^2 + r^2) where the series of r has come to, as a share
 * of its terms. */
static real delassus_after(const paper_t *paper, const taylor_t *motion, real t,
                           int sign) {
  const real beta2 = paper->beta * paper->beta;
  real r = 0, size = 0;
  for (int c = motion->order; c >= 0; c--) {
    r = r * t + wide(motion->r.c[c]);
    size += fabsl(wide(motion->r.c[c]));
  }
  return paper_delassus(paper, r, sign) * paper->m * (beta2 + r * r) /
         (beta2 + size * (size + paper->kappa));
}

/* A stick comes to a two-fold where the paper's A vanishes, and A has not
 * changed its sign before: also next to the r where A is stationary, and where
 * r turns on its way. */
TEST(stick_ends_where_the_delassus_scalar_vanishes) {
  int vanishes = 0, stays = 0;
  for (int n = 0; n < 4000; n++) {
    const tf_params_t params = any_params(n);
    const tf_machine_t k = prepared(&params);
    const paper_t paper = paper_of(&params);
    const int sign = n & 1 ? -1 : 1;
    const tf_real_t vertex =
        (tf_real_t)-sign * k.contact.stick_kappa * k.cos_gamma / 2;
    const tf_real_t about = n & 2 ? vertex : uniform(-0.5, 0.5);
    static taylor_t motion;
    motion = (taylor_t){.machine = &k,
                        .order = SERIES_ORDER,
                        .p = {{(tf_real_t)-sign * k.cos_gamma}},
                        .q = {{(tf_real_t)sign * k.sin_gamma}},
                        .r = {{about + uniform(-0.1, 0.1), uniform(-0.5, 0.5),
                               uniform(-0.5, 0.5), uniform(-0.5, 0.5)}}};
    const segment_t segment = {.kind = SEGMENT_STICK,
                               .sign_g = sign < 0 ? MINUS : PLUS};
    tf_real_t time = -1;
    const event_t event = tf_next_event(&motion, &segment, 1, &time);
    const real A = delassus_after(&paper, &motion, 0, sign);
    const bool ends = event == EVENT_TWO_FOLD;
    CHECK(ends || (event == EVENT_NONE && time == 1));
    if (ends)
      CHECK_NEAR(delassus_after(&paper, &motion, wide(time), sign), 0,
                 64 * EPSILON);
    for (int i = 0; i < 200; i++) {
      const real t = wide(time) * i / 200;
      CHECK((delassus_after(&paper, &motion, t, sign) < 0) == (A < 0));
    }
    vanishes += ends;
    stays += !ends;
  }
  CHECK_ABOVE(vanishes, 100);
  CHECK_ABOVE(stays, 100);
}
