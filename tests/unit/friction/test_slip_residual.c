/* How far a force is from the law of slip where the slip is zero, h = g = 0. */
#include "common.h"
#include "friction/rest_law.h"

/* At h = g = 0 every angle is in the law: forces of all of them leave nothing
 * open, others what they are off by. */
TEST(slip_law_at_codimension_two_takes_every_angle) {
  const tf_machine_t machine = prepared(&tf_scenes[0]->params);
  const tf_tyre_t *tyre = &machine.contact.tyre;
  const real size = (real)tyre->mu * (1 + (real)tyre->kappa);
  const real close = 32 * EPSILON * (1 + size);
  const tf_slip_t rest = {0, 0};
  for (int i = 0; i < 400; i++) {
    const int side = i % 2 ? 1 : -1;
    const double angle = tap_uniform(0, 6.283185307);
    const tf_force_t law = tf_tyre_force(tyre, (tf_real_t)side,
                                         (tf_real_t)(side * fabs(cos(angle))),
                                         (tf_real_t)sin(angle));
    const tf_force_t off = {law.F, law.M + (law.M < 0 ? TF_R(-1.0) : 1)};
    CHECK_NEAR(slip_law_residual(tyre, side < 0 ? MINUS : PLUS, law, rest), 0,
               close);
    CHECK_NEAR(slip_law_residual(tyre, side < 0 ? MINUS : PLUS, off, rest), 1,
               close);
  }
  /* On h = 0 alone the angle is known: one force, and how far from it. */
  for (int side = -1; side <= 1; side += 2) {
    const tf_slip_t slip = {0, TF_R(0.25)};
    tf_force_t force = tf_tyre_force(tyre, (tf_real_t)side, 0, slip.g);
    CHECK(slip_law_residual(tyre, side < 0 ? MINUS : PLUS, force, slip) == 0);
    force.M += 1;
    CHECK_NEAR(slip_law_residual(tyre, side < 0 ? MINUS : PLUS, force, slip), 1,
               close);
  }
  /* Nothing of the law is larger than 4/3 mu, which goes without a moment. */
  const tf_force_t strong = {2 * tyre->mu, 0};
  CHECK_NEAR(slip_law_residual(tyre, PLUS, strong, rest),
             2 * (real)tyre->mu / 3, close);
  const tf_force_t backward = {-tyre->mu, 0};
  CHECK(slip_law_residual(tyre, PLUS, backward, rest) >= 2 * tyre->mu);
}

/* Without contact every force is off, whatever slips. */
TEST(no_contact_has_no_force) {
  tf_params_t params = tf_scenes[0]->params;
  params.law = TF_TYRE_NONE;
  const tf_machine_t machine = prepared(&params);
  const tf_slip_t slip = {TF_R(0.5), TF_R(-0.25)};
  for (int i = 0; i < 4; i++) {
    const tf_force_t force = {i & 1 ? 2 : -2, i & 2 ? 4 : -4};
    CHECK(slip_law_residual(&machine.contact.tyre, 1, force, slip) == 6);
  }
}
