/* The located step: its error beside its tolerance, stick, and what it does at
 * its limits. test_reference.c has its events and branches. */
#include "sim.h"

static sim_t begin(tf_params_t params, double r, double w, double h,
                   double t_end, int n, double tolerance) {
  sim_t p = {.params = params};
  p.params.dt = (tf_real_t)(t_end / n);
  p.params.tolerance = (tf_real_t)tolerance;
  CHECK(sim_place(&p, r, w, h, h > 0 ? TF_SLIP_PLUS : TF_SLIP_MINUS) == TF_OK);
  return p;
}

static sim_t chaos(double t_end, int n, double tolerance) {
  const tf_scene_t *scene = tf_scenes[0];
  return begin(scene->params, (double)scene->r, (double)scene->omega,
               (double)scene->h, t_end, n, tolerance);
}

/* Eight crossings of h = 0 in 2 s, all at |g| > 0.3 m/s. */
static sim_t crossings(double t_end, int n, double tolerance) {
  tf_params_t p = tf_scenes[0]->params;
  p.beta = TF_R(0.3);
  p.k2 = 30;
  p.mu = TF_R(0.2);
  return begin(p, 0.6, 0.5, -0.01, t_end, n, tolerance);
}

/* Steps on; returns how many steps did not return TF_OK. */
static int advance(sim_t *p, int n) {
  int not_ok = 0;
  for (int i = 0; i < n; i++) not_ok += sim_step(p, LOCATED) != TF_OK;
  return not_ok;
}

static double apart(const tf_state_t *a, const tf_state_t *b) {
  return fmax(fabs((double)a->r - (double)b->r),
              fmax(fabs((double)a->v - (double)b->v),
                   fabs((double)a->w - (double)b->w)));
}

/* Tolerances, and what the errors of steps that keep to them may be. */
static const double tolerances[] = {1e-5, 1e-7, 1e-9, 1e-11};
enum { TOLERANCES = 4 };

/* Errors of some time of the crossings at each tolerance: the worst of several
 * step sizes near by, because an event falls anywhere in a step. They fall with
 * the tolerance, and stay near it. */
static void follow_tolerance(const tf_state_t *to, double length, int n) {
  double before = INFINITY;
  for (int j = 0; j < TOLERANCES; j++) {
    double worst = 0;
    for (int k = 0; k < 16; k++) {
      sim_t p = crossings(length, n + k, tolerances[j]);
      CHECK(advance(&p, n + k) == 0);
      CHECK(p.x.mode == to->mode);
      worst = fmax(worst, apart(&p.x, to));
    }
    printf("# %d steps, tolerance %.0e: error %.2e\n", n, tolerances[j], worst);
    CHECK(worst <= 500 * tolerances[j] + 1e-12);
    CHECK(worst <= before / 5 || worst <= 10 * tolerances[j]);
    before = worst;
  }
}

TEST(located_error_follows_the_tolerance) {
  if (!IS_DOUBLE) SKIP("rounding of float hides the error of the series");
  const double t_end[2] = {0.25, 0.5}; /* a kink of F; two crossings of h = 0 */
  for (int i = 0; i < 2; i++) {
    sim_t exact = crossings(t_end[i], 20000, 0);
    advance(&exact, 20000);
    for (int n = 10; n <= 1000; n *= 10)
      follow_tolerance(&exact.x, t_end[i], n);
  }
}

TEST(located_stick_is_exact) {
  sim_t p = chaos(10, 100000, 1e-8);
  const tf_report_t *o = &p.report;
  int sticks = 0;
  for (int i = 0; i < 100000; i++) {
    CHECK(sim_step(&p, LOCATED) >= 0);
    if (o->mode != TF_STICK_PLUS && o->mode != TF_STICK_MINUS) continue;
    sticks++;
    CHECK(fabs((double)o->slip.h) <= 4 * (double)TF_REAL_EPSILON);
    /* The side of g = 0 is not known below its rounding. */
    if (fabs((double)o->slip.g) < 64 * (double)TF_REAL_EPSILON) continue;
    CHECK(fabs((double)o->residual) <= 8 * (double)TF_REAL_EPSILON);
  }
  CHECK(sticks > 50000);
}

/* A spring so stiff that no series converges: tf_step takes over, and its state
 * and report are the ones returned. */
TEST(located_falls_back_and_says_so) {
  tf_params_t stiff = tf_scenes[0]->params;
  stiff.k2 = TF_R(1e15);
  stiff.m = TF_R(1e-6);
  sim_t p = begin(stiff, 0.1, -0.9, 0.02, 1, 1, 1e-8);
  int fell_back = 0;
  for (int i = 0; i < 100; i++) {
    sim_t same = p;
    const tf_status_t s = sim_step(&p, LOCATED), t = sim_step(&same, MOREAU);
    if (memcmp(&p.x, &same.x, sizeof p.x) != 0) continue;
    fell_back++;
    /* A step that tf_step finds too coarse is not told as one that it took. */
    CHECK(p.report.status == s && s == (t == TF_OK ? TF_FELL_BACK : t));
    CHECK(p.report.set == same.report.set &&
          p.report.force.F == same.report.force.F);
  }
  printf("# fell back %d times\n", fell_back);
  CHECK(fell_back > 50);
}

TEST(located_refuses_what_it_cannot_take) {
  const tf_tyre_law_t single[] = {TF_TYRE_TWO_PIECE, TF_TYRE_STRING,
                                  TF_TYRE_SMOOTH};
  sim_t p = chaos(1, 100, 1e-8);
  const tf_state_t start = p.x;
  for (int i = 0; i < 3; i++) {
    p.k.tyre.law = single[i];
    CHECK(sim_step(&p, LOCATED) == TF_BAD_PARAMETER);
    CHECK(!memcmp(&p.x, &start, sizeof start));
  }
}
