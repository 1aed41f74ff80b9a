/* The located step: stick, and what it does at its limits. test_reference.c has
 * its error, events and branches. */
#include "sim.h"

static sim_t chaos(double t_end, int n, double tolerance) {
  const tf_scene_t *scene = tf_scenes[0];
  sim_t p = {.params = scene->params};
  p.params.dt = (tf_real_t)(t_end / n);
  p.params.tolerance = (tf_real_t)tolerance;
  CHECK(sim_place(&p, (double)scene->r, (double)scene->omega, (double)scene->h,
                  TF_SLIP_PLUS) == TF_OK);
  return p;
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

/* A wheel along the slot that sticks on the axis has A = 0 and no series: there
 * tf_step takes over, and its state and report are the ones returned. */
TEST(located_falls_back_and_says_so) {
  tf_params_t along = tf_scenes[0]->params;
  along.gamma = 0;
  int fell_back = 0;
  for (int i = 0; i < 100; i++) {
    sim_t p = sim_of(&along);
    CHECK(sim_prepare(&p) == TF_OK);
    p.x = (tf_state_t){.v = uniform(-1, 1), .w = along.omega0};
    p.x.mode = p.x.v < 0 ? TF_STICK_PLUS : TF_STICK_MINUS;
    sim_t same = p;
    const tf_status_t s = sim_step(&p, LOCATED), t = sim_step(&same, MOREAU);
    if (memcmp(&p.x, &same.x, sizeof p.x) != 0) continue;
    fell_back++;
    /* A step that tf_step finds too coarse is not told as one that it took. */
    CHECK(p.report.status == s && s == (t == TF_OK ? TF_FELL_BACK : t));
    CHECK(p.report.set == same.report.set &&
          p.report.force.F == same.report.force.F);
  }
  CHECK(fell_back > 50);
}

TEST(located_refuses_what_it_cannot_take) {
  const tf_tyre_law_t single[] = {TF_TYRE_TWO_PIECE, TF_TYRE_STRING,
                                  TF_TYRE_SMOOTH};
  sim_t p = chaos(1, 100, 1e-8);
  const tf_state_t start = p.x;
  for (int i = 0; i < 3; i++) {
    p.k.contact.tyre.law = single[i];
    CHECK(sim_step(&p, LOCATED) == TF_BAD_PARAMETER);
    CHECK(!memcmp(&p.x, &start, sizeof start));
  }
}
