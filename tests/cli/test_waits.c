/* Random exits of `diverge` wait as declared: a rest at h = g = 0 lasts for an
 * exponentially distributed time, from the instant at which the wheel comes
 * there to that of the exit, whatever dt is. The instant is found here by
 * bisection of the core's step; the band is that of Kolmogorov and Smirnov. */
#include "../../src/model/mechanics.h"
#include "../../tools/cli/diverge/diverge.h"
#include "sample.h"

#define RESTS 8000
#define BAND 1.95 /* / sqrt(n): passed by chance in one of 1000 seeds */
#define OFF 1e-5  /* [s], of the first step away from h = g = 0 */
#define ARRIVAL (IS_DOUBLE ? 1e-5 : 1.5e-3) /* [s], of the start of a rest */

static cli_job_t job;
static cli_motion_t motion;
static double waits[RESTS];

/* When the motion comes to rest after a state, within a step. In float shorter
 * steps are lost, and one of some hundred motions then passes by. */
static double time_of_rest(tf_state_t state) {
  tf_machine_t k = job.machine;
  const tf_input_t input = tf_input_default(&k);
  double time = 0;
  for (double length = (double)k.dt; length > (IS_DOUBLE ? 1e-7 : 2e-4);) {
    tf_report_t report;
    tf_state_t after = state;
    set_step_length(&k, (tf_real_t)(length /= 2));
    CHECK(tf_step_located(&k, &after, &input, &report) >= 0);
    if (after.mode == TF_PINNED) continue;
    time += length;
    state = after;
  }
  return time;
}

static void begin(double dt) {
  static cli_args_t args = {.mechanism = CLI_BY_RANDOM, .patience = 1000};
  tf_params_t params = tf_scenes[0]->params;
  job.args = &args;
  params.dt = (tf_real_t)dt;
  job.setup.params = params;
  params.rule = TF_RULE_RANDOM;
  params.rate = 0;
  job.at_two_fold = true;
  job.machine = prepared(&params);
  job.wide = cli_widen(&job.machine);
  CHECK(cli_find_two_fold(&job.machine, &job.two_fold));
  CHECK(cli_canard_solve(&job.wide, &job.two_fold, &job.canard) == NULL);
  args.seed = tap_bits();
  cli_motion_begin(&motion, &job, 0);
}

/* Kolmogorov and Smirnov's distance of the waits from the law. */
static int ascending(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}
static double distance(int n, double rate) {
  double most = 0;
  qsort(waits, (size_t)n, sizeof *waits, ascending);
  for (int i = 0; i < n; i++) {
    const double law = 1 - exp(-rate * fmax(waits[i], 0));
    most = fmax(most, fmax(law - (double)i / n, (i + 1.0) / n - law));
  }
  return most;
}

static void judge(double dt) {
  int n = 0, far = 0;
  double came = 0;
  begin(dt);
  while (n < samples(RESTS)) {
    const tf_state_t from = motion.state;
    const double t = motion.t;
    if (cli_motion_advance(&motion))
      CHECK(motion.cycle.outcome == CLI_CYCLE_RETURNED);
    const bool rested = from.mode == TF_PINNED;
    if (motion.state.mode == TF_PINNED && !rested) {
      came = t + time_of_rest(from);
      far += fabs(motion.t - came) > ARRIVAL;
    } else if (rested && motion.state.mode != TF_PINNED) {
      waits[n++] = motion.t - OFF - came;
    }
  }
  const double D = distance(n, (double)job.setup.params.rate);
  printf("# dt %g s: %d rests, distance %.4f, %d far off\n", dt, n, D, far);
  CHECK(D < BAND / sqrt(n));
  CHECK(far <= (IS_DOUBLE ? 0 : n / 200));
}

TEST(a_rest_lasts_as_its_rate_says_whatever_dt_is) {
  static const double dt[] = {0.005, 0.02, 0.05, 0.1};
  for (int i = 0; i < 4; i++) judge(dt[i]);
}
