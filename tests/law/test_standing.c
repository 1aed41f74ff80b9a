/* Equilibrium: a step that leaves r as it was there returns TF_OK. Out of it a
 * step that is too short to move r stalls. */
#include "common.h"

typedef tf_status_t (*step_t)(const tf_machine_t *, tf_state_t *,
                              const tf_input_t *, tf_report_t *);

static const step_t steps[] = {tf_step, tf_step_located};
#define KINDS (sizeof steps / sizeof *steps)

/* One machine in four has a multiple of pi/4 for gamma. */
static tf_params_t any_params(void) {
  tf_params_t p = wide_params();
  const double quarter = 0.78539816339744830962;
  if (tap_uniform(0, 1) < 0.5) p.c1 = 0;
  if (tap_uniform(0, 1) < 0.5) p.c2 = 0;
  p.omega0 = of_any_sign(log_uniform(0.1, 3));
  if (tap_uniform(0, 1) < 0.25)
    p.gamma = (tf_real_t)(quarter * floor(tap_uniform(-3, 4)));
  if (tap_uniform(0, 1) < 0.1) p.law = TF_TYRE_COULOMB;
  return p;
}

/* Inputs under which the force keeps (r, 0, w) in equilibrium: the spring's
 * rest position and the torque answer it. */
static void balance(const tf_params_t *p, const tf_state_t *x, tf_force_t by,
                    tf_input_t *u) {
  u->r0 = x->r;
  const ref_machine_t q = reference_of(p, u);
  const ref_state_t at = ref_state(&q, q.r0, 0, wide(x->w));
  const ref_rate_t rate =
      ref_rate(&q, at, (ref_force_t){wide(by.F), wide(by.M)});
  const real inertia = q.m * (q.beta * q.beta + q.r0 * q.r0);
  u->r0 = (tf_real_t)(q.r0 - q.m * rate.p / q.k2);
  u->torque = (tf_real_t)(q.d * q.m * rate.p - inertia * rate.z);
}

/* How many steps in an equilibrium leave r as it was; none may be told to
 * move. The residue of the rounded inputs may drive it off in time. */
static long steps_in_equilibrium(const tf_machine_t *k, tf_state_t x,
                                 const tf_input_t *u) {
  long still = 0;
  for (size_t s = 0; s < KINDS; s++) {
    tf_state_t y = x;
    for (int n = 0; n < 3; n++) {
      const tf_real_t r = y.r;
      tf_report_t report;
      const tf_status_t status = steps[s](k, &y, u, &report);
      if (y.mode != x.mode || y.r != r) break;
      CHECK(status == TF_OK);
      still++;
    }
  }
  return still;
}

static tf_state_t placed(double omega) {
  return (tf_state_t){
      .r = uniform(-0.5, 0.5), .w = (tf_real_t)omega, .mode = TF_NO_MODE};
}

/* Slip somewhere, or stick on the circle r = d tan(gamma), where the wheel
 * rolls without slipping. Some of them stand still. */
static void judge_equilibria(bool slips, int least_share) {
  long still = 0, of = 0;
  for (int i = 0; i < samples(4000); i++) {
    tf_params_t p = any_params();
    p.dt = log_uniform(1e-6, 1e-3);
    p.k2 += TF_R(0.1);
    const tf_machine_t k = prepared(&p);
    tf_input_t u = tf_input_default(&k);
    tf_state_t x = placed((double)p.omega0 * tap_uniform(-2, 3));
    const double r = (double)p.d * tan((double)p.gamma);
    tf_report_t report;
    tf_force_t by;
    if (!slips) {
      if (fabs(r) > 5 || fabs(sin((double)p.gamma)) < 0.05) continue;
      x.r = (tf_real_t)r;
      CHECK(tf_speed_for_slip(&k, x.r, x.w, u.omega0, 0, &x.v) == TF_OK);
    }
    const tf_slip_t slip = tf_slip(&k, x.r, x.v, x.w, u.omega0);
    if (slips) {
      if (fabs((double)slip.h) < 1e-3) continue;
      by = tf_tyre_force(&k.contact.tyre, slip.h < 0 ? -1 : 1, slip.h, slip.g);
    } else {
      const tf_real_t kappa = p.law == TF_TYRE_COULOMB ? 0 : p.kappa;
      by.F = uniform(-0.9, 0.9) * p.mu;
      by.M = slip.g < 0 ? -kappa * by.F : kappa * by.F;
      x.mode = slip.g < 0 ? TF_STICK_MINUS : TF_STICK_PLUS;
    }
    balance(&p, &x, by, &u);
    if (slips) CHECK(tf_begin(&k, &x, &u, &report) == TF_OK);
    still += steps_in_equilibrium(&k, x, &u);
    of += 3 * (long)KINDS;
  }
  CHECK(least_share * still > of);
}

TEST(slip_in_equilibrium_is_not_told_to_move) { judge_equilibria(true, 2); }
TEST(stick_in_equilibrium_is_not_told_to_move) { judge_equilibria(false, 10); }

/* From rest a stretched spring moves the slider by less than half of the last
 * digit of r, in 32 steps as well. */
TEST(step_too_short_to_move_the_slider_stalls) {
  for (int i = 0; i < samples(400); i++) {
    tf_params_t p = wide_params();
    const tf_real_t rate = log_uniform(1e-4, 1e-3);
    p.law = TF_TYRE_NONE;
    p.d = p.omega0 = p.c1 = p.c2 = 0;
    p.k2 = uniform(0.01, 0.1);
    p.r0 = TF_R(0.3) + p.m * rate / p.k2;
    p.dt = (tf_real_t)sqrtl(EPSILON / (1e4L * wide(rate))) * uniform(0.3, 3);
    const tf_machine_t k = prepared(&p);
    const tf_input_t u = tf_input_default(&k);
    for (size_t s = 0; s < KINDS; s++) {
      tf_state_t x = {.r = TF_R(0.3)};
      tf_report_t report;
      CHECK(steps[s](&k, &x, &u, &report) == TF_STALLED);
      CHECK(x.r == TF_R(0.3) && x.v > 0);
    }
  }
}

/* The smooth law holds a wheel that rolls on the circle, against loads of any
 * size below mu, by a slip of 1e-12 m/s, which is rounding: its force at that
 * slip is off, but each step balances it. Where a step leaves r as it was, the
 * motion is at rest there. In float the way there takes longer than this. */
TEST(smooth_law_in_equilibrium_is_not_told_to_move) {
  long still = 0, stalled = 0;
  for (int i = 0; i < samples(1200); i++) {
    tf_params_t p = wide_params();
    p.law = TF_TYRE_SMOOTH;
    p.epsilon = TF_R(1e-12);
    p.mu = log_uniform(0.05, 0.2);
    p.k2 = 1;
    p.gamma = uniform(0.3, 2.8);
    p.dt = IS_DOUBLE ? log_uniform(1e-7, 1e-4) : log_uniform(1e-4, 1e-2);
    const tf_machine_t k = prepared(&p);
    tf_input_t u = tf_input_default(&k);
    tf_state_t x = {.r = p.d * (tf_real_t)tan((double)p.gamma), .mode = 0};
    if (fabsl(wide(x.r)) > 3) continue;
    CHECK(tf_speed_for_slip(&k, x.r, x.w, u.omega0, 0, &x.v) == TF_OK);
    const tf_slip_t slip = tf_slip(&k, x.r, x.v, x.w, u.omega0);
    tf_force_t by = {uniform(-0.9, 0.9) * p.mu, 0};
    by.M = slip.g < 0 ? -p.kappa * by.F : p.kappa * by.F;
    balance(&p, &x, by, &u);
    for (int n = 0; n < 200; n++) {
      const tf_real_t r = x.r;
      tf_report_t report;
      const tf_status_t status = tf_step(&k, &x, &u, &report);
      if (n < 100 || x.r != r) continue;
      still++;
      stalled += status == TF_STALLED;
    }
  }
  CHECK(still > samples(20000));
  CHECK(IS_DOUBLE ? stalled == 0 : 5 * stalled < still);
}
