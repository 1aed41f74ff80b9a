/* How the simulated motion converges to the true one. */
#include "common.h"
#include "resolved.h"

static double max3(double a, double b, double c) {
  return fmax(fabs(a), fmax(fabs(b), fabs(c)));
}

/* State of `chaos` at t = 1, past codimension two and in stick-: computed by
 * an event-driven solver at relative tolerance 1e-12, confirmed by the
 * independent one in tests/support. */
static const double at_one[3] = {0.185676357258, 0.010298364853,
                                 -0.987353474328};

static double chaos_error(long n, uint8_t *mode) {
  tf_params_t p = tf_scenes[0]->params;
  tf_machine_t machine;
  tf_state_t x = {.r = tf_scenes[0]->r, .w = tf_scenes[0]->omega};
  tf_report_t report;
  p.dt = (tf_real_t)(1.0 / (double)n);
  CHECK(tf_prepare(&machine, &p, NULL) == TF_OK);
  const tf_input_t u = tf_input_default(&machine);
  tf_speed_for_slip(&machine, x.r, x.w, u.omega0, tf_scenes[0]->h, &x.v);
  x.mode = TF_SLIP_PLUS;
  CHECK(tf_begin(&machine, &x, &u, &report) == TF_OK);
  CHECK(x.mode == TF_SLIP_PLUS);
  for (long i = 0; i < n; i++)
    CHECK(ok_to_resolution(tf_step(&machine, &x, &u, &report)));
  *mode = x.mode;
  return max3((double)x.r - at_one[0], (double)x.v - at_one[1],
              (double)x.w - at_one[2]);
}

/* Through h = g = 0 several modes are consistent and a careless choice lands on
 * another branch at two step sizes in ten. Every step size of a grid with
 * random offsets must end on the same branch, none left out. In float the
 * rounding of the state adds to the bound: per step at most eps |w|, with
 * random signs sqrt(n) eps, times the growth of errors over the second. */
TEST(branch_is_independent_of_the_step_size) {
  const int sizes = 80;
  double worst = 0;
  for (int i = 0; i < sizes; i++) {
    const double at = (i + tap_uniform(0, 1)) / sizes;
    const double dt = 4e-3 * pow(IS_DOUBLE ? 1e-6 / 4e-3 : 1e-5 / 4e-3, at);
    const long n = lrint(1 / dt);
    uint8_t mode;
    const double error = chaos_error(n, &mode);
    const double rounding =
        IS_DOUBLE ? 0 : 40 * sqrt((double)n) * (double)TF_REAL_EPSILON;
    CHECK(mode == TF_STICK_MINUS);
    if (!CHECK(error <= 0.05 / (double)n + rounding))
      printf("#   dt = %.6g: error %.3g = %.3g dt\n", 1.0 / (double)n, error,
             error * (double)n);
    worst = fmax(worst, error * (double)n);
  }
  printf("# worst error over %d step sizes: %.4f dt\n", sizes, worst);
}

/* The whole cycle of `chaos` up to the two-fold, event by event: entry of
 * stick- at codimension two, its end at the turning point of the spring, entry
 * of the lower sliding region, arrival at the two-fold (A changes sign). Times
 * converge with the step; stick- ends at h = g = 0, where a step ends early; at
 * the two-fold the sliding field is 0/0 and the constant is larger. */
TEST(cycle_converges_up_to_the_two_fold) {
  static const double want[4] = {0.00940986875, 1.90812038317, 1.922602663,
                                 2.0462756096};
  static const double bound[4] = {2, 2, 3, 20};
  static const double dts[] = {1e-3, 3.7e-4, 1e-4, 2.3e-5, 1e-5};
  const int sizes = IS_DOUBLE ? 5 : 3;
  const double rounding = IS_DOUBLE ? 1e-6 : 5e-3;
  for (int i = 0; i < sizes; i++) {
    tf_params_t p = tf_scenes[0]->params;
    tf_machine_t machine;
    tf_state_t x = {.r = tf_scenes[0]->r, .w = tf_scenes[0]->omega};
    tf_report_t report;
    int event = 0;
    p.dt = (tf_real_t)dts[i];
    CHECK(tf_prepare(&machine, &p, NULL) == TF_OK);
    const tf_input_t u = tf_input_default(&machine);
    tf_speed_for_slip(&machine, x.r, x.w, u.omega0, tf_scenes[0]->h, &x.v);
    x.mode = TF_SLIP_PLUS;
    CHECK(tf_begin(&machine, &x, &u, &report) == TF_OK);
    for (long n = 1; (double)n * dts[i] < 2.1 && event < 4; n++) {
      const uint8_t before = x.mode;
      CHECK(ok_to_resolution(tf_step(&machine, &x, &u, &report)));
      const int now =
          event == 0   ? x.mode == TF_STICK_MINUS
          : event == 1 ? before == TF_STICK_MINUS && x.mode != before
          : event == 2 ? before == TF_SLIP_MINUS && x.mode == TF_STICK_PLUS
                       : report.delassus <= 0;
      if (!now) continue;
      CHECK_NEAR((double)n * dts[i], want[event],
                 bound[event] * dts[i] + rounding);
      event++;
    }
    CHECK(event == 4);
  }
}

/* Classical Runge-Kutta on the paper's own equations, in long double. */
static void true_slip(const paper_t *p, long double x[3], long double t) {
  const int n = 20000;
  const long double dt = t / n;
  for (int i = 0; i < n; i++) {
    long double k[4][3], y[3], F, M;
    for (int stage = 0; stage < 4; stage++) {
      const long double c = stage == 0 ? 0 : stage == 3 ? dt : dt / 2;
      for (int j = 0; j < 3; j++)
        y[j] = x[j] + (stage ? c * k[stage - 1][j] : 0);
      paper_friction(p, paper_h(p, y), paper_g(p, y), &F, &M);
      paper_rhs_time(p, y, F, M, k[stage]);
    }
    for (int j = 0; j < 3; j++)
      x[j] += dt / 6 * (k[0][j] + 2 * k[1][j] + 2 * k[2][j] + k[3][j]);
  }
}

static double slip_error(double theta, long n, const long double end[3]) {
  tf_params_t p = tf_scenes[0]->params;
  tf_machine_t machine;
  tf_report_t report;
  tf_state_t x = {.r = (tf_real_t)0.18, .w = (tf_real_t)-0.5};
  p.theta = (tf_real_t)theta;
  p.dt = (tf_real_t)(0.3 / (double)n);
  CHECK(tf_prepare(&machine, &p, NULL) == TF_OK);
  const tf_input_t u = tf_input_default(&machine);
  tf_speed_for_slip(&machine, x.r, x.w, u.omega0, (tf_real_t)0.5, &x.v);
  x.mode = TF_NO_MODE;
  CHECK(tf_begin(&machine, &x, &u, &report) == TF_OK);
  for (long i = 0; i < n; i++) {
    CHECK(ok_to_resolution(tf_step(&machine, &x, &u, &report)));
    CHECK(x.mode == TF_SLIP_PLUS);
  }
  return max3((double)(x.r - end[0]), (double)(x.v - end[1]),
              (double)(x.w - end[2]));
}

/* Slope of log error over log dt by least squares on a geometric grid. */
static double slope(double theta, const long double end[3]) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const int points = 5;
  for (int i = 0; i < points; i++) {
    const long n = 37L << (i + (IS_DOUBLE ? 2 : 0));
    const double lx = log(0.3 / (double)n), ly = log(slip_error(theta, n, end));
    sx += lx, sy += ly, sxx += lx * lx, sxy += lx * ly;
  }
  return (points * sxy - sx * sy) / (points * sxx - sx * sx);
}

TEST(smooth_slip_order_of_convergence) {
  paper_t paper;
  paper_default(&paper);
  long double x[3] = {0.18L, 0, -0.5L};
  x[1] = paper_v_at(&paper, x[0], x[2], 0.5L);
  true_slip(&paper, x, 0.3L);
  CHECK(paper_h(&paper, x) > 0.01L); /* slip throughout */
  const double first = slope(1, x), second = slope(0.5, x);
  printf("# order with theta = 1: %.3f, with theta = 1/2: %.3f\n", first,
         second);
  CHECK_NEAR(first, 1, 0.1);
  CHECK_NEAR(second, 2, IS_DOUBLE ? 0.1 : 0.4);
}

/* Motion in stick for 1 s in 100, 200 and 400 steps: how far the first two
 * ends are apart, and the last two. */
static void stick_differences(double *coarse, double *fine) {
  double end[3][3];
  for (int i = 0; i < 3; i++) {
    tf_params_t p = tf_scenes[0]->params;
    tf_machine_t machine;
    tf_report_t report;
    tf_state_t x = {.r = (tf_real_t)0.18, .w = (tf_real_t)-0.99};
    const long n = 100L << i;
    p.dt = (tf_real_t)(1.0 / (double)n);
    CHECK(tf_prepare(&machine, &p, NULL) == TF_OK);
    const tf_input_t u = tf_input_default(&machine);
    tf_speed_for_slip(&machine, x.r, x.w, u.omega0, 0, &x.v);
    x.mode = TF_STICK_MINUS;
    CHECK(tf_begin(&machine, &x, &u, &report) == TF_OK);
    for (long j = 0; j < n; j++) {
      CHECK(ok_to_resolution(tf_step(&machine, &x, &u, &report)));
      CHECK(x.mode == TF_STICK_MINUS);
    }
    end[i][0] = (double)x.r, end[i][1] = (double)x.v, end[i][2] = (double)x.w;
  }
  *coarse =
      max3(end[0][0] - end[1][0], end[0][1] - end[1][1], end[0][2] - end[1][2]);
  *fine =
      max3(end[1][0] - end[2][0], end[1][1] - end[2][1], end[1][2] - end[2][2]);
}

/* Stick is as accurate: Richardson's quotient from three step sizes. */
TEST(stick_order_of_convergence) {
  if (!IS_DOUBLE) SKIP("rounding of float is as large as the differences");
  double coarse, fine;
  stick_differences(&coarse, &fine);
  printf("# quotient of differences %.3f, second order has 4\n", coarse / fine);
  CHECK_NEAR(coarse / fine, 4, 0.2);
}

TEST(stick_depends_little_on_the_step_size) {
  double coarse, fine;
  stick_differences(&coarse, &fine);
  CHECK(coarse < 1e-5);
}

/* A constant rate of exit means the same mean time in an escaping stick at
 * every step size: exponential, so mean = deviation = 1/rate. */
TEST(random_exit_rate_is_independent_of_dt) {
  const double rate = 2000;
  const int samples = 4000;
  for (int i = 0; i < 3; i++) {
    tf_params_t p = tf_scenes[0]->params;
    tf_machine_t machine;
    double sum = 0;
    int plus = 0;
    p.rule = TF_RULE_RANDOM;
    p.rate = (tf_real_t)rate;
    p.dt = (tf_real_t)(1e-4 / (1 << 2 * i));
    CHECK(tf_prepare(&machine, &p, NULL) == TF_OK);
    const tf_input_t u = tf_input_default(&machine);
    for (int n = 0; n < samples; n++) {
      tf_state_t x = {.r = (tf_real_t)0.18, .w = (tf_real_t)-1.015};
      tf_report_t report;
      x.seed = (uint32_t)n;
      tf_speed_for_slip(&machine, x.r, x.w, u.omega0, 0, &x.v);
      x.mode = TF_STICK_PLUS;
      CHECK(tf_begin(&machine, &x, &u, &report) == TF_OK);
      if (!CHECK(x.mode == TF_STICK_PLUS && report.choices == 3)) return;
      while (x.mode == TF_STICK_PLUS && x.tick < 1000000)
        CHECK(ok_to_resolution(tf_step(&machine, &x, &u, &report)));
      sum += ((double)x.tick - 0.5) * (double)p.dt;
      plus += x.mode == TF_SLIP_PLUS;
    }
    printf("# dt = %g: mean stay %.4g / rate, share of slip+ %.3f\n",
           (double)p.dt, sum / samples * rate, (double)plus / samples);
    /* four standard errors; the stay is known to half a step */
    CHECK_NEAR(sum / samples * rate, 1, 4 / sqrt(samples) + 0.004);
    CHECK_NEAR((double)plus / samples, 0.5, 2 / sqrt(samples));
  }
}
