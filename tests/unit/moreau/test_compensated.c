/* The compensated step: what it adds to a step is digits and nothing else. */
#include "sim.h"

/* Of a pair, as far as long double resolves. */
#define PAIR_EPSILON (EPSILON * EPSILON + LDBL_EPSILON)

static sim_t begun(const tf_scene_t *scene, double dt) {
  tf_params_t p = scene->params;
  p.dt = (tf_real_t)dt;
  sim_t s = sim_at_start(scene, &p, 1);
  s.u = tf_scene_input(scene, &s.k, 0);
  if (!scene->v_is_given)
    CHECK(tf_speed_for_slip_compensated(&s.pairs, &s.x, &s.low, s.u.omega0,
                                        scene->h) == TF_OK);
  CHECK(sim_begin(&s) == TF_OK);
  return s;
}

TEST(compensated_start_has_its_slip) {
  for (int i = 0; i < 1000; i++) {
    sim_t run = begun(tf_scenes[0], 1e-4);
    run.params.gamma = uniform(0.1, 3);
    CHECK(sim_prepare(&run) == TF_OK);
    run.x.r = uniform(-2, 2);
    run.x.w = uniform(-2, 2);
    run.low.r = run.x.r * TF_REAL_EPSILON * uniform(-0.25, 0.25);
    run.low.w = run.x.w * TF_REAL_EPSILON * uniform(-0.25, 0.25);
    const tf_real_t h = uniform(0, 1) * (i % 2 ? 1 : TF_R(1e-10));
    CHECK(tf_speed_for_slip_compensated(&run.pairs, &run.x, &run.low,
                                        run.u.omega0, h) == TF_OK);
    const paper_t paper = paper_of(&run.params);
    real x[4];
    sim_whole(&run, x);
    CHECK_NEAR(paper_h(&paper, x), (real)h, 200 * PAIR_EPSILON);
    CHECK(fabsl((real)run.low.v) <= EPSILON * fabsl((real)run.x.v));
  }
  sim_t run = begun(scene_named("gamma_zero"), 1e-4);
  const tf_real_t v = run.x.v;
  CHECK(tf_speed_for_slip_compensated(&run.pairs, &run.x, &run.low, -1, 0) ==
        TF_BAD_STATE);
  CHECK(run.x.v == v && run.low.v == 0);
  run = begun(tf_scenes[0], 1e-4);
  for (int i = -1; i <= 1; i++) { /* about the border of 1e-6 rad */
    run.params.gamma = TF_R(1e-6) * (1 + TF_R(0.1) * (tf_real_t)i);
    CHECK(sim_prepare(&run) == TF_OK);
    if (i == 0) run.pairs.machine.sin_gamma = TF_R(-1e-6);
    CHECK(tf_speed_for_slip_compensated(&run.pairs, &run.x, &run.low, -1, 0) ==
          (i < 0 ? TF_BAD_STATE : TF_OK));
  }
}

/* By the reference's stick, g < 0; the angle by Simpson's rule. */
static void true_stick(const sim_t *run, real x[4], real t) {
  enum { PARTS = 1000 };
  const ref_machine_t q = reference_of(&run->params, &run->u);
  ref_orbit_t orbit = {.tolerance = 1e-15L};
  const ref_state_t start = ref_state(&q, x[0], x[1], x[2]);
  ref_begin(&orbit, &q, ref_with_h(&q, start, 0), REF_STICK_MINUS);
  for (int i = 0; i <= PARTS; i++) {
    const int weight = i == 0 || i == PARTS ? 1 : i % 2 ? 4 : 2;
    CHECK(ref_run(&orbit, t * i / PARTS) == REF_REACHED);
    x[3] += weight * ref_w(&q, orbit.x) * t / (3 * PARTS);
  }
  x[0] = orbit.x.r;
  x[1] = ref_v(&q, orbit.x);
  x[2] = ref_w(&q, orbit.x);
}

/* A million steps of 1e-6 s, each below what a float of the state resolves. */
TEST(rounding_is_compensated) {
  const int steps = 1000000;
  sim_t run = begun(scene_named("rolling"), 1e-6), rounded = run;
  real want[4], got[4], plain[4], worst = 0, worst_plain = 0;
  sim_whole(&run, want);
  memset(&rounded.low, 0, sizeof rounded.low);
  true_stick(&run, want, (real)steps * (real)run.params.dt);
  for (int i = 0; i < steps; i++) {
    CHECK(sim_step(&run, COMPENSATED) == TF_OK);
    CHECK(ok_to_resolution(sim_step(&rounded, MOREAU)));
  }
  sim_whole(&run, got);
  sim_whole(&rounded, plain);
  for (int j = 0; j < 4; j++) {
    /* The step's own error, 0.3 dt^2, and what pairs of floats add to it. */
    CHECK_NEAR(got[j], want[j], IS_DOUBLE ? 5e-13L : 5e-10L);
    worst = fmaxl(worst, fabsl(got[j] - want[j]));
    worst_plain = fmaxl(worst_plain, fabsl(plain[j] - want[j]));
  }
  CHECK_ABOVE(worst_plain, 3 * worst);
  CHECK(fabsl((real)run.low.r) <= EPSILON * fabsl((real)run.x.r));
  CHECK(fabsl((real)run.low.w) <= EPSILON * fabsl((real)run.x.w));
}

/* From one state the plain and the compensated step end at the same place but
 * for rounding, in the same mode, and report the same. */
static int same_step(const sim_t *at, real *worst) {
  sim_t a = *at, b = *at;
  memset(&b.low, 0, sizeof b.low);
  const tf_status_t plain = sim_step(&a, MOREAU);
  const tf_status_t compensated = sim_step(&b, COMPENSATED);
  const int stands = plain == TF_STALLED && compensated == TF_OK;
  /* Sets differ where one of them comes to h = g = 0 and the other does not. */
  if ((plain != compensated && !stands) || a.report.mode != b.report.mode ||
      a.report.set != b.report.set)
    return 0;
  if (plain < 0) return 1;
  /* At a Delassus scalar of 0 the multiplier of stick is as good as free. */
  if (!tf_mode_is_slip(a.report.mode) && fabsl((real)a.report.delassus) < 0.2L)
    return 1;
  /* So is the angle of a slip as small as the rounding of its terms, and with
   * it the force. */
  const tf_slip_t from =
      tf_slip(&at->k, at->x.r, at->x.v, at->x.w, at->u.omega0);
  if (fabsl((real)from.h) + fabsl((real)from.g) < 5e3L * EPSILON) return 1;
  const real scale =
      1 + fabsl((real)a.x.r) + fabsl((real)a.x.v) + fabsl((real)a.x.w);
  const real off =
      fabsl((real)a.x.r - (real)b.x.r) + fabsl((real)a.x.v - (real)b.x.v) +
      fabsl((real)a.x.w - (real)b.x.w) + fabsl((real)a.x.phi - (real)b.x.phi);
  /* Where a slip is lost follows from h at the start, which the plain step
   * knows to rounding. */
  const int lost =
      tf_mode_is_slip(at->x.mode) && a.report.mode != at->x.mode ? 5 : 1;
  *worst = fmaxl(*worst, off / scale / lost);
  CHECK(b.x.tick == at->x.tick + 1 && b.x.mode == b.report.mode);
  CHECK(b.report.choices >= (b.report.status == TF_OK));
  CHECK_NEAR(a.report.slip.h, b.report.slip.h, 50 * EPSILON * scale);
  CHECK_NEAR(a.report.slip.g, b.report.slip.g, 50 * EPSILON * scale);
  if (fabsl((real)a.report.slip.g) > 100 * EPSILON * scale) /* known in sign */
    CHECK_NEAR(a.report.delassus, b.report.delassus, 400 * EPSILON);
  return 1;
}

TEST(compensated_step_is_the_step) {
  for (int i = 0; i < TF_SCENES; i++) {
    sim_t run = begun(tf_scenes[i], 1e-3);
    real worst = 0;
    int same = 0;
    for (int n = 0; n < 5000; n++) {
      run.u = tf_scene_input(tf_scenes[i], &run.k, (uint64_t)n + 1);
      same += same_step(&run, &worst);
      CHECK(sim_step(&run, MOREAU) >= 0);
    }
    if (!CHECK_ABOVE(same, 4949)) printf("#   %s\n", tf_scenes[i]->name);
    CHECK_NEAR(worst, 0, 6 * EPSILON);
  }
  /* At and about h = g = 0, under every rule: pinned, no mode, all modes. */
  int same = 0;
  real worst = 0;
  for (int n = 0; n < samples(20000); n++) {
    sim_t run = begun(tf_scenes[0], 1e-3);
    const double size = n % 4 ? tap_uniform(0, 4e-3) : 0;
    run.params.rule = (tf_rule_t)(n % TF_RULES);
    run.params.beta = uniform(0.05, 0.4);
    run.params.with_angle = true;
    CHECK(sim_prepare(&run) == TF_OK);
    run.x.r = uniform(-0.4, 0.4);
    run.x.w = run.u.omega0 + (tf_real_t)(size * tap_uniform(-9, 9));
    run.x.v = (tf_real_t)(size * tap_uniform(-1, 1));
    run.x.mode = (uint8_t)(n % TF_MODES);
    same += same_step(&run, &worst);
  }
  CHECK_ABOVE(same, samples(19800) - 1);
  CHECK_NEAR(worst, 0, 300 * EPSILON);
}
