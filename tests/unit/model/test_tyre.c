/* The tyre laws against the reference in long double, and their limits at
 * h -> 0. Mirror images: law/test_units.c. The kernel inside has its own test,
 * test_kernel.c. */
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

/* Forces of a string are accurate to rounding of its largest pressure, and of
 * the place where slip begins, which is of the size a + sigma. */
static void near_string(const tf_params_t *p, tf_force_t f, real F, real M) {
  const real length = wide(p->a) + wide(p->sigma);
  const real scale = 16 * EPSILON * wide(p->mu) * wide(p->delta) * length;
  CHECK_NEAR(wide(f.F), F, scale);
  CHECK_NEAR(wide(f.M), M, scale * wide(p->a));
}

/* |g/h| of any size; of a string next to a border of the three cases, where l,
 * the distance at which slip begins, is k l / delta = |g/h|. */
static tf_real_t any_ratio(const tf_params_t *p, int i) {
  if (p->law != TF_TYRE_STRING)
    return i % 2 ? log_uniform(1e-20, 1e20) : log_uniform(1e-2, 1e2);
  const tf_real_t all = p->k * (2 * p->a + p->sigma) / p->delta;
  if (i % 8) return all * log_uniform(1e-2, 10);
  return (i % 16 || p->sigma == 0 ? all : p->k * p->sigma / p->delta) *
         (1 + (tf_real_t)((int)(tap_bits() % 7) - 3) * TF_REAL_EPSILON);
}

/* law/test_errata.c judges the reference. Across and along the string h or g is
 * 0; the smoothed law and that of the string do not jump: no side is theirs. */
TEST(laws_are_those_of_the_reference) {
  const tf_tyre_law_t laws[] = {TF_TYRE_JUMP, TF_TYRE_COULOMB, TF_TYRE_STRING,
                                TF_TYRE_SMOOTH, TF_TYRE_NONE};
  int zones[3] = {0, 0, 0};
  for (int i = 0; i < samples(400000); i++) {
    const tf_params_t p = random_params(laws[i % 5]);
    const tf_tyre_t tyre = tyre_of(&p);
    const tf_input_t u = {.force = 0};
    const ref_machine_t q = reference_of(&p, &u);
    const bool jumps = tf_tyre_is_set_valued(p.law);
    const tf_real_t size = log_uniform(1e-6, 10), side = random_sign();
    const tf_real_t h = jumps || i % 19 ? side * size : 0;
    const tf_real_t g =
        h == 0 || i % 17 ? random_sign() * size * any_ratio(&p, i) : 0;
    const tf_force_t f =
        tf_tyre_force(&tyre, jumps ? side : random_sign(), h, g);
    const ref_slip_t slip = {wide(h), wide(g)};
    const ref_piece_t piece = ref_piece_at(&q, slip, side < 0 ? -1 : 1);
    const ref_force_t want = ref_slip_force(&q, slip, piece);
    if (p.law == TF_TYRE_STRING) {
      near_string(&p, f, want.F, want.M);
      zones[piece.zone]++;
      continue;
    }
    CHECK_NEAR(wide(f.F), want.F, 8 * EPSILON * fabsl(want.F));
    CHECK_NEAR(wide(f.M), want.M, 24 * EPSILON * fabsl(want.M));
    if (!jumps && h == 0) CHECK(f.F == 0 && f.M == 0);
  }
  for (int n = 0; n < 3; n++) CHECK_ABOVE(zones[n], samples(1000));
  for (int i = 0; i < TF_TYRE_LAWS; i++) { /* no angle, and a string no force */
    const tf_params_t p = random_params((tf_tyre_law_t)i);
    const tf_tyre_t tyre = tyre_of(&p);
    const tf_force_t f = tf_tyre_force(&tyre, 1, 0, 0);
    CHECK(f.M == 0 && (tf_tyre_is_set_valued(p.law) || f.F == 0));
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
    near_string(&params, f, wide(s.F), wide(s.M));
    const real cot = wide(G) / wide(H);
    const real F = cot > border ? border / cot : 4.0L / 3 - cot / border / 3;
    const real M = kappa * (cot > border ? border / cot : cot / border);
    near_string(&params, f, mu * F, mu * M);
  }
}
