/* The located step: order, branch, events, and what it does at its limits.
 * The reference is the long double orbit of tests/support/orbit.c. */
#include "common.h"
#include "orbit.h"

typedef struct {
  tf_params_t params;
  tf_machine_t machine;
  tf_state_t state;
} problem_t;

static problem_t begin(tf_params_t params, double r, double w, double h,
                       double t_end, long n, double tolerance) {
  problem_t p = {.params = params};
  tf_report_t report;
  p.params.dt = (tf_real_t)(t_end / (double)n);
  p.params.tolerance = (tf_real_t)tolerance;
  CHECK(tf_prepare(&p.machine, &p.params, NULL) == TF_OK);
  const tf_input_t u = tf_input_default(&p.machine);
  p.state =
      (tf_state_t){.r = (tf_real_t)r, .w = (tf_real_t)w, .mode = h > 0 ? 0 : 1};
  CHECK(tf_speed_for_slip(&p.machine, p.state.r, p.state.w, u.omega0,
                          (tf_real_t)h, &p.state.v) == TF_OK);
  CHECK(tf_begin(&p.machine, &p.state, &u, &report) == TF_OK);
  return p;
}

static problem_t chaos(double t_end, long n, double tolerance) {
  return begin(tf_scenes[0]->params, (double)ORBIT_R_START,
               (double)ORBIT_W_START, (double)ORBIT_H_START, t_end, n,
               tolerance);
}

/* Eight crossings of h = 0 in 2 s, all at |g| > 0.3 m/s. */
static problem_t crossings(double t_end, long n, double tolerance) {
  tf_params_t p = tf_scenes[0]->params;
  p.beta = TF_R(0.3);
  p.k2 = 30;
  p.mu = TF_R(0.2);
  return begin(p, 0.6, 0.5, -0.01, t_end, n, tolerance);
}

/* Problem `stickslip` of tests/data: sticks in between, far from g = 0. */
static problem_t stickslip(double t_end, long n, double tolerance) {
  tf_params_t p = tf_scenes[0]->params;
  p.beta = TF_R(0.2);
  p.k2 = 20;
  p.mu = 3;
  return begin(p, 0.5, -0.8, -0.01, t_end, n, tolerance);
}

/* Steps on; returns how many steps did not return TF_OK. */
static long advance(problem_t *p, long n) {
  const tf_input_t u = tf_input_default(&p->machine);
  tf_report_t report;
  long not_ok = 0;
  for (long i = 0; i < n; i++)
    not_ok += tf_step_located(&p->machine, &p->state, &u, &report) != TF_OK;
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
static void follow_tolerance(problem_t (*of)(double, long, double),
                             const tf_state_t *from, const tf_state_t *to,
                             double length, long n) {
  double before = INFINITY;
  for (int j = 0; j < TOLERANCES; j++) {
    double worst = 0;
    for (int k = 0; k < 16; k++) {
      problem_t p = of(length, n + k, tolerances[j]);
      if (from) p.state = *from;
      CHECK(advance(&p, n + k) == 0);
      CHECK(p.state.mode == to->mode);
      worst = fmax(worst, apart(&p.state, to));
    }
    printf("# %ld steps, tolerance %.0e: error %.2e\n", n, tolerances[j],
           worst);
    CHECK(worst <= 500 * tolerances[j] + 1e-12);
    CHECK(worst <= before / 5 || worst <= 10 * tolerances[j]);
    before = worst;
  }
}

TEST(located_error_follows_the_tolerance) {
  if (!IS_DOUBLE) SKIP("rounding of float hides the error of the series");
  const double t_end[2] = {0.25, 0.5}; /* a kink of F; two crossings of h = 0 */
  for (int i = 0; i < 2; i++) {
    problem_t exact = crossings(t_end[i], 20000, 0);
    advance(&exact, 20000);
    for (long n = 10; n <= 1000; n *= 10)
      follow_tolerance(crossings, NULL, &exact.state, t_end[i], n);
  }
}

TEST(located_steps_agree_across_crossings) {
  problem_t a = crossings(0.25, 100, 0), b = crossings(0.25, 400, 0);
  advance(&a, 100);
  advance(&b, 400);
  CHECK(apart(&a.state, &b.state) < (IS_DOUBLE ? 1e-9 : 2e-4));
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
    problem_t start = stickslip(cases[i].from, 20000, 0);
    advance(&start, 20000);
    CHECK(start.state.mode == cases[i].before);
    problem_t exact = stickslip(length, 20000, 0);
    exact.state = start.state;
    advance(&exact, 20000);
    CHECK(exact.state.mode == cases[i].after);
    for (long n = 4; check_tolerance && n <= 400; n *= 10)
      follow_tolerance(stickslip, &start.state, &exact.state, length, n);
    problem_t coarse = stickslip(length, 24, 1e-3);
    coarse.state = start.state;
    CHECK(advance(&coarse, 24) == 0);
    CHECK(apart(&coarse.state, &exact.state) <= 2e-3);
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
  problem_t fine = crossings(2, 200000, 0);
  for (int j = 0; j < STEPS; j++) {
    advance(&fine, 200000 / STEPS);
    exact[j] = fine.state;
  }
  double best = INFINITY, worst = 0;
  long short_of = 0;
  for (int i = 12; i <= 56; i++) {
    problem_t p = crossings(2, STEPS, pow(10, -0.25 * i));
    p.machine.segments = TF_LOCATED_MAX_SEGMENTS;
    double error = 0;
    for (int j = 0; j < STEPS; j++) {
      short_of += advance(&p, 1);
      error = fmax(error, apart(&p.state, &exact[j]));
    }
    worst = fmax(worst, error / best);
    best = fmin(best, error);
    CHECK(i < 36 || error <= 1e-6);
  }
  printf(
      "# %ld steps short of segments; error %.2e at best, a finer one up to "
      "%.0f times that of a coarser\n",
      short_of, best, worst);
  CHECK(short_of == 0);
  CHECK(best <= 1e-8);
  CHECK(worst <= 500);
}

/* The two-fold is passed within the tolerance, wherever in a step it falls. */
TEST(located_two_fold_in_one_step) {
  orbit_events_t ev;
  orbit_chaos(&ev);
  int met = 0;
  for (int trial = 0; trial < 150; trial++) {
    const long n = 200 + lrint(tap_uniform(0, 3000));
    problem_t p = chaos(2.06, n, IS_DOUBLE ? 1e-8 : 1e-5);
    const tf_input_t u = tf_input_default(&p.machine);
    tf_report_t report;
    int seen = 0;
    for (long i = 0; i < n; i++) {
      const tf_status_t status =
          tf_step_located(&p.machine, &p.state, &u, &report);
      CHECK(IS_DOUBLE ? status == TF_OK : status >= TF_OK);
      const double when = (double)p.machine.dt * (double)(i + 1);
      if (when < 1 || report.choices != 3 || seen++) continue;
      CHECK(fabs(when - (double)ev.twofold.t) <=
            (double)p.machine.dt + (IS_DOUBLE ? 1e-7 : 2e-2));
    }
    met += seen > 0;
  }
  printf("# met in %d of 150 runs\n", met);
  CHECK(met >= (IS_DOUBLE ? 150 : 100)); /* float may miss it by its error */
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
    const long n = lrint(pow(4000, at));
    problem_t p = chaos(1, n, 1e-8);
    const long not_ok = advance(&p, n);
    const double error = off(&p.state, want);
    CHECK(p.state.mode == TF_STICK_MINUS);
    if (!CHECK(error <= (IS_DOUBLE ? 1e-8 : 3e-4)))
      printf("#   %ld steps: error %.3g, %ld not ok\n", n, error, not_ok);
    worst = fmax(worst, error);
  }
  printf("# worst error at t = 1 over %d step sizes: %.2e\n", sizes, worst);
}

TEST(located_step_sizes_agree_just_before_the_two_fold) {
  if (!IS_DOUBLE) SKIP("float ends stick- up to 20 ms early or late");
  long double near_end[3];
  orbit_chaos_state(2.0L, near_end);
  for (long n = 200; n < 20000; n *= 3) {
    problem_t p = chaos(2, n, 1e-8);
    CHECK(advance(&p, n) == 0);
    CHECK(p.state.mode == TF_STICK_PLUS);
    CHECK_NEAR(off(&p.state, near_end), 0, 1e-7);
  }
}

/* Up to the two-fold and beyond it in another unit of mass: the same motion,
 * and no step that runs out of segments. */
TEST(located_takes_the_two_fold_in_any_unit_of_mass) {
  if (!IS_DOUBLE) SKIP("rounding of float moves the two-fold");
  for (int n = 300; n < 3000; n += 171) {
    tf_params_t params = tf_scenes[0]->params;
    params.dt = (tf_real_t)(2.2 / n);
    params.tolerance = TF_R(1e-9);
    tf_machine_t k[2];
    tf_state_t x[2];
    tf_report_t report;
    for (int heavy = 0; heavy < 2; heavy++) {
      k[heavy] = prepared(&params);
      CHECK(tf_scene_start(tf_scenes[0], &k[heavy], 1, &x[heavy], &report) ==
            TF_OK);
      const tf_input_t u = tf_input_default(&k[heavy]);
      for (int i = 0; i < n; i++)
        CHECK(tf_step_located(&k[heavy], &x[heavy], &u, &report) == TF_OK);
      params.m *= 16384, params.k2 *= 16384, params.mu *= 16384;
      params.c1 *= 16384, params.c2 *= 16384;
    }
    CHECK_NEAR(x[1].r, x[0].r, 1e-9L);
    CHECK_NEAR(x[1].v, x[0].v, 1e-9L);
    CHECK(x[1].mode == x[0].mode);
  }
}

/* The times at which the mode changes, up to the two-fold: each within the
 * step that holds the true one. */
TEST(located_events_are_in_the_right_step) {
  orbit_events_t ev;
  orbit_chaos(&ev);
  const long double when[4] = {ev.fall.t, ev.leave.t, ev.land.t, ev.twofold.t};
  const uint8_t before[4] = {TF_SLIP_PLUS, TF_STICK_MINUS, TF_SLIP_MINUS,
                             TF_STICK_PLUS};
  for (int trial = 0; trial < 6; trial++) {
    const long n = 700 + lrint(tap_uniform(0, 4000));
    problem_t p = chaos(2.1, n, 1e-9);
    const tf_input_t u = tf_input_default(&p.machine);
    tf_report_t report;
    int seen = 0;
    for (long i = 0; i < n && seen < 4; i++) {
      const uint8_t mode = p.state.mode;
      tf_step_located(&p.machine, &p.state, &u, &report);
      /* Three modes are consistent at the two-fold. */
      if (mode == p.state.mode && !(seen == 3 && report.choices == 3)) continue;
      CHECK(mode == before[seen]);
      const double dt = (double)p.machine.dt;
      const double slack = IS_DOUBLE ? 1e-7 : 2e-2;
      CHECK((double)i * dt <= (double)when[seen] + slack &&
            (double)when[seen] <= (double)(i + 1) * dt + slack);
      seen++;
    }
    CHECK(seen == 4);
  }
}

TEST(located_stick_is_exact) {
  problem_t p = chaos(10, 100000, 1e-8);
  const tf_input_t u = tf_input_default(&p.machine);
  tf_report_t report;
  int sticks = 0;
  for (long i = 0; i < 100000; i++) {
    CHECK(tf_step_located(&p.machine, &p.state, &u, &report) >= 0);
    if (report.mode != TF_STICK_PLUS && report.mode != TF_STICK_MINUS) continue;
    sticks++;
    CHECK(fabs((double)report.slip.h) <= 4 * (double)TF_REAL_EPSILON);
    /* The side of g = 0 is not known below its rounding. */
    if (fabs((double)report.slip.g) < 64 * (double)TF_REAL_EPSILON) continue;
    CHECK(fabs((double)report.residual) <= 8 * (double)TF_REAL_EPSILON);
  }
  CHECK(sticks > 50000);
}

/* A spring so stiff that no series converges: tf_step takes over, and its state
 * and report are the ones returned. */
TEST(located_falls_back_and_says_so) {
  tf_params_t stiff = tf_scenes[0]->params;
  stiff.k2 = TF_R(1e15);
  stiff.m = TF_R(1e-6);
  problem_t p = begin(stiff, 0.1, -0.9, 0.02, 1, 1, 1e-8);
  const tf_input_t u = tf_input_default(&p.machine);
  int fell_back = 0;
  for (int i = 0; i < 100; i++) {
    tf_state_t same = p.state;
    tf_report_t report, same_report;
    const tf_status_t s = tf_step_located(&p.machine, &p.state, &u, &report);
    const tf_status_t t = tf_step(&p.machine, &same, &u, &same_report);
    if (memcmp(&p.state, &same, sizeof same) != 0) continue;
    fell_back++;
    /* A step that tf_step finds too coarse is not told as one that it took. */
    CHECK(report.status == s && s == (t == TF_OK ? TF_FELL_BACK : t));
    CHECK(report.set == same_report.set &&
          report.force.F == same_report.force.F);
  }
  printf("# fell back %d times\n", fell_back);
  CHECK(fell_back > 50);
}

TEST(located_refuses_what_it_cannot_take) {
  const tf_tyre_law_t single[] = {TF_TYRE_TWO_PIECE, TF_TYRE_STRING,
                                  TF_TYRE_SMOOTH};
  problem_t p = chaos(1, 100, 1e-8);
  const tf_input_t u = tf_input_default(&p.machine);
  const tf_state_t start = p.state;
  tf_report_t report;
  for (int i = 0; i < 3; i++) {
    p.machine.tyre.law = single[i];
    CHECK(tf_step_located(&p.machine, &p.state, &u, &report) ==
          TF_BAD_PARAMETER);
    CHECK(!memcmp(&p.state, &start, sizeof start));
  }
  p.machine.tyre.law = TF_TYRE_JUMP;
  p.state.v = (tf_real_t)NAN;
  CHECK(tf_step_located(&p.machine, &p.state, &u, &report) == TF_BAD_STATE);
  p.state = start;
  p.state.mode = TF_NO_MODE;
  CHECK(tf_step_located(&p.machine, &p.state, &u, &report) == TF_BAD_STATE);
  CHECK(report.status == TF_BAD_STATE);
}

/* Where only one mode is consistent both schemes converge to the same motion,
 * so they agree to the error of the Moreau step: machines at random. */
TEST(located_agrees_with_moreau) {
  const int trials = IS_DOUBLE ? 150 : 40;
  int compared = 0, apart_count = 0;
  for (int i = 0; i < trials; i++) {
    tf_params_t q = tf_scenes[0]->params;
    q.gamma = (tf_real_t)tap_uniform(-3.1, 3.1);
    q.beta = (tf_real_t)tap_uniform(0.1, 0.5);
    q.kappa = (tf_real_t)tap_uniform(0.02, 0.6);
    q.d = (tf_real_t)tap_uniform(-1, 1);
    q.k2 = (tf_real_t)tap_uniform(0.5, 30);
    q.mu = (tf_real_t)tap_uniform(0.1, 2);
    problem_t a = begin(q, tap_uniform(0.1, 0.8), tap_uniform(-1.5, 1.5),
                        tap_uniform(-0.2, 0.2), 0.5, 50, 1e-8);
    problem_t b = a;
    const tf_input_t u = tf_input_default(&a.machine);
    tf_report_t report;
    int open = 0;
    q.dt = TF_R(2e-5);
    CHECK(tf_prepare(&b.machine, &q, NULL) == TF_OK);
    for (int j = 0; j < 50; j++) {
      CHECK(tf_step_located(&a.machine, &a.state, &u, &report) >= 0);
      open += report.choices > 1;
    }
    for (int j = 0; j < 25000; j++) {
      CHECK(tf_step(&b.machine, &b.state, &u, &report) >= 0);
      open += report.choices > 1;
    }
    if (open) continue; /* one mode of several was chosen, by either */
    compared++;
    const double scale = 1 + fabs((double)b.state.v) + fabs((double)b.state.w);
    apart_count +=
        apart(&a.state, &b.state) > (IS_DOUBLE ? 2e-3 : 5e-3) * scale;
  }
  printf("# %d motions compared, %d apart\n", compared, apart_count);
  CHECK(compared > trials / 2);
  CHECK(apart_count == 0);
}

/* A ramp of the turntable is part of the step: no first-order error. */
TEST(located_follows_a_ramp) {
  const tf_scene_t *scene = NULL;
  for (int i = 0; i < TF_SCENES; i++)
    if (tf_scenes[i]->knots) scene = tf_scenes[i];
  if (!CHECK(scene != NULL)) return;
  tf_state_t end[3];
  for (int i = 0; i < 3; i++) {
    const long n = i == 0 ? 150 : i == 1 ? 300 : 6000; /* to t = 3 s */
    problem_t p =
        begin(scene->params, scene->r, scene->omega, scene->h, 3, n, 1e-9);
    tf_report_t report;
    for (long j = 0; j < n; j++) {
      const tf_input_t u = tf_scene_input(
          scene, &p.machine, (tf_real_t)(3.0 * (double)(j + 1) / (double)n));
      CHECK(tf_step_located(&p.machine, &p.state, &u, &report) >= 0);
    }
    end[i] = p.state;
  }
  const double limit = IS_DOUBLE ? 1e-7 : 1e-3;
  CHECK_NEAR(apart(&end[0], &end[2]), 0, limit);
  CHECK_NEAR(apart(&end[1], &end[2]), 0, limit);
}
