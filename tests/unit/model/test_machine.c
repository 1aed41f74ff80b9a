/* Kinematics and energy, against the paper. */
#include "model/rates.h"
#include "sample.h"

TEST(kinematics_against_the_paper) {
  for (int i = 0; i < samples(100000); i++) {
    tf_params_t p = random_params();
    p.gamma = uniform(-3.14, 3.14);
    const tf_machine_t machine = prepared(&p);
    paper_t paper = paper_of(&p);
    const tf_real_t omega0 = i & 1 ? p.omega0 : uniform(-3, 3);
    const tf_real_t r = uniform(-2, 2), v = uniform(-2, 2), w = uniform(-2, 2);
    const real x[3] = {wide(r), wide(v), wide(w)};
    paper.omega0 = wide(omega0);
    const real z = fabsl(x[2] - paper.omega0);
    const real size = fabsl(x[1]) + (fabsl(paper.d) + fabsl(x[0])) * z;
    const tf_slip_t slip = tf_slip(&machine, r, v, w, omega0);
    CHECK_NEAR(wide(slip.h), paper_h(&paper, x), 4 * EPSILON * size);
    CHECK_NEAR(wide(slip.g), paper_g(&paper, x), 4 * EPSILON * size);
  }
}

TEST(slip_speed_is_refused_where_v_does_not_act_on_h) {
  const tf_real_t gamma[] = {0, TF_R(0.9e-6), TF_R(-0.9e-6),
                             TF_R(3.1415926535897932)};
  for (int i = 0; i < 4; i++) {
    tf_params_t p = tf_scenes[0]->params;
    tf_real_t v = 77;
    p.gamma = gamma[i];
    tf_machine_t machine = prepared(&p);
    CHECK(tf_speed_for_slip(&machine, 1, 1, -1, 0, &v) == TF_BAD_STATE);
    CHECK(v == 77);
    p.gamma = TF_R(1.1e-6);
    machine = prepared(&p);
    CHECK(tf_speed_for_slip(&machine, 1, 1, -1, 0, &v) == TF_OK);
    CHECK(v != 77);
    machine.sin_gamma = i % 2 ? TF_R(-1e-6) : TF_R(1e-6); /* the border */
    CHECK(tf_speed_for_slip(&machine, 1, 1, -1, 0, &v) == TF_OK);
  }
}

/* Of q' = v z + r z' the second part is bounded for every force of stick, and
 * one of them takes it to that bound. */
TEST(parts_of_q_rate_are_bounded) {
  for (int i = 0; i < samples(4000); i++) {
    const tf_params_t params = wide_params();
    const tf_machine_t k = prepared(&params);
    const tf_input_t u = tf_input_default(&k);
    const paper_t paper = paper_of(&params);
    const tf_real_t r = uniform(-0.5, 0.5), w = u.omega0 + uniform(-1, 1);
    const rates_t rates = rates_at(&k, &u, r, 0, w - u.omega0, u.omega0);
    const real x[3] = {wide(r), wide(k.d * (w - u.omega0)), wide(w)};
    real most = 0;
    for (int n = 0; n < 4; n++) {
      real dx[3];
      const real F = n & 1 ? paper.mu : -paper.mu;
      paper_rhs_time(&paper, x, F, n & 2 ? paper.kappa * F : -paper.kappa * F,
                     dx);
      most = fmaxl(most, fabsl(x[0] * dx[2]));
    }
    CHECK_NEAR(wide(rates.rz), most, 64 * EPSILON * (most + 100));
  }
}

TEST(energy_against_its_definition) {
  for (int i = 0; i < samples(50000); i++) {
    tf_params_t p = random_params();
    p.m = uniform(0.1, 10);
    const tf_machine_t machine = prepared(&p);
    const tf_state_t x = {
        .r = uniform(-2, 2), .v = uniform(-2, 2), .w = uniform(-2, 2)};
    const tf_real_t r0 = uniform(-1, 1);
    const ref_machine_t q = {PARAMETERS_OF(real, &p)};
    const real r = wide(x.r), v = wide(x.v), w = wide(x.w);
    const real stretch = r - wide(r0), dw = wide(p.d) * w;
    const real energy = ref_energy(&q, r, v - dw, w, stretch);
    const real size = 2 * ref_energy(&q, r, fabsl(v) + fabsl(dw), w, stretch);
    CHECK_NEAR(wide(tf_energy(&machine, &x, r0)), energy, 8 * EPSILON * size);
  }
}
