/* The stick behind a two-fold that `diverge` follows: for designs of case 1 of
 * the paper, from the whole window of its figure 4, it is computed or its
 * failure has a name; where it is computed the core says that it is stick, in
 * the escaping region, and that it comes from the two-fold. */
#include "../../tools/cli/diverge/diverge.h"
#include "sample.h"

static tf_machine_t machine;
static cli_wide_t in_double; /* the same */
static cli_two_fold_t through;
static cli_canard_t canard;
static double end; /* of the stay that is judged: the last node [s] */

/* Whether scene `chaos` with a two-fold at (r, w) instead of its own has one
 * of case 1 there; puts it into `machine`. */
static bool is_case_1(double r, double w) {
  tf_params_t params = tf_scenes[0]->params;
  const tf_machine_t scene = prepared(&params);
  const tf_input_t input = tf_input_default(&scene);
  tf_design_t design;
  if (tf_design_two_fold(&scene, &input, (tf_real_t)r, (tf_real_t)w, &design) !=
          TF_OK ||
      design.two_fold.paper_case != 1)
    return false;
  params.kappa = design.kappa;
  params.k2 = design.k2;
  if (tf_prepare(&machine, &params, NULL) != TF_OK) return false;
  in_double = cli_widen(&machine);
  return true;
}

/* The canard against the core at a time after the two-fold. */
static void judge_at(double t) {
  const double dt = 1e-3 * fmin(t, end - t);
  cli_point_t before, at, after;
  tf_surface_t surface;
  double reached = 0;
  CHECK(cli_canard_after(&canard, t - dt, &before, &reached));
  CHECK(cli_canard_after(&canard, t + dt, &after, &reached));
  CHECK(cli_canard_after(&canard, t, &at, &reached) && reached == t);
  const tf_state_t x = cli_state_at(&in_double, at);
  const tf_input_t input = tf_input_default(&machine);
  CHECK(tf_surface_at(&machine, &input, x.r, x.v, x.w, &surface) == TF_OK);
  /* Stick that tends to rest at h = g = 0: the core does not know its g. */
  if (fabs((double)surface.slip.g) < 64 * (double)TF_REAL_EPSILON) return;
  CHECK(surface.delassus < 0 && (double)surface.slip.g * canard.s > 0);
  CHECK(fabs((double)surface.lambda) < 1.001 * (double)machine.contact.tyre.mu);
  const double rate[] = {(after.r - before.r) / (2 * dt),
                         (after.z - before.z) / (2 * dt)};
  const double A = (double)surface.delassus;
  const double tolerance = IS_DOUBLE ? 1e-4 : 1e-2;
  const double slow = fabs(canard.z / end);
  const double rounding = 64 * (double)TF_REAL_EPSILON * (1 + 1 / fabs(A));
  CHECK_NEAR(rate[0], (double)surface.scaled.r / A,
             tolerance * (fabs(rate[0]) + fabs(canard.v)) + rounding);
  CHECK_NEAR(
      rate[1], (double)surface.scaled.w / A,
      tolerance * (fabs(rate[1]) + fabs(canard.slope * canard.v) + slow) +
          rounding);
}

/* Near the two-fold the canard is its tangent, and it ends at its end. */
static void judge_ends(void) {
  cli_point_t at;
  double reached = 0;
  const double t = 1e-4 * end;
  CHECK(cli_canard_after(&canard, t, &at, &reached));
  CHECK_NEAR(at.r, canard.r + canard.v * t, 0.01 * fabs(canard.v) * t);
  CHECK_NEAR(at.z - canard.z, canard.slope * canard.v * t,
             0.01 * (fabs(canard.slope * canard.v) + fabs(canard.z / end)) * t);
}

/* Of other masses, angles, springs and friction, too. */
static bool any_machine(void) {
  const sample_t c = random_two_fold();
  machine = c.machine;
  in_double = cli_widen(&machine);
  return c.design.two_fold.paper_case == 1;
}
/* Draws two-folds of case 1 until enough were followed or said why not.
 * Returns: the share that is followed. */
static double followed(bool (*draw)(void)) {
  int drawn = 0, solved = 0, rest = 0;
  double largest = 0;
  while (drawn < samples(160)) {
    if (!draw() || !cli_find_two_fold(&machine, &through)) continue;
    drawn++;
    largest = fmax(largest, through.ratio);
    const char *why = cli_canard_solve(&in_double, &through, &canard);
    CHECK(why == NULL || strlen(why) > 20);
    if (why != NULL) continue;
    solved++;
    rest += canard.decay > 0;
    end = canard.node[0].t;
    if (draw != any_machine) judge_ends(); /* some bend within that */
    for (int i = 1; i < 8; i++) judge_at(i * end / 8);
  }
  printf("# %d of %d followed, %d to rest, ratio < %g\n", solved, drawn, rest,
         largest);
  return (double)solved / drawn;
}

static bool near_the_paper(void) {
  return is_case_1(tap_uniform(0.16, 0.22), tap_uniform(-1.2, -1.005));
}
TEST(designs_near_the_paper_are_all_followed) {
  CHECK(followed(near_the_paper) == 1);
}

static bool in_figure_4(void) {
  return is_case_1(tap_uniform(0.005, 1), tap_uniform(-3, 1));
}
TEST(designs_of_figure_4_are_followed_or_say_why) {
  CHECK(followed(in_figure_4) >= 0.95);
}

TEST(random_machines_are_followed_or_say_why) {
  CHECK(followed(any_machine) >= 0.95);
}

/* r, omega of a two-fold; t, r, z of stick from there to rest by collocation of
 * z(r), in SciPy. Its explicit method, backward in time, agrees to 6e-11. */
TEST(stick_that_never_ends_is_that_of_a_collocation) {
  static const double known[] = {
      0.1859, -1.037, 0.01,  0.18561092706923, -0.03404766619411,
      0.1859, -1.037, 0.443, 0.18228083378184, -0.00106808412507,
      0.1859, -1.037, 1.5,   0.18217039936974, -0.00000025135824,
      0.17,   -1.15,  0.05,  0.16548348235094, -0.07734132712927,
      0.5,    -1.2,   2,     0.32756653363857, -0.08583089225035};
  for (const double *x = known; x < known + 25; x += 5) {
    cli_point_t at;
    double reached = 0;
    CHECK(is_case_1(x[0], x[1]) && cli_find_two_fold(&machine, &through));
    CHECK(cli_canard_solve(&in_double, &through, &canard) == NULL);
    CHECK(cli_canard_after(&canard, x[2], &at, &reached));
    CHECK_NEAR(hypot(at.r - x[3], at.z - x[4]), 0, IS_DOUBLE ? 1e-10 : 1e-5);
  }
}

/* A two-fold next to g = 0: its eigenvalues are too different. */
TEST(a_stiff_two_fold_is_a_failure_with_a_name) {
  CHECK(is_case_1(0.1859, -1.0002));
  CHECK(cli_find_two_fold(&machine, &through));
  CHECK(through.ratio > 2048);
  const char *why = cli_canard_solve(&in_double, &through, &canard);
  CHECK(why != NULL && strstr(why, "eigenvalues") != NULL);
}
