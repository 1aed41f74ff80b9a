/* Regions of h = 0 and the field along it, against the paper in long double
 * and its rescaled time, at random points of random machines. */
#include "sample.h"

/* A machine, a point of its surface and what the core sees there. */
typedef struct {
  tf_params_t params;
  tf_machine_t machine;
  tf_input_t input;
  paper_t paper;
  real x[3], clock;
  int s;
  real bulk; /* sum of the magnitudes that h' is made of [m/s^2] */
  tf_surface_t at;
} look_t;

/* Rounding of h' is so many EPSILON of the sum of its parts. */
static real bulk_of(const look_t *c) {
  const paper_t *p = &c->paper;
  const real r = fabsl(c->x[0]), v = fabsl(c->x[1]), w = fabsl(c->x[2]);
  const real z = w + fabsl(p->omega0), d = fabsl(p->d);
  const real Q_r = p->k2 * (fabsl(p->r0) + r) + p->c2 * v + p->m * r * w * w +
                   p->mu + fabsl(wide(c->input.force));
  const real Q_phi = p->c1 * w + 2 * p->m * r * v * w +
                     p->mu * (r + d + p->kappa) + fabsl(wide(c->input.torque));
  const real z_rate =
      (Q_phi + d * Q_r) / c->clock + fabsl(wide(c->input.alpha));
  return Q_r / p->m + (d + r) * z_rate + (v + d * z) * z;
}

static look_t random_look(void) {
  look_t c;
  memset(&c, 0, sizeof c);
  c.params = random_params();
  c.params.k2 = tf_scenes[0]->params.k2;
  c.machine = prepared(&c.params);
  c.paper = paper_of(&c.params);
  c.input = tf_input_default(&c.machine);
  tf_real_t r = uniform(-0.5, 0.5), w = uniform(-3, 3), v = 0;
  CHECK(tf_speed_for_slip(&c.machine, r, w, c.input.omega0, 0, &v) == TF_OK);
  c.x[0] = wide(r);
  c.x[1] = wide(v);
  c.x[2] = wide(w);
  c.clock = c.paper.m * (c.paper.beta * c.paper.beta + c.x[0] * c.x[0]);
  CHECK(tf_surface_at(&c.machine, &c.input, r, v, w, &c.at) == TF_OK);
  c.s = paper_g(&c.paper, c.x) > 0 ? 1 : -1;
  c.bulk = bulk_of(&c);
  return c;
}

static void near_rate(const tf_rate_t *got, const real want[3], real scale,
                      real tolerance) {
  CHECK_NEAR(wide(got->r), want[0] * scale, tolerance);
  CHECK_NEAR(wide(got->v), want[1] * scale, tolerance);
  CHECK_NEAR(wide(got->w), want[2] * scale, tolerance);
}

/* And the region that they make of a point. */
TEST(lie_derivatives_against_the_paper) {
  int count[TF_REGIONS] = {0};
  for (int i = 0; i < samples(20000); i++) {
    const look_t c = random_look();
    const real mu = c.paper.mu, close = 32 * EPSILON * c.bulk;
    const real plus = paper_lie(&c.paper, c.x, mu, c.s) / c.clock;
    const real minus = paper_lie(&c.paper, c.x, -mu, c.s) / c.clock;
    const tf_region_t region =
        plus > 0 ? (minus > 0 ? TF_REGION_UP : TF_REGION_ESCAPING)
                 : (minus > 0 ? TF_REGION_SLIDING : TF_REGION_DOWN);
    CHECK_NEAR(wide(c.at.lie_plus), plus, close);
    CHECK_NEAR(wide(c.at.lie_minus), minus, close);
    if (fabsl(plus) > close && fabsl(minus) > close)
      CHECK(c.at.region == region);
    count[c.at.region]++;
    CHECK_NEAR(wide(c.at.delassus), paper_delassus(&c.paper, c.x[0], c.s),
               close);
    CHECK(fabsl(wide(c.at.slip.h)) <= 8 * EPSILON * c.bulk);
    /* An accelerating turntable moves the surface, not the machine. */
    tf_input_t driven = c.input;
    tf_surface_t at;
    driven.alpha = uniform(-2, 2);
    CHECK(tf_surface_at(&c.machine, &driven, (tf_real_t)c.x[0],
                        (tf_real_t)c.x[1], (tf_real_t)c.x[2], &at) == TF_OK);
    const real moved = wide(driven.alpha) * (c.x[0] * cosl(c.paper.gamma) -
                                             c.paper.d * sinl(c.paper.gamma));
    CHECK_NEAR(wide(at.lie_plus) - wide(c.at.lie_plus), moved,
               64 * EPSILON * (c.bulk + 5));
    CHECK_NEAR(wide(at.plus.w), wide(c.at.plus.w),
               64 * EPSILON * (1 + c.bulk) / c.clock);
  }
  for (int i = 0; i <= TF_REGION_DOWN; i++) CHECK(count[i] > samples(100));
}

/* (slidRescale) as printed is h_x.f_lambda times (svf), and h_x.f_lambda < 0 in
 * a sliding region: it leads backwards there, not forwards as the text says.
 * `scaled` has the opposite sign. */
TEST(sliding_field_against_the_paper) {
  int seen = 0;
  for (int i = 0; i < samples(20000); i++) {
    const look_t c = random_look();
    const real mu = c.paper.mu, A = fabsl(wide(c.at.delassus));
    real f[3];
    paper_f(&c.paper, c.x, mu, c.s, f);
    near_rate(&c.at.plus, f, 1 / c.clock,
              64 * EPSILON * (c.bulk + 1) / c.clock);
    paper_f(&c.paper, c.x, -mu, c.s, f);
    near_rate(&c.at.minus, f, 1 / c.clock,
              64 * EPSILON * (c.bulk + 1) / c.clock);
    real f0[3];
    paper_f(&c.paper, c.x, 0, c.s, f0);
    paper_f(&c.paper, c.x, 1, c.s, f);
    const real N = paper_lie(&c.paper, c.x, 0, c.s);
    const real L = paper_lie(&c.paper, c.x, 1, c.s) - N;
    for (int j = 0; j < 3; j++) f[j] = L * f0[j] - N * (f[j] - f0[j]);
    near_rate(&c.at.scaled, f, -1 / (c.clock * c.clock),
              64 * EPSILON * (c.bulk + 1) * (c.bulk + 1) / c.clock);
    if (c.at.region > TF_REGION_ESCAPING) {
      CHECK(c.at.stick.r == 0 && c.at.stick.v == 0 && c.at.stick.w == 0);
      continue;
    }
    /* lambda = N / A carries what N and A lose of their digits. */
    const real lost = 64 * EPSILON * (c.bulk + 1) * (1 + mu / A);
    if (lost / A > 0.01L) continue;
    CHECK(c.at.lambda_is_given);
    CHECK_NEAR(wide(c.at.lambda), paper_lambda(&c.paper, c.x, c.s), lost / A);
    paper_stick(&c.paper, c.x, c.s, f);
    near_rate(&c.at.stick, f, 1, lost * (1 + 1 / A) * 4 / c.clock);
    seen++;
  }
  CHECK(seen > samples(2000));
}

/* In equilibrium without friction h' = 0 on both sides: neither side leaves
 * h = 0, so that it is not a crossing. */
TEST(equilibrium_without_friction_is_no_crossing) {
  tf_params_t p = random_params();
  p.law = TF_TYRE_COULOMB;
  p.mu = p.omega0 = 0;
  p.r0 = TF_R(0.25);
  const tf_machine_t machine = prepared(&p);
  const tf_input_t input = tf_input_default(&machine);
  tf_surface_t at;
  CHECK(tf_surface_at(&machine, &input, p.r0, 0, 0, &at) == TF_OK);
  CHECK(at.lie_plus == 0 && at.lie_minus == 0);
  CHECK(at.region == TF_REGION_SLIDING);
  tf_state_t x = {.r = p.r0, .mode = TF_NO_MODE};
  tf_report_t report;
  CHECK(tf_begin(&machine, &x, &input, &report) == TF_OK);
  CHECK(report.choices == 1 && !tf_mode_is_slip(report.mode));
}

TEST(surface_refuses_other_laws_and_bad_states) {
  tf_machine_t machine;
  tf_params_t params = tf_scenes[0]->params;
  tf_surface_t at;
  machine = prepared(&params);
  tf_input_t input = tf_input_default(&machine);
  /* w = omega0 on the surface: h = g = 0 */
  CHECK(tf_surface_at(&machine, &input, TF_R(0.2), 0, -1, &at) == TF_OK);
  CHECK(at.region == TF_REGION_CODIM2 && !at.lambda_is_given);
  CHECK(at.lie_plus == 0 && at.plus.w == 0 && at.delassus == 0);
  memset(&at, 77, sizeof at);
  const tf_surface_t before = at;
  const tf_real_t nan = (tf_real_t)NAN, big = 2 * TF_STATE_LIMIT;
  CHECK(tf_surface_at(&machine, &input, nan, 0, 0, &at) == TF_BAD_STATE);
  CHECK(tf_surface_at(&machine, &input, 0, big, 0, &at) == TF_BAD_STATE);
  input.force = nan;
  CHECK(tf_surface_at(&machine, &input, 0, 0, 0, &at) == TF_BAD_STATE);
  input = tf_input_default(&machine);
  params.law = TF_TYRE_NONE;
  machine = prepared(&params);
  CHECK(tf_surface_at(&machine, &input, 0, 0, 0, &at) == TF_BAD_PARAMETER);
  CHECK(!memcmp(&at, &before, sizeof at));
  /* The heaviest spring, stretched to the limit, on the lightest slider. */
  params = tf_scenes[0]->params;
  params.m = TF_R(1e-12);
  params.k2 = TF_R(1e15);
  params.beta = TF_R(1e-9);
  params.d = TF_R(1e6);
  machine = prepared(&params);
  const tf_status_t status =
      tf_surface_at(&machine, &input, TF_R(1e-9), TF_R(9e8), 0, &at);
  CHECK(status == (sizeof(tf_real_t) == 4 ? TF_BAD_STATE : TF_OK));
  /* Without a moment F is the same on both sides of g = 0: a point of h = 0
   * like any other. */
  params = tf_scenes[0]->params;
  params.law = TF_TYRE_COULOMB;
  machine = prepared(&params);
  CHECK(tf_surface_at(&machine, &input, TF_R(0.2), 0, -1, &at) == TF_OK);
  CHECK(at.region == TF_REGION_SLIDING && at.delassus > 0);
}
