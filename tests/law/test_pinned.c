/* A wheel that is pinned to the turntable, h = g = 0, while that speeds up: the
 * force and the moment that keep it there are what the paper's equations ask
 * for, and it stays as long as the law has them, whichever of its two limits
 * they reach first and on whichever side. */
#include "sample.h"

/* F and M under which r rests and w follows the turntable. */
static ref_force_t hold(const tf_params_t *p, const tf_input_t *u,
                        tf_real_t r) {
  const ref_machine_t q = reference_of(p, u);
  const ref_affine_t at =
      ref_affine(&q, (ref_state_t){.r = wide(r), .piece = 1});
  return ref_rest_force(&at);
}

static real margin(const ref_machine_t *law, ref_force_t by) {
  return ref_rest_margin(law, by, REF_HEXAGON);
}

TEST(pinned_wheel_stays_as_long_as_the_law_has_its_force) {
  int left[2][2] = {{0, 0}, {0, 0}}, steps = 0;
  for (int i = 0; i < samples(80000); i++) {
    tf_params_t q = random_params();
    q.dt = TF_R(0.05);
    q.tolerance = TF_R(1e-6);
    const paper_t p = paper_of(&q);
    const ref_machine_t law = {.mu = p.mu, .kappa = p.kappa};
    const tf_machine_t k = prepared(&q);
    tf_input_t u = tf_input_default(&k);
    tf_state_t x = {.r = uniform(-0.5, 0.5), .w = u.omega0, .mode = TF_PINNED};
    tf_report_t report;
    u.force = i % 2 ? uniform(-1, 1) : 0;
    u.torque = i % 2 ? uniform(-1, 1) : 0;
    u.alpha = uniform(-3, 3);
    const real size = 3 + p.mu + p.k2 + p.m * (4 + p.omega0 * p.omega0);
    const real slack = 1e4L * EPSILON * size * (1 + fabsl(1 / sinl(p.gamma)));
    ref_force_t by = hold(&q, &u, x.r);
    for (int n = 0; n < 40 && margin(&law, by) > slack; n++) {
      const ref_force_t before = by;
      const tf_real_t start = x.r;
      u.omega0 += u.alpha * k.dt / 2;
      const ref_force_t midway = hold(&q, &u, x.r);
      u.omega0 += u.alpha * k.dt / 2;
      by = hold(&q, &u, x.r);
      const tf_status_t status = tf_step_located(&k, &x, &u, &report);
      const bool rests = x.mode == TF_PINNED && x.r == start;
      if (status == TF_OK && rests) CHECK(margin(&law, by) >= -slack);
      if (rests && fminl(margin(&law, midway), margin(&law, by)) > slack) {
        steps++;
        CHECK(status == TF_OK);
        CHECK_NEAR(wide(report.force.F), by.F, slack);
        CHECK_NEAR(wide(report.force.M), by.M, slack);
        continue;
      }
      /* Left for a stick, that may be before: it attracts. */
      if (n == 0 || !tf_mode_is_slip(x.mode) || margin(&law, by) > 0) break;
      left[before.F > 0][p.kappa * p.mu - fabsl(by.M) > 0]++;
      break;
    }
  }
  CHECK_ABOVE(steps, samples(1000));
  for (int i = 0; i < 2; i++) {
    CHECK_ABOVE(left[i][0], 0);
    CHECK_ABOVE(left[i][1], samples(20));
  }
}

/* A motion that comes to h = g = 0 within a step, and would rest there, is in
 * the slip of its rule at the end of that step, where it is consistent. */
TEST(rest_ends_where_it_begins_under_a_rule_for_slips) {
  long ends = 0;
  for (int i = 0; i < samples(40000); i++) {
    tf_params_t q = random_params();
    q.dt = log_uniform(1e-5, 1e-3);
    tf_machine_t k = prepared(&q);
    const tf_input_t u = tf_input_default(&k);
    tf_state_t x = {.r = uniform(-0.5, 0.5), .mode = TF_NO_MODE};
    const double speed = (double)(q.mu * q.dt / q.m);
    x.w = u.omega0 + uniform(-10, 10) * (tf_real_t)speed;
    CHECK(tf_speed_for_slip(&k, x.r, x.w, u.omega0, 0, &x.v) == TF_OK);
    tf_report_t report;
    CHECK(tf_begin(&k, &x, &u, &report) == TF_OK);
    const tf_state_t from = x;
    if (tf_step(&k, &x, &u, &report) != TF_OK || x.mode != TF_PINNED) continue;
    for (unsigned slip = TF_SLIP_PLUS; slip <= TF_SLIP_MINUS; slip++) {
      if (!(report.set >> slip & 1u)) continue;
      x = from;
      k.contact.rule =
          slip == TF_SLIP_PLUS ? TF_RULE_SLIP_PLUS : TF_RULE_SLIP_MINUS;
      tf_report_t by_rule;
      CHECK(tf_step(&k, &x, &u, &by_rule) >= TF_OK);
      CHECK(x.mode == slip || by_rule.status != TF_OK);
      ends += x.mode == slip && by_rule.status == TF_OK;
    }
  }
  CHECK_ABOVE(ends, samples(100));
}

/* The turntable's acceleration changes one step after a rest has ended in a
 * stick, when g is no larger than what a step changes. That stick may no longer
 * be a mode: it ends in a slip, and does not pass g = 0. Returns: whether a
 * step that is TF_OK ends in another mode than the located one, far from it. */
static bool parts_behind_rest(long *ends) {
  tf_params_t q = random_params();
  q.dt = log_uniform(1e-6, 1e-3);
  const tf_machine_t k = prepared(&q);
  tf_input_t u = tf_input_default(&k);
  u.force = uniform(-1, 1) * q.mu;
  u.torque = uniform(-1, 1) * q.mu * q.kappa;
  tf_state_t x = {.r = uniform(-0.5, 0.5), .w = u.omega0, .mode = TF_PINNED};
  tf_report_t before, report, located;
  u.alpha = uniform(-3, 3);
  u.omega0 += u.alpha * k.dt;
  if (tf_step(&k, &x, &u, &before) != TF_OK || x.mode == TF_PINNED ||
      tf_mode_is_slip(x.mode))
    return false;
  u.alpha = uniform(-3, 3);
  u.omega0 += u.alpha * k.dt;
  tf_state_t exact = x;
  if (tf_step(&k, &x, &u, &report) != TF_OK || x.mode == TF_PINNED ||
      tf_step_located(&k, &exact, &u, &located) != TF_OK)
    return false;
  ++*ends;
  const tf_slip_t a = report.slip, b = located.slip;
  const real size = fabsl(wide(before.slip.g)) + hypotl(wide(b.h), wide(b.g));
  return x.mode != exact.mode &&
         hypotl(wide(a.h) - wide(b.h), wide(a.g) - wide(b.g)) > 0.25L * size;
}

TEST(inputs_that_change_behind_a_rest_are_followed) {
  if (!IS_DOUBLE) SKIP("slips of one step are lost in the rounding of r");
  long ends = 0, part = 0;
  for (int i = 0; i < samples(200000); i++) part += parts_behind_rest(&ends);
  printf("# %ld steps, %ld part\n", ends, part);
  CHECK_ABOVE(ends, samples(1000));
  CHECK(part == 0);
}
