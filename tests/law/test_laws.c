/* Laws that the simulated motion must obey, whatever the implementation. */
#include "common.h"
#include "resolved.h"
#include "scene_named.h"

/* Prepares a scene's machine and places its start. */
static void start(const tf_scene_t *scene, const tf_params_t *params,
                  tf_machine_t *machine, tf_state_t *x) {
  tf_report_t report;
  memset(x, 0, sizeof *x);
  CHECK(tf_prepare(machine, params, NULL) == TF_OK);
  CHECK(tf_scene_start(scene, machine, 0, x, &report) == TF_OK);
}

/* Rounding of the terms of h, for speeds of the turntable up to 2 rad/s. */
static double slip_rounding(const tf_machine_t *k, const tf_state_t *x) {
  const double z = fabs((double)x->w) + 2;
  return (double)TF_REAL_EPSILON *
         (fabs((double)x->v) + (fabs((double)k->d) + fabs((double)x->r)) * z);
}

TEST(stick_is_exact) {
  static const char *const names[] = {"rolling", "chaos", "driven"};
  for (int i = 0; i < 3; i++) {
    const tf_scene_t *scene = scene_named(names[i]);
    tf_machine_t machine;
    tf_state_t x;
    long sticks = 0, told = 0;
    start(scene, &scene->params, &machine, &x);
    for (long n = 1; n <= 1000000; n++) {
      tf_report_t report;
      const double before = slip_rounding(&machine, &x);
      const unsigned was = x.mode;
      const tf_input_t u =
          tf_scene_input(scene, &machine, (tf_real_t)n * machine.dt);
      const tf_status_t status = tf_step(&machine, &x, &u, &report);
      CHECK(status >= TF_OK && status != TF_DEGRADED);
      told +=
          !ok_to_resolution(status); /* a slip that turns beside h = g = 0 */
      if (x.mode <= TF_SLIP_MINUS) continue;
      sticks++;
      CHECK_NEAR(report.slip.h, 0, before + slip_rounding(&machine, &x));
      /* Through h = g = 0 it is a mean with that of slip. */
      const double most = x.mode == was ? 1 : 4.0 / 3;
      CHECK(fabs((double)report.force.F) <= most * (double)machine.tyre.mu);
      if (x.mode == TF_PINNED) CHECK(report.slip.g == 0);
    }
    printf("# %s: %ld of 1000000 steps in stick\n", names[i], sticks);
    CHECK(sticks > 1000 && told < 10);
    if (i == 0) CHECK(sticks == 1000000);
  }
}

/* The symmetries of the model, each a map of machine and state under which
 * every orbit goes to an orbit. All are sign changes and powers of two, which
 * no rounding disturbs, so the simulated orbits must agree bit for bit:
 *   0 mirror:   d, gamma, omega0, w -> -      h -> -h
 *   1 reversal: r, v, r0, d -> -              h, g -> -h, -g
 *   2 half turn of the wheel: gamma + pi      h, g -> -h, -g
 *   3 mass:     m, k2, c1, c2, mu -> 4x
 *   4 time:     dt/2, v, w, omega0 2x, k2, mu 4x, c1, c2 2x */
static void transform(int which, tf_params_t *p, tf_state_t *x) {
  switch (which) {
    case 0:
      p->d = -p->d;
      p->gamma = -p->gamma;
      p->omega0 = -p->omega0;
      x->w = -x->w;
      break;
    case 1:
      p->r0 = -p->r0;
      p->d = -p->d;
      x->r = -x->r;
      x->v = -x->v;
      break;
    case 3:
      p->m *= 4, p->k2 *= 4, p->c1 *= 4, p->c2 *= 4, p->mu *= 4;
      break;
    case 4:
      p->dt /= 2, p->k2 *= 4, p->mu *= 4, p->c1 *= 2, p->c2 *= 2;
      p->omega0 *= 2, x->v *= 2, x->w *= 2;
      break;
    default:
      break;
  }
}

static unsigned transformed_mode(int which, unsigned mode) {
  static const unsigned mirror[] = {1, 0, 2, 3, 4}, reverse[] = {1, 0, 3, 2, 4};
  if (which == 0) return mirror[mode];
  return which == 1 || which == 2 ? reverse[mode] : mode;
}

static int same_bits(tf_real_t a, tf_real_t b) { /* but for the sign of 0 */
  return a == b;
}

static int agree(int which, const tf_state_t *a, const tf_state_t *b) {
  tf_params_t unused = {0};
  tf_state_t mapped = *a;
  transform(which, &unused, &mapped);
  return same_bits(mapped.r, b->r) && same_bits(mapped.v, b->v) &&
         same_bits(mapped.w, b->w) &&
         transformed_mode(which, a->mode) == b->mode;
}

TEST(mirror_symmetry) {
  static const char *const names[] = {"chaos", "gamma_zero", "coulomb",
                                      "smooth", "string"};
  for (int i = 0; i < 5; i++)
    for (int which = 0; which < 5; which++) {
      const tf_scene_t *scene = scene_named(names[i]);
      tf_params_t p = scene->params;
      tf_machine_t a, b;
      tf_state_t x, y;
      long n;
      if (which == 4 && p.law == TF_TYRE_SMOOTH) continue; /* epsilon */
      start(scene, &p, &a, &x);
      y = x;
      transform(which, &p, &y);
      CHECK(tf_prepare(&b, &p, NULL) == TF_OK);
      y.mode = (uint8_t)transformed_mode(which, x.mode);
      if (which == 2) {
        b.sin_gamma = -b.sin_gamma;
        b.minus_sin_gamma = -b.minus_sin_gamma;
        b.cos_gamma = -b.cos_gamma;
        b.d_sin_gamma = -b.d_sin_gamma;
        b.mu_sin_gamma = -b.mu_sin_gamma;
        b.mu_d_sin_gamma = -b.mu_d_sin_gamma;
      }
      const tf_input_t u = tf_input_default(&a), w = tf_input_default(&b);
      for (n = 0; n < 40000; n++) {
        tf_report_t first, second;
        const int s = tf_step(&a, &x, &u, &first);
        const int t = tf_step(&b, &y, &w, &second);
        if (s != t || first.choices != second.choices || !agree(which, &x, &y))
          break;
      }
      if (!CHECK(n == 40000))
        printf("#   %s, symmetry %d: differs at step %ld\n", names[i], which,
               n);
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
    tf_machine_t machine;
    tf_state_t x;
    tf_report_t report;
    double worst[2];
    p.omega0 = 0;
    for (int half = 0; half < 2; half++) {
      p.dt = (tf_real_t)(half ? 1e-3 : 2e-3);
      start(scene, &p, &machine, &x);
      x.v = (tf_real_t)0.5; /* well off h = 0 */
      x.mode = TF_NO_MODE;
      const tf_input_t u = tf_input_default(&machine);
      CHECK(tf_begin(&machine, &x, &u, &report) == TF_OK);
      double energy = (double)tf_energy(&machine, &x, u.r0);
      const double first = energy;
      worst[half] = 0;
      for (int n = 0; n < 5000; n++) {
        CHECK(ok_to_resolution(tf_step(&machine, &x, &u, &report)));
        const double next = (double)tf_energy(&machine, &x, u.r0);
        if (next - energy > worst[half]) worst[half] = next - energy;
        energy = next;
      }
      CHECK(energy < (i ? 0.999 : 0.5) * first);
      if (i == 0) CHECK(report.slip.h * report.slip.h < 1e-6);
    }
    printf("# %s: largest rise of energy in a step %.2g J, at half dt %.2g\n",
           names[i], worst[0], worst[1]);
    CHECK(worst[0] < 2e-5);
    CHECK(worst[1] <= worst[0] / 3 + 16 * (double)TF_REAL_EPSILON);
  }
}

/* Power of friction: the force takes power -F h, never gives it. Where a step
 * changes its mode at h = g = 0 its force is a mean with that before. */
TEST(friction_force_takes_power) {
  const tf_scene_t *scene = scene_named("chaos");
  tf_machine_t machine;
  tf_state_t x;
  start(scene, &scene->params, &machine, &x);
  const tf_input_t u = tf_input_default(&machine);
  for (int n = 0; n < 100000; n++) {
    tf_report_t report;
    const unsigned was = x.mode;
    CHECK(ok_to_resolution(tf_step(&machine, &x, &u, &report)));
    if (x.mode <= TF_SLIP_MINUS && x.mode == was)
      CHECK((double)(report.force.F * report.slip.h) >=
            -(double)TF_REAL_EPSILON);
  }
}
