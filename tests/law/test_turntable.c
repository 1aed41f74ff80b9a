/* Laws of a machine whose turntable speeds up or slows down: each state goes
 * with the speed of the turntable at its own instant. With that of another one
 * the motion is off by its acceleration times the step, which makes a smooth
 * motion one of first order, and at h = g = 0, where all else is as small,
 * another motion. */
#include "../../src/moreau/rare_end.h"
#include "../reference/reference.h"
#include "same_state.h"
#include "sim.h"

/* A machine, how it starts, and what acts on it all the time. */
typedef struct {
  tf_params_t params;
  double r, v, w, alpha, force, torque;
} motion_t;

typedef struct {
  double r, v, w;
} end_t;

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
  p->epsilon = uniform(0.1, 0.5);
  p->k = uniform(1, 20);
  p->delta = uniform(1, 10);
  p->sigma = uniform(0, 1);
  p->rho = uniform(0.3, 1);
  p->a = uniform(0.1, 0.5);
  m.r = tap_uniform(0.3, 1);
  m.v = tap_uniform(-1, 1);
  m.w = (double)p->omega0 + tap_uniform(-2, 2);
  m.alpha = tap_uniform(-4, 4);
  m.force = tap_uniform(-1, 1);
  m.torque = tap_uniform(-1, 1);
  return m;
}

static ref_machine_t reference_of(const motion_t *m) {
  static const ref_law_t laws[TF_TYRE_LAWS] = {[TF_TYRE_JUMP] = REF_JUMP,
                                               [TF_TYRE_COULOMB] = REF_COULOMB,
                                               [TF_TYRE_SMOOTH] = REF_SMOOTH,
                                               [TF_TYRE_STRING] = REF_STRING,
                                               [TF_TYRE_NONE] = REF_FREE};
  const tf_params_t *p = &m->params;
  ref_machine_t q = {PARAMETERS_OF(ref_real_t, p),
                     .epsilon = p->epsilon,
                     .k = p->k,
                     .delta = p->delta,
                     .sigma = p->sigma,
                     .rho = p->rho,
                     .a = p->a,
                     .law = laws[p->law],
                     .knots = 2};
  for (int i = 0; i < 2; i++)
    q.knot[i] = (ref_knot_t){i, p->omega0 + i * m->alpha, m->force, m->torque};
  ref_prepare(&q);
  return q;
}

/* The true end of a motion that keeps its mode; false where it does not. */
static bool true_end(const motion_t *m, ref_mode_t mode, end_t *end) {
  const ref_machine_t q = reference_of(m);
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
  *end = (end_t){(double)orbit.x.r, (double)ref_v(&q, orbit.x),
                 (double)ref_w(&q, orbit.x)};
  return true;
}

static double apart(const sim_t *s, const end_t *want) {
  return fabs((double)s->x.r - want->r) + fabs((double)s->x.v - want->v) +
         fabs((double)s->x.w - want->w);
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

static sim_t begun(const motion_t *m, int n) {
  tf_params_t p = m->params;
  p.dt = (tf_real_t)(duration / n);
  sim_t s = sim_of(&p);
  s.u.alpha = (tf_real_t)m->alpha;
  s.u.force = (tf_real_t)m->force;
  s.u.torque = (tf_real_t)m->torque;
  s.x.r = (tf_real_t)m->r;
  s.x.v = (tf_real_t)m->v;
  s.x.w = (tf_real_t)m->w;
  CHECK(sim_begin(&s) == TF_OK);
  return s;
}

static tf_status_t turn(sim_t *s, const motion_t *m, taken_t taken) {
  s->u.omega0 = m->params.omega0 +
                (tf_real_t)(m->alpha * (double)(s->x.tick + 1)) * s->k.dt;
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
static void has_order_two(const char *name, taken_t taken, tf_tyre_law_t law,
                          bool sticks) {
  double sum[3] = {0, 0, 0};
  int judged = 0;
  for (int i = 0; judged < 20 && i < 20000; i++) {
    motion_t m = any_motion(law);
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
      run[kept] = begun(&m, n);
      if ((run[kept].x.mode > TF_SLIP_MINUS) != sticks ||
          !keeps_mode(&run[kept], &m, n, taken))
        break;
    }
    end_t want;
    if (kept < 3 || !true_end(&m, (ref_mode_t)run[0].x.mode, &want)) continue;
    for (int j = 0; j < 3; j++) sum[j] += apart(&run[j], &want);
    judged++;
  }
  printf("# %-24s %.2e, %.2e, %.2e: order %.2f\n", name, sum[0] / judged,
         sum[1] / judged, sum[2] / judged, log(sum[0] / sum[2]) / log(4));
  CHECK(judged == 20);
  CHECK(sum[0] > 3 * sum[1] && sum[0] < 5 * sum[1]);
  CHECK(!IS_DOUBLE || (sum[1] > 3 * sum[2] && sum[1] < 5 * sum[2]));
}

TEST(order_two_in_slip_on_a_ramp) {
  has_order_two("slip", plain, TF_TYRE_JUMP, false);
  has_order_two("slip, compensated", compensated, TF_TYRE_JUMP, false);
  has_order_two("slip, lanes", in_lanes, TF_TYRE_JUMP, false);
  has_order_two("slip, balanced", balanced, TF_TYRE_JUMP, false);
  has_order_two("slip without moment", plain, TF_TYRE_COULOMB, false);
  has_order_two("smooth law", plain, TF_TYRE_SMOOTH, false);
  has_order_two("string", plain, TF_TYRE_STRING, false);
}

TEST(order_two_in_stick_on_a_ramp) {
  has_order_two("stick", plain, TF_TYRE_JUMP, true);
  has_order_two("stick, compensated", compensated, TF_TYRE_JUMP, true);
  has_order_two("stick, lanes", in_lanes, TF_TYRE_JUMP, true);
}
