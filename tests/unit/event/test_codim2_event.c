/* Steps that reach h = g = 0 or leave it, most of them located, against the
 * field of slip by the paper's law. */
#include "codim2_field.h"
#include "event/segment.h"
#include "friction/codim2.h"
#include "sim.h"

/* Next to a limit direction the angle d off it changes with d' = c d / R, and R
 * with R' = v: d goes with t^(c/v). */
TEST(exponent_of_a_limit_direction) {
  int seen = 0;
  for (int n = 0; n < 2000; n++) {
    const tf_params_t params = any_params(n);
    const tf_machine_t k = prepared(&params);
    const tf_input_t u = tf_input_default(&k);
    const tf_real_t r = uniform(-0.6, 0.6);
    const field_t at = field_at(&params, &u, r);
    const rates_t rates = rates_at(&k, &u, r, 0, 0, u.omega0);
    const codim2_field_t field = tf_codim2_field_of(&k, &rates);
    segment_t segment = {.contact = CONTACT_CODIM2_SLIP,
                         .sign_h = n & 1 ? 1 : -1,
                         .sign_g = n & 2 ? 1 : -1,
                         .h_zero_order = 1,
                         .g_starts_at_zero = true};
    if (!tf_codim2_attractor(&k, &field, segment.sign_g, segment.sign_h,
                             &segment.T))
      continue;
    static taylor_t motion;
    begin_taylor(&motion, &k, &u, u.omega0, (phase_point_t){r, 0, 0});
    CHECK(tf_taylor_coefficients(&motion, &segment, 0));
    const real angle = angle_of(&at, wide(segment.T), segment.sign_g);
    const real off = 1e-5L;
    const real v = slip_rate_at(&at, segment.sign_h, angle).growth;
    const real c = (slip_rate_at(&at, segment.sign_h, angle + off).rotation -
                    slip_rate_at(&at, segment.sign_h, angle - off).rotation) /
                   (2 * off);
    if (fabsl(v) < 0.1L || fabsl(angle) < 1e-2L ||
        PAPER_PI / 2 - fabsl(angle) < 1e-2L)
      continue;
    CHECK_NEAR(wide(motion.exponent), c / v,
               (1e-3L + 1e4L * EPSILON) * (1 + fabsl(c / v)));
    seen++;
  }
  CHECK(seen > 200);
}

/* How fast g grows in the stick on one side of g = 0. */
static real stick_growth(const field_t *at, int roll) {
  const real moment = (real)roll * at->paper.kappa;
  const real lambda = -at->h[0] / (at->h[1] + moment * at->h[2]);
  return (real)roll * (at->g[0] + lambda * (at->g[1] + moment * at->g[2]));
}

static unsigned faster_stick(const field_t *at) {
  return stick_growth(at, -1) > stick_growth(at, 1) ? TF_STICK_MINUS
                                                    : TF_STICK_PLUS;
}

/* Where both sticks leave h = g = 0 the faster one is taken, whatever the sign
 * of the rounding that g has. */
TEST(of_two_sticks_the_faster_is_taken) {
  int taken[2] = {0};
  for (int n = 0; n < 20000; n++) {
    tf_params_t params = any_params(n);
    params.dt = TF_R(1e-6);
    const tf_machine_t k = prepared(&params);
    const tf_input_t u = tf_input_default(&k);
    const tf_real_t r = uniform(-0.6, 0.6);
    const field_t at = field_at(&params, &u, r);
    const rates_t rates = rates_at(&k, &u, r, 0, 0, u.omega0);
    const codim2_field_t field = tf_codim2_field_of(&k, &rates);
    consistent_modes_t out;
    tf_report_t report;
    tf_codim2_modes(&k, &field, &out);
    if ((out.solutions.set & out.solutions.attracting & STICKS) != STICKS)
      continue;
    tf_state_t x = {
        .r = r, .v = TF_REAL_EPSILON * uniform(-1e-4, 1e-4), .w = u.omega0};
    const tf_slip_t slip = tf_slip(&k, x.r, x.v, x.w, u.omega0);
    x.mode = slip.h > 0 ? TF_SLIP_MINUS : TF_SLIP_PLUS; /* to be ignored */
    const tf_status_t status = tf_step_located(&k, &x, &u, &report);
    if (!ok_to_resolution(status) || x.mode == TF_PINNED) continue;
    CHECK(x.mode == faster_stick(&at));
    taken[x.mode == TF_STICK_MINUS]++;
  }
  printf("# stick+ %d times, stick- %d times\n", taken[0], taken[1]);
  CHECK(taken[0] > 20 && taken[1] > 20);
}

/* Slip at r along a limit direction, so far from h = g = 0 that it gets there
 * in half of a step. */
static tf_state_t towards_codim2(const tf_machine_t *k, const field_t *at,
                                 tf_real_t r, int side, real angle) {
  const real size = -slip_rate_at(at, side, angle).growth * wide(k->dt) / 2;
  const real h = (real)side * size * cosl(angle), g = size * sinl(angle);
  const real sine = wide(k->sin_gamma), cosine = wide(k->cos_gamma);
  const real p = -h * sine - g * cosine;
  const real z = (-h * cosine + g * sine) / wide(r);
  return (tf_state_t){.r = r,
                      .v = (tf_real_t)(p + wide(k->d) * z),
                      .w = (tf_real_t)(wide(k->omega0) + z),
                      .mode = side > 0 ? TF_SLIP_PLUS : TF_SLIP_MINUS};
}

/* Of a hundred thousand machines one has slip that enters h = g = 0 where both
 * sticks are consistent. These were found by a search; here are the states of
 * its random numbers and the numbers of its trials. */
static const struct {
  uint64_t state;
  int number;
} entering[] = {{0x1FE57EE383B36A5Fu, 425723},  {0xC2C46BB8AAAD81D3u, 480175},
                {0xD6094B6137C44102u, 920444},  {0x127AF1DBA0FB2337u, 1009248},
                {0x90CCD0534BC0CB27u, 1120001}, {0x49ADF234423353A7u, 1240183},
                {0x94962056FB6932C3u, 1324836}, {0xFB2358F26EBD33D8u, 1340666},
                {0x74EAFA833BA81F7Cu, 1412796}, {0xBF7DA5D5D1FA19E3u, 1575484},
                {0xF1851A8B7464E6AEu, 1639772}, {0x5B99376778692633u, 1772206},
                {0xD64B0F408713C91Du, 1900579}};

TEST(slip_enters_the_faster_stick) {
  int taken[2] = {0};
  for (size_t n = 0; n < sizeof entering / sizeof *entering; n++) {
    tap.state = entering[n].state;
    tf_params_t params = any_params(entering[n].number);
    params.dt = TF_R(1e-2);
    const tf_machine_t k = prepared(&params);
    const tf_input_t u = tf_input_default(&k);
    const tf_real_t r = uniform(-0.6, 0.6);
    const rates_t rates = rates_at(&k, &u, r, 0, 0, u.omega0);
    const codim2_field_t field = tf_codim2_field_of(&k, &rates);
    const field_t at = field_at(&params, &u, r);
    for (int way = 0; way < 4; way++) {
      const int side = way & 1 ? -1 : 1, roll = way & 2 ? -1 : 1;
      tf_real_t T;
      if (!tf_codim2_attractor(&k, &field, roll, side, &T)) continue;
      const real angle = angle_of(&at, wide(T), roll);
      if (!(slip_rate_at(&at, side, angle).growth < 0)) continue;
      tf_state_t x = towards_codim2(&k, &at, r, side, angle);
      tf_report_t report;
      CHECK(tf_step_located(&k, &x, &u, &report) == TF_OK);
      if ((report.set & STICKS) != STICKS) continue;
      CHECK(x.mode == faster_stick(&at));
      taken[x.mode == TF_STICK_MINUS]++;
    }
  }
  printf("# stick+ %d times, stick- %d times\n", taken[0], taken[1]);
  CHECK(taken[0] + taken[1] > 6);
}

/* A wheel that is released at rest and finds both sticks consistent takes the
 * faster one as well. */
TEST(wheel_at_rest_leaves_by_the_faster_stick) {
  int taken = 0;
  for (int n = 0; n < 20000; n++) {
    tf_params_t params = any_params(n);
    params.dt = TF_R(1e-5);
    const tf_machine_t k = prepared(&params);
    const tf_input_t u = tf_input_default(&k);
    tf_state_t x = {.r = uniform(-0.6, 0.6), .w = u.omega0, .mode = TF_PINNED};
    const field_t at = field_at(&params, &u, x.r);
    const rates_t rates = rates_at(&k, &u, x.r, 0, 0, u.omega0);
    const codim2_field_t field = tf_codim2_field_of(&k, &rates);
    consistent_modes_t out;
    tf_codim2_modes(&k, &field, &out);
    if ((out.solutions.set & out.solutions.attracting & STICKS) != STICKS)
      continue;
    for (int located = 0; located < 2; located++) {
      tf_state_t y = x;
      tf_report_t report;
      const tf_status_t status = located ? tf_step_located(&k, &y, &u, &report)
                                         : tf_step(&k, &y, &u, &report);
      if (status == TF_OK && !tf_mode_is_slip(y.mode))
        CHECK(y.mode == faster_stick(&at));
    }
    taken++;
  }
  printf("# %d times\n", taken);
  CHECK(taken > 20);
}

/* Every law of rest and every rule, from h = g = 0 or a slip that falls into
 * it. Under the bow tie there may be no future: then tf_step takes over. */
TEST(located_steps_from_codimension_two_of_every_law_and_rule) {
  int by_status[5] = {0};
  for (int n = 0; n < 8000; n++) {
    tf_params_t params = any_params(n);
    params.rest = (tf_rest_law_t)(n % TF_REST_LAWS);
    params.rule = (tf_rule_t)(n / 4 % 4);
    params.rate = 1000;
    params.dt = TF_R(1e-3);
    const tf_machine_t k = prepared(&params);
    const tf_input_t u = tf_input_default(&k);
    tf_state_t x = {.r = uniform(-0.6, 0.6),
                    .w = u.omega0,
                    .seed = (uint32_t)n,
                    .mode = (uint8_t)(n / 3 % TF_MODES)};
    if (n % 2) {
      x.w += uniform(-1e-3, 1e-3);
      x.v = uniform(-1e-3, 1e-3);
    }
    for (int step = 0; step < 10; step++) {
      tf_report_t report;
      const tf_status_t status = tf_step_located(&k, &x, &u, &report);
      if (!CHECK(status >= TF_OK)) break;
      by_status[status]++;
      CHECK(report.mode == x.mode && x.mode < TF_MODES);
      if (status == TF_OK) CHECK(report.set & TF_MODE_BIT(x.mode));
    }
  }
  printf("# %d OK, %d degraded, %d fell back, %d coarse\n", by_status[TF_OK],
         by_status[TF_DEGRADED], by_status[TF_FELL_BACK], by_status[TF_COARSE]);
  CHECK(by_status[TF_OK] > 50000);
}

/* A machine at h = g = 0 whose stick is escaping and moves g by next to nothing
 * from there: loads hold it, but for a torque. */
static int draw_slow_escape(sim_t *s, int i, unsigned mode, real torque) {
  tf_params_t p = any_params(i);
  p.dt = log_uniform(1e-2, 0.3);
  *s = sim_of(&p);
  const real r = tap_uniform(-0.6, 0.6), w = wide(p.omega0);
  const real sine = wide(s->k.sin_gamma), cosine = wide(s->k.cos_gamma);
  const real F = tap_uniform(-0.9, 0.9) * wide(p.mu);
  const real kappa = (mode == TF_STICK_PLUS ? 1 : -1) * wide(p.kappa);
  const paper_t paper = paper_of(&p);
  s->x.r = (tf_real_t)r;
  s->x.w = p.omega0;
  s->x.mode = (uint8_t)mode;
  s->u.force = (tf_real_t)(-wide(p.k2) * (wide(p.r0) - r) -
                           wide(p.m) * r * w * w - F * sine);
  s->u.torque = (tf_real_t)(wide(p.c1) * w -
                            F * (r * cosine - wide(p.d) * sine) - kappa * F);
  s->u.torque += (tf_real_t)torque;
  return paper_delassus(&paper, r, mode == TF_STICK_PLUS ? 1 : -1) < 0;
}

/* A stick whose g has the wrong sign by rounding, and comes back, goes on as
 * one at g = 0 does, although a step changes g by little more than that. Of a
 * few machines the rounding of the loads decides. */
TEST(rounding_of_g_does_not_choose) {
  int steps = 0, apart = 0;
  for (int i = 0; i < samples(200000); i++) {
    const unsigned mode = i & 1 ? TF_STICK_MINUS : TF_STICK_PLUS;
    const real side = i & 1 ? -1 : 1;
    const real size = exp(tap_uniform(log(1e2), log(1e4))) * EPSILON;
    sim_t s;
    if (!draw_slow_escape(&s, i, mode, size * (i & 2 ? 1 : -1))) continue;
    sim_t at = s;
    s.x.w *= 1 + (tf_real_t)((int)(tap_bits() % 9) - 4) * TF_REAL_EPSILON;
    s.x.v = TF_REAL_EPSILON * uniform(-2, 2);
    const tf_slip_t slip = tf_slip(&s.k, s.x.r, s.x.v, s.x.w, s.u.omega0);
    /* The torque drives g to the side of the stick. */
    const bool returns =
        side * wide(s.x.r * s.k.sin_gamma) * (i & 2 ? 1 : -1) > 0;
    if (!(side * wide(slip.g) < 0) || !returns) continue;
    if (sim_step(&s, MOREAU) != TF_OK || sim_step(&at, MOREAU) != TF_OK)
      continue;
    steps++;
    apart += s.x.mode != at.x.mode;
  }
  printf("# %d of %d apart\n", apart, steps);
  CHECK(steps > samples(5000));
  CHECK(apart * 25 < steps);
}
