/* Equilibrium: a step that leaves r as it was there returns TF_OK. Out of it a
 * step that is too short to move r stalls. */
#include "sim.h"

static const scheme_t schemes[] = {MOREAU, LOCATED};

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

/* In equilibrium on the circle r = d tan(gamma), where the wheel rolls without
 * slipping, under any force of stick. */
static void roll(sim_t *s) {
  const tf_params_t *p = &s->params;
  const tf_real_t F = uniform(-0.9, 0.9) * p->mu;
  const tf_real_t M = p->law == TF_TYRE_COULOMB ? 0 : p->kappa * F;
  s->x.r = p->d * (tf_real_t)tan((double)p->gamma);
  CHECK(tf_speed_for_slip(&s->k, s->x.r, s->x.w, s->u.omega0, 0, &s->x.v) ==
        TF_OK);
  const bool back = tf_slip(&s->k, s->x.r, s->x.v, s->x.w, s->u.omega0).g < 0;
  s->x.mode = back ? TF_STICK_MINUS : TF_STICK_PLUS;
  load_for(p, &s->u, s->x.r, s->x.w, wide(F), wide(back ? -M : M));
}

/* In equilibrium under the force of a slip. */
static void slide(sim_t *s) {
  const tf_slip_t at = tf_slip(&s->k, s->x.r, 0, s->x.w, s->u.omega0);
  const tf_force_t by =
      tf_tyre_force(&s->k.contact.tyre, at.h < 0 ? -1 : 1, at.h, at.g);
  load_for(&s->params, &s->u, s->x.r, s->x.w, wide(by.F), wide(by.M));
  CHECK(sim_begin(s) == TF_OK);
}

/* How many steps in an equilibrium leave r as it was; none of them
 * may stall. The residue of the rounded inputs may drive it off in time. */
static long steps_in_equilibrium(const sim_t *start) {
  long still = 0;
  for (int i = 0; i < 2; i++) {
    sim_t s = *start;
    for (int n = 0; n < 3; n++) {
      const tf_real_t r = s.x.r;
      const tf_status_t status = sim_step(&s, schemes[i]);
      if (s.x.mode != start->x.mode || s.x.r != r) break;
      CHECK(status == TF_OK);
      still++;
    }
  }
  return still;
}

/* Slip somewhere, or stick. Some of them stand still. */
static void judge_equilibria(bool slips, int least_share) {
  long still = 0, of = 0;
  for (int i = 0; i < samples(4000); i++) {
    tf_params_t p = any_params();
    p.dt = log_uniform(1e-6, 1e-3);
    p.k2 += TF_R(0.1);
    sim_t s = sim_of(&p);
    s.x.r = uniform(-0.5, 0.5);
    s.x.w = p.omega0 * uniform(-2, 3);
    const tf_slip_t at = tf_slip(&s.k, s.x.r, 0, s.x.w, p.omega0);
    if (slips ? fabs((double)at.h) < 1e-3
              : fabs((double)p.d * tan((double)p.gamma)) > 5 ||
                    fabs(sin((double)p.gamma)) < 0.05)
      continue;
    slips ? slide(&s) : roll(&s);
    still += steps_in_equilibrium(&s);
    of += 6;
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
    for (int n = 0; n < 2; n++) {
      sim_t s = sim_of(&p);
      s.x = (tf_state_t){.r = TF_R(0.3)};
      CHECK(sim_step(&s, schemes[n]) == TF_STALLED);
      CHECK(s.x.r == TF_R(0.3) && s.x.v > 0);
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
    if (fabs((double)p.d * tan((double)p.gamma)) > 3) continue;
    sim_t s = sim_of(&p);
    roll(&s);
    s.x.mode = TF_SLIP_PLUS;
    for (int n = 0; n < 200; n++) {
      const tf_real_t r = s.x.r;
      const tf_status_t status = sim_step(&s, MOREAU);
      if (n < 100 || s.x.r != r) continue;
      still++;
      stalled += status == TF_STALLED;
    }
  }
  CHECK(still > samples(20000));
  CHECK(IS_DOUBLE ? stalled == 0 : 5 * stalled < still);
}
