/* What the paper says in words and no other test has: each statement as a law,
 * followed by the core. What does not hold as it is said is noted in
 * docs/PAPER.md. */
#include "sim.h"

/* Follows stick from h = 0 until A < 1e-4, less than 1 ms before the two-fold,
 * with the state of that instant; its time, or -1 where another mode comes
 * before, or does not begin. */
static double time_to_the_two_fold(sim_t *s, double r, double w) {
  if (sim_place(s, r, w, 0, TF_STICK_PLUS) != TF_OK) return -1;
  while (s->x.mode == TF_STICK_PLUS && s->report.delassus > TF_R(1e-4) &&
         s->x.tick < 10000)
    CHECK(sim_step(s, LOCATED) == TF_OK);
  return s->x.mode == TF_STICK_PLUS ? (double)s->x.tick * (double)s->k.dt : -1;
}

/* "Whole sets of solutions evolve into the singularity", along the weak
 * eigenvector, and in finite time: from all of the lower sliding region up to r
 * = 0.22 m, 1.3 rad/s deep; farther down stick may leave it to slip. */
TEST(sliding_region_flows_into_the_two_fold_in_finite_time) {
  if (!IS_DOUBLE) SKIP("the digits of r next to the two-fold are too few");
  sim_t s = {.params = tf_scenes[0]->params};
  const paper_t p = paper_default();
  paper_twofold_t n;
  const real x[3] = {PAPER_R_STAR, paper_sing_v(&p, PAPER_R_STAR, PAPER_W_STAR),
                     PAPER_W_STAR};
  paper_twofold(&p, x, 1, &n);
  const real slope = n.weak[2] / n.weak[0];
  int seen = 0;
  s.params.dt = TF_R(1e-4);
  for (int i = 0; i < 200; i++) {
    const double r = tap_uniform(0.186, 0.22), w = tap_uniform(-1.3, -1.001);
    const double t = time_to_the_two_fold(&s, r, w);
    if (s.x.tick == 0) continue; /* no sliding region there */
    CHECK(t > 0 && t < 0.5);
    CHECK_NEAR(wide(s.x.r), x[0], 3e-5L);
    CHECK_NEAR(wide(s.x.w) - x[2], slope * (wide(s.x.r) - x[0]), 1e-6L);
    seen++;
  }
  CHECK_ABOVE(seen, 50);
}

/* "After leaving the escaping region trajectories go into an outward spiraling
 * motion": the |h| that each slip+ reaches grows until the windings end, at g <
 * 0, the side of the other sliding region. */
TEST(windings_grow_until_the_other_sliding_side) {
  if (!IS_DOUBLE) SKIP("the first windings are below the rounding of float");
  for (int i = 0; i < 6; i++) {
    const int place = i / 2;
    const tf_real_t from = TF_R(0.1858) - TF_R(0.0001) * (tf_real_t)place;
    const tf_real_t slip = i % 2 ? TF_R(-1e-9) : TF_R(1e-9);
    sim_t s = sim_of(&tf_scenes[0]->params);
    const tf_report_t *o = &s.report;
    s.x.r = from;
    s.x.w = TF_R(-1.037) - TF_R(10.2442529) * (from - (tf_real_t)PAPER_R_STAR);
    tf_real_t peak = 0, before = 0;
    int windings = 0;
    CHECK(tf_begin_with_slip(&s.k, &s.x, &s.u, slip, &s.report) == TF_OK);
    CHECK(o->mode == (i % 2 ? TF_SLIP_MINUS : TF_SLIP_PLUS));
    for (int k = 0; k < 5000 && tf_mode_is_slip(o->mode); k++) {
      if (o->mode == TF_SLIP_PLUS && o->slip.h > peak) peak = o->slip.h;
      const unsigned was = o->mode;
      CHECK(sim_step(&s, LOCATED) >= 0);
      if (was != TF_SLIP_PLUS || o->mode == TF_SLIP_PLUS) continue;
      CHECK(peak > before);
      before = peak;
      peak = 0;
      windings++;
    }
    CHECK_ABOVE(windings, 3);
    CHECK(!tf_mode_is_slip(o->mode) && o->slip.g <= 0);
  }
}
