/* Laws of a machine whose turntable speeds up or slows down: each state goes
 * with the speed of the turntable at its own instant. With that of another one
 * the motion is off by its acceleration times the step, which makes a smooth
 * motion one of first order, and at h = g = 0, where all else is as small,
 * another motion. */
#include "../../src/moreau/scheme.h"
#include "same_state.h"
#include "sim.h"

static const double duration = 0.25;

static motion_t any_motion(tf_tyre_law_t law) {
  motion_t m = {.params = wide_params()};
  tf_params_t *p = &m.params;
  p->law = law;
  p->theta = TF_R(0.5);
  p->beta = uniform(0.2, 1);
  p->k2 = uniform(0, 1); /* no period of it is balanced, see grows() */
  p->c2 = 0;
  p->mu = uniform(0.1, 1);
  draw_law_constants(p);
  m.r = tap_uniform(0.3, 1);
  m.v = tap_uniform(-1, 1);
  m.w = (double)p->omega0 + tap_uniform(-2, 2);
  m.alpha = tap_uniform(-4, 4);
  m.force = tap_uniform(-1, 1);
  m.torque = tap_uniform(-1, 1);
  return m;
}

/* The true end of a motion that keeps its mode; false where it does not. */
static bool true_end(const motion_t *m, ref_mode_t mode, tf_state_t *end) {
  const tf_input_t u = sim_under(m, duration).u;
  const ref_machine_t q = reference_of(&m->params, &u);
  ref_orbit_t orbit = {.tolerance = 1e-13L};
  ref_state_t x = ref_state(&q, m->r, m->v, m->w);
  if (mode > REF_SLIP_MINUS) x = ref_on_surface(&q, x);
  ref_begin(&orbit, &q, x, mode);
  const ref_slip_t from = ref_slip(&q, x);
  if (ref_run(&orbit, duration) != REF_REACHED || orbit.events > 0 ||
      orbit.mode != mode)
    return false;
  if (from.g * ref_slip(&q, orbit.x).g < 0) /* a kink of the force of slip */
    return false;
  *end = (tf_state_t){.r = (tf_real_t)orbit.x.r,
                      .v = (tf_real_t)ref_v(&q, orbit.x),
                      .w = (tf_real_t)ref_w(&q, orbit.x)};
  return true;
}

/* One step, however it is taken. */
typedef tf_status_t (*taken_t)(sim_t *s);

static tf_status_t plain(sim_t *s) { return sim_step(s, MOREAU); }
static tf_status_t compensated(sim_t *s) { return sim_step(s, COMPENSATED); }

/* A block of equal lanes, each with the bits of tf_step. */
static tf_status_t in_lanes(sim_t *s) {
  tf_state_block_t block;
  tf_report_block_t reports;
  memset(&block, 0, sizeof block);
  memset(&reports, 0, sizeof reports);
  for (size_t i = 0; i < TF_LANES; i++) tf_ensemble_put(&block, i, &s->x);
  tf_ensemble_step(&s->k, &block, TF_LANES, &s->u, &reports);
  const tf_status_t status = plain(s);
  const tf_state_t x = tf_ensemble_get(&block, TF_LANES - 1);
  CHECK(same_state(&x, &s->x));
  return status;
}

/* The form that creates no energy, under the force of the plain step. */
static tf_status_t balanced(sim_t *s) {
  tf_state_t x = s->x;
  const tf_status_t status = tf_step(&s->k, &x, &s->u, &s->report);
  const balanced_end_t end =
      tf_balanced_end(&s->k, &s->x, &s->u, x.mode, s->report.force);
  s->x.r = end.at.r;
  s->x.v = end.at.v;
  s->x.w = end.at.w;
  s->x.mode = x.mode;
  return status;
}

static tf_status_t turn(sim_t *s, const motion_t *m, taken_t taken) {
  sim_turn(s, m);
  const uint64_t tick = s->x.tick;
  const tf_status_t status = taken(s);
  s->x.tick = tick + 1;
  return status;
}

/* Runs n steps; false where one is not TF_OK or changes the mode. */
static bool keeps_mode(sim_t *s, const motion_t *m, int n, taken_t taken) {
  const unsigned mode = s->x.mode;
  for (int i = 0; i < n; i++)
    if (turn(s, m, taken) != TF_OK || s->x.mode != mode) return false;
  return true;
}

/* How the mean error over some motions falls in two halvings of the step. */
static void has_order(int order, const char *name, taken_t taken,
                      tf_tyre_law_t law, bool sticks) {
  const double low = 0.75 * (1 << order), high = 1.25 * (1 << order);
  double sum[3] = {0, 0, 0};
  int judged = 0;
  for (int i = 0; judged < 20 && i < 20000; i++) {
    motion_t m = any_motion(law);
    m.params.theta = 1 / (tf_real_t)order;
    if (sticks) {
      const sim_t s = sim_of(&m.params);
      tf_real_t v;
      if (tf_speed_for_slip(&s.k, (tf_real_t)m.r, (tf_real_t)m.w, s.u.omega0, 0,
                            &v) != TF_OK)
        continue;
      m.v = (double)v;
    }
    sim_t run[3];
    int kept = 0;
    for (; kept < 3; kept++) {
      const int n = (IS_DOUBLE ? 50 : 12) << kept;
      run[kept] = sim_under(&m, duration / n);
      if ((run[kept].x.mode > TF_SLIP_MINUS) != sticks ||
          !keeps_mode(&run[kept], &m, n, taken))
        break;
    }
    tf_state_t want;
    if (kept < 3 || !true_end(&m, (ref_mode_t)run[0].x.mode, &want)) continue;
    for (int j = 0; j < 3; j++) sum[j] += sim_apart(&run[j].x, &want);
    judged++;
  }
  printf("# %-24s %.2e, %.2e, %.2e: order %.2f\n", name, sum[0] / judged,
         sum[1] / judged, sum[2] / judged, log(sum[0] / sum[2]) / log(4));
  CHECK(judged == 20);
  CHECK(sum[0] > low * sum[1] && sum[0] < high * sum[1]);
  CHECK(!IS_DOUBLE || (sum[1] > low * sum[2] && sum[1] < high * sum[2]));
}

TEST(order_two_in_slip_on_a_ramp) {
  has_order(2, "slip", plain, TF_TYRE_JUMP, false);
  has_order(2, "slip, compensated", compensated, TF_TYRE_JUMP, false);
  has_order(2, "slip, lanes", in_lanes, TF_TYRE_JUMP, false);
  has_order(2, "slip, balanced", balanced, TF_TYRE_JUMP, false);
  has_order(2, "slip without moment", plain, TF_TYRE_COULOMB, false);
  has_order(2, "smooth law", plain, TF_TYRE_SMOOTH, false);
  has_order(2, "string", plain, TF_TYRE_STRING, false);
}

TEST(order_two_in_stick_on_a_ramp) {
  has_order(2, "stick", plain, TF_TYRE_JUMP, true);
  has_order(2, "stick, compensated", compensated, TF_TYRE_JUMP, true);
  has_order(2, "stick, lanes", in_lanes, TF_TYRE_JUMP, true);
}

TEST(theta_one_is_of_order_one_on_a_ramp) {
  has_order(1, "slip, theta 1", plain, TF_TYRE_JUMP, false);
  has_order(1, "stick, theta 1", plain, TF_TYRE_JUMP, true);
  has_order(1, "slip, theta 1, in pairs", compensated, TF_TYRE_JUMP, false);
  has_order(1, "slip, theta 1, in lanes", in_lanes, TF_TYRE_JUMP, false);
  has_order(1, "slip, theta 1, balanced", balanced, TF_TYRE_JUMP, false);
}

/* A pinned wheel goes with the turntable, under the force that accelerates it:
 * the energy that it gains is what the turntable has worked. */
TEST(pinned_wheel_takes_its_energy_from_the_turntable) {
  int rested = 0;
  for (int i = 0; i < samples(4000); i++) {
    motion_t m = any_motion(TF_TYRE_JUMP);
    m.params.c1 = m.params.c2 = 0;
    m.params.mu = uniform(3, 10);
    m.v = m.force = m.torque = 0;
    m.w = (double)m.params.omega0;
    const int n = 50;
    const bool pairs = i % 2;
    sim_t s = sim_under(&m, duration / n);
    const real d = wide(s.k.d), dt = wide(s.k.dt);
    const real first = wide(tf_energy(&s.k, &s.x, s.u.r0));
    const tf_real_t start = s.x.r;
    real work = 0, size = first;
    bool rests = s.x.mode == TF_PINNED;
    for (int j = 0; j < n && rests; j++) {
      const real before = wide(s.x.w);
      CHECK(turn(&s, &m, pairs ? compensated : plain) >= TF_OK);
      rests = s.x.mode == TF_PINNED;
      if (!rests) break;
      CHECK(s.x.v == 0 && s.x.w == s.u.omega0 && s.x.r == start);
      CHECK(s.report.slip.h == 0 && s.report.slip.g == 0);
      const real F = wide(s.report.force.F), M = wide(s.report.force.M);
      const real arm = wide(s.x.r) * cosl(wide(s.params.gamma)) -
                       d * sinl(wide(s.params.gamma));
      work += dt * (before + wide(s.x.w)) / 2 * (F * arm + M);
      size += dt * (fabsl(before) + fabsl(wide(s.x.w))) *
              (fabsl(F * arm) + fabsl(M));
    }
    if (!rests) continue;
    const real gained = wide(tf_energy(&s.k, &s.x, s.u.r0)) - first;
    CHECK_NEAR(gained, work, 1e3L * EPSILON * (size + 1));
    rested++;
  }
  CHECK_ABOVE(rested, samples(300));
}

/* What friction puts into a slip on a ramp is what (17) says of the slip at the
 * theta point, F h_t, and of the turntable there: its own speed times the
 * moment that it needs. */
TEST(friction_of_a_step_works_against_the_turntable_of_the_theta_point) {
  for (int i = 0; i < samples(4000); i++) {
    motion_t m = any_motion(TF_TYRE_JUMP);
    m.params.theta = uniform(0.5, 1);
    sim_t s = sim_under(&m, duration / 100);
    s.u.omega0 += s.u.alpha * s.k.dt;
    const end_state_t from = {s.x.r, s.x.v, s.x.w};
    if (sim_step(&s, MOREAU) != TF_OK) continue;
    const end_state_t to = {s.x.r, s.x.v, s.x.w};
    const tf_force_t f = s.report.force;
    const balance_t b =
        balance_of(&s.k, is_midpoint(&s.k), &s.u, from, to, f.F);
    paper_t p = paper_of(&s.params);
    const real dt = wide(s.k.dt), theta = wide(s.params.theta);
    p.omega0 = wide(s.u.omega0) - (1 - theta) * dt * wide(s.u.alpha);
    const real v = wide(from.v) + theta * (wide(to.v) - wide(from.v));
    const real w = wide(from.w) + theta * (wide(to.w) - wide(from.w));
    const real r = wide(from.r) + theta * dt * wide(from.v);
    const real under = wide(from.r) + theta * dt * v; /* turntable's radius */
    const real x[3] = {r, v, w};
    const real h = paper_h(&p, x) +
                   (under - r) * p.omega0 * cosl(p.gamma); /* see balance.h */
    CHECK_NEAR(
        wide(b.friction), -dt * wide(f.F) * h,
        64 * EPSILON * dt * fabsl(wide(f.F)) *
            (fabsl(v) + (fabsl(p.d) + fabsl(r)) * (fabsl(w) + fabsl(p.omega0)) +
             1));
  }
}
