/* Laws that the simulated motion must obey, whatever the implementation. */
#include "sim.h"

/* Rounding of the terms of h, for speeds of the turntable up to 2 rad/s. */
static double slip_rounding(const sim_t *s) {
  const double z = fabs((double)s->x.w) + 2;
  const double arm = fabs((double)s->k.d) + fabs((double)s->x.r);
  return (double)TF_REAL_EPSILON * (fabs((double)s->x.v) + arm * z);
}

/* A scene of which stick is a part, by one scheme. A compensated step keeps |h|
 * at the rounding of one change of it, dt 1 m/s^2; the others keep it at that
 * of its terms at both ends. */
static void check_stick(scheme_t scheme, const char *name) {
  const tf_scene_t *scene = scene_named(name);
  tf_params_t p = scene->params;
  if (scheme == COMPENSATED) p.dt = TF_R(1e-5);
  sim_t s = sim_at_start(scene, &p, 0);
  const tf_report_t *o = &s.report;
  const double epsilon = (double)TF_REAL_EPSILON;
  const int steps = samples(scheme == MOREAU ? 1000000 : 400000);
  int sticks = 0, not_ok = 0;
  for (int n = 1; n <= steps; n++) {
    const double before = slip_rounding(&s);
    const unsigned was = s.x.mode;
    s.u = tf_scene_input(scene, &s.k, (uint64_t)n);
    const tf_status_t status = sim_step(&s, scheme);
    CHECK(status >= TF_OK && status != TF_DEGRADED);
    not_ok +=
        !ok_to_resolution(status); /* a slip that turns beside h = g = 0 */
    if (tf_mode_is_slip(s.x.mode)) continue;
    sticks++;
    CHECK_NEAR(o->slip.h, 0,
               scheme == COMPENSATED ? 32 * epsilon * (double)p.dt
                                     : before + slip_rounding(&s));
    /* Through h = g = 0 it is a mean with that of slip. */
    const double most = s.x.mode == was ? 1 : 4.0 / 3;
    CHECK(fabs((double)o->force.F) <= most * (double)p.mu);
    if (s.x.mode == TF_PINNED) CHECK(o->slip.g == 0);
    /* The side of g = 0 is not known below its rounding. */
    if (scheme == LOCATED && fabs((double)o->slip.g) >= 64 * epsilon)
      CHECK(fabs((double)o->residual) <= 8 * epsilon);
  }
  printf("# %s, %s: %d of %d steps in stick, %d not OK\n", name,
         scheme_name(scheme), sticks, steps, not_ok);
  CHECK(sticks > 1000 && not_ok < (scheme == COMPENSATED ? 1 : 10));
  if (!strcmp(name, "rolling")) CHECK(sticks == steps);
}

TEST(stick_is_exact) {
  for (scheme_t scheme = MOREAU; scheme < SCHEMES; scheme++) {
    check_stick(scheme, "rolling");
    check_stick(scheme, "chaos");
    check_stick(scheme, "driven");
  }
}

/* With the turntable at rest and no moment nothing feeds the motion: energy
 * falls but for the error of the scheme: of third order a step, and of second
 * in the step in which stick begins. */
TEST(dissipation_without_moment) {
  static const char *const names[] = {"coulomb", "frictionless"};
  for (int i = 0; i < 2; i++) {
    const tf_scene_t *scene = scene_named(names[i]);
    tf_params_t p = scene->params;
    double worst[2];
    p.omega0 = 0;
    for (int half = 0; half < 2; half++) {
      p.dt = (tf_real_t)(half ? 1e-3 : 2e-3);
      sim_t s = sim_at_start(scene, &p, 0);
      s.x.v = (tf_real_t)0.5; /* well off h = 0 */
      s.x.mode = TF_NO_MODE;
      CHECK(sim_begin(&s) == TF_OK);
      double energy = (double)tf_energy(&s.k, &s.x, s.u.r0);
      const double first = energy;
      worst[half] = 0;
      for (int n = 0; n < 5000; n++) {
        CHECK(ok_to_resolution(sim_step(&s, MOREAU)));
        const double next = (double)tf_energy(&s.k, &s.x, s.u.r0);
        if (next - energy > worst[half]) worst[half] = next - energy;
        energy = next;
      }
      CHECK(energy < (i ? 0.999 : 0.5) * first);
      if (i == 0) CHECK(s.report.slip.h * s.report.slip.h < 1e-6);
    }
    printf("# %s: largest rise of energy in a step %.2g J, at half dt %.2g\n",
           names[i], worst[0], worst[1]);
    CHECK(worst[0] < 2e-5);
    CHECK(worst[1] <= worst[0] / 3 + 16 * (double)TF_REAL_EPSILON);
  }
}
