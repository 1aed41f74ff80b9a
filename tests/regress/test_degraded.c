/* A slip that is lost while only an escaping stick is consistent: the step used
 * to enter that stick and to report that nothing was consistent. */
#include "sample.h"
#include "sim.h"

/* Both fields point away from an escaping stick, with a Delassus scalar < 0. */
TEST(no_step_enters_an_escaping_stick_from_slip) {
  const int machines = samples(20000);
  long slips = 0;
  for (int i = 0; i < machines; i++) {
    tf_params_t p = tf_scenes[0]->params;
    p.gamma = uniform(-3.14, 3.14);
    p.kappa = log_uniform(1e-2, 10);
    p.d = uniform(-1, 1);
    p.beta = log_uniform(1e-2, 1e-1);
    p.theta = uniform(0.5, 1);
    p.dt = log_uniform(1e-4, 1e-2);
    sim_t s = sim_of(&p);
    s.x.r = uniform(-0.3, 0.3);
    s.x.v = uniform(-0.1, 0.1);
    s.x.w = uniform(-1.1, -0.9);
    if (sim_begin(&s) != TF_OK) continue;
    for (int j = 0; j < 50; j++) {
      const uint8_t mode = s.x.mode;
      const tf_status_t status = sim_step(&s, MOREAU);
      if (status < 0) break;
      CHECK(status != TF_OK || s.report.set & TF_MODE_BIT(s.report.mode));
      if (!tf_mode_is_slip(mode)) continue;
      slips++;
      CHECK(s.x.mode == TF_PINNED || tf_mode_is_slip(s.x.mode) ||
            s.report.delassus > 0);
    }
  }
  CHECK_ABOVE(slips, samples(100000));
}

/* A machine in long steps, and a state in some mode. */
static tf_params_t coarse_machine(tf_state_t *x) {
  tf_params_t p = random_params();
  p.dt = log_uniform(1e-3, 0.5);
  p.theta = uniform(0.5, 1);
  p.kappa = uniform(0.05, 3);
  *x = (tf_state_t){.r = uniform(-0.3, 0.3),
                    .v = uniform(-0.1, 0.1),
                    .w = p.omega0 + uniform(-0.1, 0.1),
                    .mode = (uint8_t)(tap_bits() % TF_MODES)};
  return p;
}

/* The same machine in units of length of 2^-16 m, and its mirror image. */
static tf_params_t in_small_units(tf_params_t p) {
  const tf_real_t size = 65536;
  p.d *= size, p.beta *= size, p.kappa *= size, p.r0 *= size, p.mu *= size;
  p.c1 *= size * size;
  return p;
}

static tf_status_t degraded_twin(tf_params_t p, tf_state_t x, int mirrored,
                                 tf_report_t *report) {
  const tf_real_t side = mirrored ? TF_R(-1.0) : TF_R(1.0);
  p.d *= side, p.gamma *= side, p.omega0 *= side, x.w *= side;
  if (mirrored && tf_mode_is_slip(x.mode))
    x.mode = x.mode == TF_SLIP_PLUS ? TF_SLIP_MINUS : TF_SLIP_PLUS;
  const tf_machine_t k = prepared(&p);
  const tf_input_t u = tf_input_default(&k);
  return tf_step(&k, &x, &u, report);
}

/* Each slip has a residual of 2 at most, however far on the wrong side it ends,
 * and in small units of length that is less than that of a stick without its
 * moment or of a pinned wheel. Of the slips the one that ends less far on the
 * wrong side is taken, and its mirror image in the mirror image. */
TEST(of_two_wrong_slips_the_nearer_is_taken) {
  int ties = 0;
  for (int n = 0; n < 600000 && ties < 40; n++) {
    tf_state_t x;
    tf_report_t report, image;
    const tf_params_t p = in_small_units(coarse_machine(&x));
    x.r *= 65536, x.v *= 65536;
    if (degraded_twin(p, x, 0, &report) != TF_DEGRADED) continue;
    sim_t pairs = sim_of(&p); /* the compensated step picks as the plain one */
    pairs.x = x;
    if (sim_step(&pairs, COMPENSATED) == TF_DEGRADED)
      CHECK(pairs.report.mode == report.mode && pairs.report.set == report.set);
    if (degraded_twin(p, x, 1, &image) != TF_DEGRADED || report.set != 0 ||
        report.residual != 2 || image.residual != 2)
      continue;
    ties++;
    CHECK(tf_mode_is_slip(report.mode) && tf_mode_is_slip(image.mode));
    CHECK(report.mode != image.mode && report.slip.h == -image.slip.h);
  }
  CHECK_ABOVE(ties, 19);
}
