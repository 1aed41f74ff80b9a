/* The normal form of a two-fold: against the paper in long double and its
 * rescaled time, and against the true sliding field next to it. */
#include "sample.h"

/* What K is made of, so what it can lose: the gradient of h' times f. */
static real bulk_of(const sample_t *c) {
  real n[3], f[3], sum = 0;
  paper_t p = c->paper;
  paper_lie_x(&p, c->x, p.mu, c->s, n);
  paper_f(&p, c->x, p.mu, c->s, f);
  for (int i = 0; i < 3; i++) sum += fabsl(n[i] * f[i]);
  paper_lie_x(&p, c->x, -p.mu, c->s, n);
  paper_f(&p, c->x, -p.mu, c->s, f);
  for (int i = 0; i < 3; i++) sum += fabsl(n[i] * f[i]);
  return sum / c->c2 + p.mu * p.mu / sqrtl(c->c2);
}

TEST(normal_form_against_the_paper) {
  int seen[4] = {0};
  for (int i = 0; i < samples(5000); i++) {
    const sample_t c = random_two_fold();
    const tf_two_fold_t *at = &c.design.two_fold;
    paper_twofold_t n;
    paper_twofold(&c.paper, c.x, c.s, &n);
    const real close = 256 * EPSILON * bulk_of(&c);
    CHECK_NEAR(wide(at->Kpp), n.Kpp / c.c2, close);
    CHECK_NEAR(wide(at->Kpm), n.Kpm / c.c2, close);
    CHECK_NEAR(wide(at->Kmp), n.Kmp / c.c2, close);
    CHECK_NEAR(wide(at->Kmm), n.Kmm / c.c2, close);
    const real Kpp = fabsl(n.Kpp) / c.c2, Kmm = fabsl(n.Kmm) / c.c2;
    const real least = Kpp < Kmm ? Kpp : Kmm, largest = Kpp + Kmm;
    if (!(n.Kpp * n.Kmm < 0) || least < 100 * close) continue;
    const real loss =
        8 * close / least * (1 + fabsl(n.J1) + fabsl(n.J2)) * largest / least;
    CHECK_NEAR(wide(at->J1), n.J1, loss);
    CHECK_NEAR(wide(at->J2), n.J2, loss);
    const bool invisible = n.Kpp < 0;
    CHECK_NEAR(wide(at->through.value), n.eigen[invisible ? 0 : 1], loss);
    CHECK_NEAR(wide(at->across.value), n.eigen[invisible ? 1 : 0], loss);
    CHECK(at->type == (invisible ? TF_FOLDS_INVISIBLE : TF_FOLDS_VISIBLE));
    if (invisible)
      CHECK_NEAR(wide(at->through.lambda) / c.paper.mu, n.lambda, loss);
    const int paper_case = n.J1 * n.J2 < 1 ? 3 : n.eigen[0] < 0 ? 1 : 2;
    seen[at->paper_case]++;
    if (fabsl(n.J1 * n.J2 - 1) > loss)
      CHECK(at->paper_case == (invisible ? paper_case : 0));
  }
  for (int i = 0; i < 4; i++) CHECK(seen[i] > samples(20));
}

/* Next to a two-fold the core's stick velocity is taken, and what it does to
 * (L+, L-) by the paper's gradients; the normal form has to foretell both. */
TEST(sliding_motion_follows_the_normal_form) {
  int seen = 0;
  for (int i = 0; i < samples(3000); i++) {
    const sample_t c = random_two_fold();
    const tf_two_fold_t *at = &c.design.two_fold;
    const real pp = wide(at->Kpp), pm = wide(at->Kpm);
    const real mp = wide(at->Kmp), mm = wide(at->Kmm);
    const real det = pp * mm - pm * mp, scale = fabsl(pp) + fabsl(mm);
    const real bulk = bulk_of(&c);
    if (fabsl(det) < 0.05L * scale * scale || scale < 0.05L * bulk) continue;
    if (fabsl(wide(at->point.g)) < 0.05L || fabsl(c.x[0]) < 0.1L) continue;
    const real speed = fabsl(wide(at->plus.v)) + fabsl(wide(at->plus.w)) +
                       fabsl(wide(at->minus.v)) + fabsl(wide(at->minus.w));
    const real push = c.paper.k2 * (fabsl(c.x[0]) + fabsl(c.paper.r0)) +
                      fabsl(c.x[0]) * c.x[2] * c.x[2] + c.paper.mu;
    real slope[3];
    paper_lie_x(&c.paper, c.x, c.paper.mu, c.s, slope);
    /* of h' itself, and of the place's own rounding */
    const real noise = EPSILON *
                       ((1 + fabsl(c.paper.d)) * push + fabsl(slope[0]) +
                        2 * fabsl(slope[1]) + 2 * fabsl(slope[2])) /
                       wide(at->time_scale);
    if (sqrtl(EPSILON) * scale * 0.3L < 200 * noise) continue;
    /* In the cone, by (L+, L-) = step (-b, a): sliding, then escaping. */
    const real a = tap_uniform(0.2, 0.8), b = 1 - a;
    for (int side = -1; side <= 1; side += 2) {
      const real step = (real)side * sqrtl(EPSILON) * scale * 0.3L;
      const real alpha = step * (-b * mm - a * pm) / det;
      const real beta = step * (pp * a + mp * b) / det;
      const real r = c.x[0] + (alpha + beta) * wide(at->plus.r);
      const real w =
          c.x[2] + alpha * wide(at->plus.w) + beta * wide(at->minus.w);
      tf_real_t v = 0;
      tf_surface_t s;
      CHECK(tf_speed_for_slip(&c.machine, (tf_real_t)r, (tf_real_t)w,
                              c.input.omega0, 0, &v) == TF_OK);
      const real y[3] = {wide((tf_real_t)r), wide(v), wide((tf_real_t)w)};
      CHECK(tf_surface_at(&c.machine, &c.input, (tf_real_t)r, v, (tf_real_t)w,
                          &s) == TF_OK);
      CHECK(s.region == (side > 0 ? TF_REGION_SLIDING : TF_REGION_ESCAPING));
      const real clock =
          c.paper.m * (c.paper.beta * c.paper.beta + y[0] * y[0]);
      real n[3], rate[2];
      for (int k = 0; k < 2; k++) {
        paper_lie_x(&c.paper, y, k ? -c.paper.mu : c.paper.mu, c.s, n);
        rate[k] = (n[0] * wide(s.stick.r) + n[1] * wide(s.stick.v) +
                   n[2] * wide(s.stick.w)) /
                  clock;
      }
      const real close = 300 * sqrtl(EPSILON) * (1 + bulk + speed * speed);
      CHECK_NEAR(rate[0], (pm * b + pp * a), close);
      CHECK_NEAR(rate[1], (mm * b + mp * a), close);
      CHECK_NEAR(wide(s.stick.w), a * wide(at->plus.w) + b * wide(at->minus.w),
                 close);
      CHECK_NEAR(wide(s.lambda), c.paper.mu * (a - b), close);
      seen++;
    }
  }
  CHECK(seen > samples(200));
}

/* With every input driven, K^{ab} is the rate of h_x.f(x, a mu) along f(x, b
 * mu), the turntable turning on. */
TEST(driven_two_fold_is_the_second_rate) {
  int seen = 0;
  for (int i = 0; i < samples(2000); i++) {
    const tf_params_t params = random_params();
    const tf_machine_t machine = prepared(&params);
    tf_input_t input = tf_input_default(&machine);
    input.force = uniform(-1, 1);
    input.torque = uniform(-0.5, 0.5);
    input.alpha = uniform(-1, 1);
    tf_surface_point_t at[TF_TWO_FOLDS];
    int count = 0;
    CHECK(tf_two_folds(&machine, &input, at, &count, NULL) == TF_OK);
    for (int j = 0; j < count; j++) {
      tf_two_fold_t n;
      const tf_surface_point_t *x = &at[j];
      CHECK(tf_normal_form(&machine, &input, x, &n) == TF_OK);
      const real speed = fabsl(wide(n.plus.v)) + fabsl(wide(n.plus.w)) +
                         fabsl(wide(n.minus.v)) + fabsl(wide(n.minus.w));
      const real size = fabsl(wide(x->v)) + fabsl(wide(x->w));
      if (size > 10 || speed > 200 || fabsl(wide(x->g)) < 0.2L ||
          fabsl(wide(x->r)) < 0.1L)
        continue;
      CHECK(wide(n.residual) < 1e4L * EPSILON * (1 + speed));
      const tf_real_t step = (tf_real_t)(cbrtl(EPSILON) / (1 + speed) / 10);
      real rate[2][2];
      for (int k = 0; k < 2; k++) {
        const tf_rate_t *f = k ? &n.minus : &n.plus;
        tf_surface_t s[2];
        for (int e = 0; e < 2; e++) {
          const tf_real_t t = e ? -step : step;
          tf_input_t then = input;
          then.omega0 += t * input.alpha;
          CHECK(tf_surface_at(&machine, &then, x->r + t * f->r, x->v + t * f->v,
                              x->w + t * f->w, &s[e]) == TF_OK);
        }
        rate[0][k] =
            (wide(s[0].lie_plus) - wide(s[1].lie_plus)) / (2 * wide(step));
        rate[1][k] =
            (wide(s[0].lie_minus) - wide(s[1].lie_minus)) / (2 * wide(step));
      }
      const real close =
          cbrtl(EPSILON) * cbrtl(EPSILON) * 3e3L * (1 + speed) * (1 + speed);
      CHECK_NEAR(wide(n.Kpp), rate[0][0], close);
      CHECK_NEAR(wide(n.Kpm), rate[0][1], close);
      CHECK_NEAR(wide(n.Kmp), rate[1][0], close);
      CHECK_NEAR(wide(n.Kmm), rate[1][1], close);
      seen++;
    }
  }
  CHECK(seen > samples(100));
}
