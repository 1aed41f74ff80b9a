/* The tyre laws against what they stand for: the paper's own psi formulas and
 * Appendix B in long double (tests/reference/paper.h), and their limits at
 * h -> 0 and epsilon -> 0. Mirror images: law/test_units.c. The kernel inside
 * has its own test, test_kernel.c. */
#include "common.h"

static tf_real_t random_sign(void) { return of_any_sign(1); }

/* Members that every law accepts. */
static tf_params_t random_params(tf_tyre_law_t law) {
  tf_params_t p = params_of_law(law);
  p.mu = log_uniform(0.1, 10);
  p.kappa = log_uniform(1e-3, 1e2);
  p.epsilon = log_uniform(1e-6, 1e-1);
  p.k = log_uniform(0.1, 1e3);
  p.delta = log_uniform(1e-2, 10);
  p.sigma = tap_bits() % 4 ? log_uniform(1e-3, 3) : 0;
  p.rho = uniform(0.1, 1);
  p.a = log_uniform(1e-2, 10);
  return p;
}

static tf_tyre_t tyre_of(const tf_params_t *params) {
  return prepared(params).contact.tyre;
}

static paper_string_t string_of(const tf_tyre_t *tyre) {
  return (paper_string_t){.k = wide(tyre->stiffness),
                          .delta = wide(tyre->delta),
                          .sigma = wide(tyre->sigma),
                          .rho = wide(tyre->rho),
                          .a = wide(tyre->a)};
}

/* Forces of a string are accurate to rounding of its largest pressure, and of
 * the place where slip begins, which is of the size a + sigma. */
static void near_string(const tf_tyre_t *tyre, tf_force_t f, real F, real M) {
  const paper_string_t q = string_of(tyre);
  const real scale = 16 * EPSILON * wide(tyre->mu) * q.delta * (q.a + q.sigma);
  CHECK_NEAR(wide(f.F), wide(tyre->mu) * F, scale);
  CHECK_NEAR(wide(f.M), wide(tyre->mu) * M, scale * q.a);
}

TEST(tyre_identity_against_the_paper) {
  for (int i = 0; i < samples(200000); i++) {
    const tf_params_t params = random_params(TF_TYRE_JUMP);
    const tf_tyre_t tyre = tyre_of(&params);
    const tf_real_t side = random_sign(), H = log_uniform(1e-6, 10);
    const tf_real_t ratio =
        i % 2 ? log_uniform(1e-20, 1e20) : log_uniform(1e-2, 1e2);
    const tf_real_t g = i % 17 ? random_sign() * H * ratio : 0;
    const tf_force_t f = tf_tyre_force(&tyre, side, side * H, g);
    const paper_t paper = {.mu = wide(params.mu), .kappa = wide(params.kappa)};
    real F, M;
    paper_friction(&paper, wide(side * H), wide(g), &F, &M);
    CHECK_NEAR(wide(f.F), F, 4 * EPSILON * paper.mu);
    /* the reference itself rounds psi near pi/2: 1e-19 */
    CHECK_NEAR(wide(f.M), M, 20 * EPSILON * fabsl(M) + 1e-18L * paper.mu);
  }
}

/* At h -> 0 from either side: F = side mu, M = side sign(g) mu kappa, and an
 * h on the other side counts as 0. */
TEST(jump_law_at_the_jump) {
  for (int i = 0; i < samples(20000); i++) {
    const tf_params_t params = random_params(TF_TYRE_JUMP);
    const tf_tyre_t tyre = tyre_of(&params);
    const tf_real_t side = random_sign(),
                    g = random_sign() * log_uniform(1e-6, 10);
    const real F = wide(side) * wide(params.mu);
    const real M = F * (g < 0 ? -1 : 1) * wide(params.kappa);
    const tf_force_t at = tf_tyre_force(&tyre, side, 0, g);
    CHECK_NEAR(wide(at.F), F, 4 * EPSILON * fabsl(F));
    CHECK_NEAR(wide(at.M), M, 4 * EPSILON * fabsl(M));
    const tf_force_t across =
        tf_tyre_force(&tyre, side, -side * log_uniform(1e-9, 10), g);
    CHECK(across.F == at.F && across.M == at.M);
    const tf_real_t h = side * log_uniform(1e-12, 1e-8) * g;
    const tf_force_t close = tf_tyre_force(&tyre, side, g < 0 ? -h : h, g);
    const real slope = 1e-8L * (1 + 36 * wide(params.kappa * params.kappa));
    CHECK_NEAR(wide(close.F), F, (slope + 4 * EPSILON) * fabsl(F));
    CHECK_NEAR(wide(close.M), M, (slope + 20 * EPSILON) * fabsl(M));
    const tf_force_t nowhere = tf_tyre_force(&tyre, side, 0, 0);
    CHECK(nowhere.M == 0);
    CHECK_NEAR(wide(nowhere.F), 4 * F / 3, 2 * EPSILON * fabsl(F));
  }
}

TEST(string_law_against_quadrature) {
  int seen[4] = {0, 0, 0, 0};
  for (int i = 0; i < samples(100000); i++) {
    const tf_params_t params = random_params(TF_TYRE_STRING);
    const tf_tyre_t tyre = tyre_of(&params);
    const paper_string_t q = string_of(&tyre);
    /* k l / delta = g / h with l the distance at which slip begins */
    const real border = q.k * (2 * q.a + q.sigma) / q.delta;
    const tf_real_t H = log_uniform(1e-3, 10);
    tf_real_t G = (tf_real_t)(wide(H * log_uniform(1e-2, 10)) * border);
    if (i % 8 == 0) /* next to a border of the three cases */
      G = (tf_real_t)(wide(H) *
                      (i % 16 || q.sigma == 0 ? border
                                              : q.k * q.sigma / q.delta) *
                      (1 + (int)(tap_bits() % 7 - 3) * EPSILON));
    const tf_force_t f = tf_tyre_force(&tyre, 1, H, G);
    const real phi = atan2l(wide(H), wide(G));
    real F, M;
    seen[paper_string_quadrature(&q, phi, &F, &M)]++;
    near_string(&tyre, f, F, M);
  }
  for (int n = 1; n <= 3; n++) CHECK(seen[n] > samples(1000));
}

/* g = 0 is full slip, h = 0 no force, h = g = 0 no angle and no force. */
TEST(string_law_at_its_ends) {
  for (int i = 0; i < samples(10000); i++) {
    const tf_params_t params = random_params(TF_TYRE_STRING);
    const tf_tyre_t tyre = tyre_of(&params);
    const tf_real_t x = random_sign() * log_uniform(1e-9, 1e3);
    const tf_force_t across = tf_tyre_force(&tyre, 1, x, 0);
    const tf_force_t along = tf_tyre_force(&tyre, 1, 0, x);
    const tf_force_t nowhere = tf_tyre_force(&tyre, 1, 0, 0);
    const real F = 2 * wide(params.mu) * wide(params.a) * wide(params.rho) *
                   wide(params.delta);
    CHECK_NEAR(wide(across.F), x < 0 ? -F : F, 4 * EPSILON * F);
    CHECK(across.M == 0);
    CHECK(along.F == 0 && along.M == 0);
    CHECK(nowhere.F == 0 && nowhere.M == 0);
  }
}

/* Appendix B: sigma = 0, rho = 2/3, delta = 1/(3 kappa), a = 3 kappa; and the
 * formulas that it prints for them. */
TEST(two_piece_law_is_the_string_law) {
  for (int i = 0; i < samples(50000); i++) {
    tf_params_t params = random_params(TF_TYRE_TWO_PIECE);
    const tf_tyre_t two = tyre_of(&params);
    const real kappa = wide(params.kappa), mu = wide(params.mu);
    params.law = TF_TYRE_STRING;
    params.sigma = 0;
    params.rho = (tf_real_t)(2.0L / 3);
    params.delta = (tf_real_t)(1 / (3 * kappa));
    params.a = (tf_real_t)(3 * kappa);
    const tf_tyre_t string = tyre_of(&params);
    const real border = 18 * wide(params.k) * kappa * kappa; /* g / h */
    const tf_real_t H = log_uniform(1e-3, 10);
    const tf_real_t G = (tf_real_t)(wide(H * log_uniform(1e-3, 1e2)) * border);
    const tf_force_t f = tf_tyre_force(&two, 1, H, G);
    const tf_force_t s = tf_tyre_force(&string, 1, H, G);
    near_string(&two, f, wide(s.F) / mu, wide(s.M) / mu);
    const real cot = wide(G) / wide(H);
    const real F = cot > border ? border / cot : 4.0L / 3 - cot / border / 3;
    const real M = kappa * (cot > border ? border / cot : cot / border);
    near_string(&two, f, F, M);
  }
}

/* The smoothed law is the paper's times |h| / sqrt(h^2 + epsilon^2). */
TEST(smooth_law_tends_to_the_jump) {
  for (int i = 0; i < samples(100000); i++) {
    tf_params_t params = random_params(TF_TYRE_SMOOTH);
    const tf_real_t H = log_uniform(1e-3, 10), side = random_sign();
    const tf_real_t g = random_sign() * log_uniform(1e-6, 1e3);
    params.epsilon = log_uniform(1e-9, 10);
    const tf_tyre_t smooth = tyre_of(&params);
    params.law = TF_TYRE_JUMP;
    const tf_tyre_t jump = tyre_of(&params);
    const tf_force_t f = tf_tyre_force(&smooth, side, side * H, g);
    const tf_force_t j = tf_tyre_force(&jump, side, side * H, g);
    const real ratio = wide(params.epsilon) / wide(H);
    const real share = 1 / sqrtl(1 + ratio * ratio);
    CHECK_NEAR(wide(f.F), share * wide(j.F), 4 * EPSILON * fabsl(wide(j.F)));
    CHECK_NEAR(wide(f.M), share * wide(j.M), 4 * EPSILON * fabsl(wide(j.M)));
    const tf_force_t other = tf_tyre_force(&smooth, -side, side * H, g);
    CHECK(other.F == f.F && other.M == f.M);
    const tf_force_t zero = tf_tyre_force(&smooth, side, 0, g);
    CHECK(zero.F == 0 && zero.M == 0);
    if (ratio < 1e-5L)
      CHECK_NEAR(wide(f.F), wide(j.F),
                 (1e-10L + 4 * EPSILON) * fabsl(wide(j.F)));
  }
}
