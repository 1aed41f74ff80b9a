/* The located step: order, branch, events, and what it does at its limits.
 * The reference is the long double orbit of tests/support/orbit.c. */
#include "orbit.h"
#include "scene_named.h"
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
  return begin(tf_scenes[0]->params, (double)ORBIT_R_START,
               (double)ORBIT_W_START, (double)ORBIT_H_START, t_end, n,
               tolerance);
}

/* Eight crossings of h = 0 in 2 s, all at |g| > 0.3 m/s. */
static sim_t crossings(double t_end, int n, double tolerance) {
  tf_params_t p = tf_scenes[0]->params;
  p.beta = TF_R(0.3);
  p.k2 = 30;
  p.mu = TF_R(0.2);
  return begin(p, 0.6, 0.5, -0.01, t_end, n, tolerance);
}

/* Problem `stickslip` of tests/data: sticks in between, far from g = 0. */
static sim_t stickslip(double t_end, int n, double tolerance) {
  tf_params_t p = tf_scenes[0]->params;
  p.beta = TF_R(0.2);
  p.k2 = 20;
  p.mu = 3;
  return begin(p, 0.5, -0.8, -0.01, t_end, n, tolerance);
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

static double off(const tf_state_t *x, const long double want[3]) {
  return (double)fmaxl(fabsl((long double)x->r - want[0]),
                       fmaxl(fabsl((long double)x->v - want[1]),
                             fabsl((long double)x->w - want[2])));
}

/* Tolerances, and what the errors of steps that keep to them may be. */
static const double tolerances[] = {1e-5, 1e-7, 1e-9, 1e-11};
enum { TOLERANCES = 4 };

/* Errors of some motion of a length at each tolerance: the worst of several
 * step sizes near by, because an event falls anywhere in a step. They fall with
 * the tolerance, and stay near it. */
static void follow_tolerance(sim_t (*of)(double, int, double),
                             const tf_state_t *from, const tf_state_t *to,
                             double length, int n) {
  double before = INFINITY;
  for (int j = 0; j < TOLERANCES; j++) {
    double worst = 0;
    for (int k = 0; k < 16; k++) {
      sim_t p = of(length, n + k, tolerances[j]);
      if (from) p.x = *from;
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
      follow_tolerance(crossings, NULL, &exact.x, t_end[i], n);
  }
}

TEST(located_steps_agree_across_crossings) {
  sim_t a = crossings(0.25, 100, 0), b = crossings(0.25, 400, 0);
  advance(&a, 100);
  advance(&b, 400);
  CHECK(apart(&a.x, &b.x) < (IS_DOUBLE ? 1e-9 : 2e-4));
}

/* The same across an entry into stick (0.674997 s) and an exit (0.695274 s),
 * each alone: from a state before it to a time behind it. */
static void across_stick(int check_tolerance) {
  static const struct {
    double from, to;
    uint8_t before, after;
  } cases[] = {{0.62, 0.685, TF_SLIP_PLUS, TF_STICK_PLUS},
               {0.68, 0.72, TF_STICK_PLUS, TF_SLIP_PLUS}};
  for (int i = 0; i < 2; i++) {
    const double length = cases[i].to - cases[i].from;
    sim_t start = stickslip(cases[i].from, 20000, 0);
    advance(&start, 20000);
    CHECK(start.x.mode == cases[i].before);
    sim_t exact = stickslip(length, 20000, 0);
    exact.x = start.x;
    advance(&exact, 20000);
    CHECK(exact.x.mode == cases[i].after);
    for (int n = 4; check_tolerance && n <= 400; n *= 10)
      follow_tolerance(stickslip, &start.x, &exact.x, length, n);
    sim_t coarse = stickslip(length, 24, 1e-3);
    coarse.x = start.x;
    CHECK(advance(&coarse, 24) == 0);
    CHECK(apart(&coarse.x, &exact.x) <= 2e-3);
  }
}

TEST(located_tolerance_holds_across_stick) {
  if (!IS_DOUBLE) SKIP("rounding of float hides the error of the series");
  across_stick(1);
}

TEST(located_steps_agree_across_stick) { across_stick(0); }

/* A finer tolerance is no worse than a coarser one, but for a factor, down to
 * the finest. Steps of 0.1 s, of 20 and more segments. */
TEST(located_finer_tolerance_is_no_worse) {
  if (!IS_DOUBLE) SKIP("rounding of float hides the error of the series");
  enum { STEPS = 20 };
  tf_state_t exact[STEPS];
  sim_t fine = crossings(2, 200000, 0);
  for (int j = 0; j < STEPS; j++) {
    advance(&fine, 200000 / STEPS);
    exact[j] = fine.x;
  }
  double best = INFINITY, worst = 0;
  int short_of = 0;
  for (int i = 12; i <= 56; i++) {
    sim_t p = crossings(2, STEPS, pow(10, -0.25 * i));
    p.k.segments = TF_LOCATED_MAX_SEGMENTS;
    double error = 0;
    for (int j = 0; j < STEPS; j++) {
      short_of += advance(&p, 1);
      error = fmax(error, apart(&p.x, &exact[j]));
    }
    worst = fmax(worst, error / best);
    best = fmin(best, error);
    CHECK(i < 36 || error <= 1e-6);
  }
  printf(
      "# %d steps short of segments; error %.2e at best, a finer one up to "
      "%.0f times that of a coarser\n",
      short_of, best, worst);
  CHECK(short_of == 0);
  CHECK(best <= 1e-8);
  CHECK(worst <= 500);
}

/* The reference at t = 1 is past codimension two and the third of three
 * consistent modes: every step size, from one step to 4000, has to be there. */
TEST(located_branch_is_independent_of_the_step_size) {
  long double want[3];
  orbit_chaos_state(1.0L, want);
  const int sizes = IS_DOUBLE ? 120 : 60;
  double worst = 0;
  for (int i = 0; i < sizes; i++) {
    const double at = (i + tap_uniform(0, 1)) / sizes;
    const int n = (int)lrint(pow(4000, at));
    sim_t p = chaos(1, n, 1e-8);
    const int not_ok = advance(&p, n);
    const double error = off(&p.x, want);
    CHECK(p.x.mode == TF_STICK_MINUS);
    if (!CHECK(error <= (IS_DOUBLE ? 1e-8 : 3e-4)))
      printf("#   %d steps: error %.3g, %d not ok\n", n, error, not_ok);
    worst = fmax(worst, error);
  }
  printf("# worst error at t = 1 over %d step sizes: %.2e\n", sizes, worst);
}

TEST(located_step_sizes_agree_just_before_the_two_fold) {
  if (!IS_DOUBLE) SKIP("float ends stick- up to 20 ms early or late");
  long double near_end[3];
  orbit_chaos_state(2.0L, near_end);
  for (int n = 200; n < 20000; n *= 3) {
    sim_t p = chaos(2, n, 1e-8);
    CHECK(advance(&p, n) == 0);
    CHECK(p.x.mode == TF_STICK_PLUS);
    CHECK_NEAR(off(&p.x, near_end), 0, 1e-7);
  }
}

/* Up to the two-fold and beyond it in another unit of mass: the same motion,
 * and no step that runs out of segments. */
TEST(located_takes_the_two_fold_in_any_unit_of_mass) {
  if (!IS_DOUBLE) SKIP("rounding of float moves the two-fold");
  for (int n = 300; n < 3000; n += 171) {
    sim_t p = chaos(2.2, n, 1e-9), heavy;
    tf_params_t q = p.params;
    q.m *= 16384, q.k2 *= 16384, q.mu *= 16384, q.c1 *= 16384, q.c2 *= 16384;
    heavy = begin(q, (double)ORBIT_R_START, (double)ORBIT_W_START,
                  (double)ORBIT_H_START, 2.2, n, 1e-9);
    CHECK(advance(&p, n) == 0 && advance(&heavy, n) == 0);
    CHECK_NEAR(heavy.x.r, p.x.r, 1e-9L);
    CHECK_NEAR(heavy.x.v, p.x.v, 1e-9L);
    CHECK(heavy.x.mode == p.x.mode);
  }
}

/* The times at which the mode changes, up to the two-fold and including it:
 * each within the step that holds the true one, wherever in it that falls. */
TEST(located_events_are_in_the_right_step) {
  orbit_events_t ev;
  orbit_chaos(&ev);
  const long double when[4] = {ev.fall.t, ev.leave.t, ev.land.t, ev.twofold.t};
  const uint8_t before[4] = {TF_SLIP_PLUS, TF_STICK_MINUS, TF_SLIP_MINUS,
                             TF_STICK_PLUS};
  const double slack = IS_DOUBLE ? 1e-7 : 2e-2;
  const int trials = samples(150);
  int met = 0;
  for (int trial = 0; trial < trials; trial++) {
    const int n = 200 + (int)lrint(tap_uniform(0, 4500));
    sim_t p = chaos(2.1, n, IS_DOUBLE ? 1e-8 : 1e-5);
    int seen = 0;
    for (int i = 0; i < n && seen < 4; i++) {
      const uint8_t mode = p.x.mode;
      const tf_status_t status = sim_step(&p, LOCATED);
      CHECK(IS_DOUBLE ? status == TF_OK : status >= TF_OK);
      /* Three modes are consistent at the two-fold. */
      if (mode == p.x.mode && !(seen == 3 && p.report.choices == 3)) continue;
      CHECK(mode == before[seen]);
      const double dt = (double)p.k.dt;
      CHECK((double)i * dt <= (double)when[seen] + slack &&
            (double)when[seen] <= (double)(i + 1) * dt + slack);
      seen++;
    }
    CHECK(seen >= 3);
    met += seen == 4;
  }
  printf("# two-fold met in %d of %d runs\n", met, trials);
  CHECK(met >= (IS_DOUBLE ? trials : trials * 2 / 3)); /* or missed by error */
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

/* Where only one mode is consistent both schemes converge to the same motion,
 * so they agree to the error of the Moreau step: machines at random. */
TEST(located_agrees_with_moreau) {
  const int trials = samples(IS_DOUBLE ? 150 : 40);
  int compared = 0, apart_count = 0;
  for (int i = 0; i < trials; i++) {
    tf_params_t q = moderate_params();
    q.beta = uniform(0.1, 0.5);
    sim_t a = begin(q, tap_uniform(0.1, 0.8), tap_uniform(-1.5, 1.5),
                    tap_uniform(-0.2, 0.2), 0.5, 50, 1e-8);
    sim_t b = a;
    int open = 0;
    b.params.dt = TF_R(2e-5);
    CHECK(sim_prepare(&b) == TF_OK);
    for (int j = 0; j < 50; j++) {
      CHECK(sim_step(&a, LOCATED) >= 0);
      open += a.report.choices > 1;
    }
    for (int j = 0; j < 25000; j++) {
      CHECK(sim_step(&b, MOREAU) >= 0);
      open += b.report.choices > 1;
    }
    if (open) continue; /* one mode of several was chosen, by either */
    compared++;
    const double scale = 1 + fabs((double)b.x.v) + fabs((double)b.x.w);
    apart_count += apart(&a.x, &b.x) > (IS_DOUBLE ? 2e-3 : 5e-3) * scale;
  }
  printf("# %d motions compared, %d apart\n", compared, apart_count);
  CHECK(compared > trials / 2);
  CHECK(apart_count == 0);
}

/* A ramp of the turntable is part of the step: no first-order error. */
TEST(located_follows_a_ramp) {
  const tf_scene_t *scene = scene_named("driven");
  tf_state_t end[3];
  for (int i = 0; i < 3; i++) {
    const int n = i == 0 ? 150 : i == 1 ? 300 : 6000; /* to t = 3 s */
    sim_t p =
        begin(scene->params, scene->r, scene->omega, scene->h, 3, n, 1e-9);
    for (int j = 1; j <= n; j++) {
      p.u = tf_scene_input(scene, &p.k, (tf_real_t)(3.0 * j / n));
      CHECK(sim_step(&p, LOCATED) >= 0);
    }
    end[i] = p.x;
  }
  const double limit = IS_DOUBLE ? 1e-7 : 1e-3;
  CHECK_NEAR(apart(&end[0], &end[2]), 0, limit);
  CHECK_NEAR(apart(&end[1], &end[2]), 0, limit);
}
