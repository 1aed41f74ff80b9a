/* Steps that reach h = g = 0 or leave it, most of them located, against the
 * reference. */
#include "codim2_field.h"
#include "sim.h"

/* Where both sticks leave h = g = 0 the faster one is taken, whatever the sign
 * of the rounding that g has. */
TEST(of_two_sticks_the_faster_is_taken) {
  int taken[2] = {0};
  for (int n = 0; n < 20000; n++) {
    tf_params_t params = any_params(n);
    params.dt = TF_R(1e-6);
    sim_t s = sim_of(&params);
    s.x.r = uniform(-0.6, 0.6);
    s.x.w = s.u.omega0;
    const ref_machine_t q = reference_of(&params, &s.u);
    const ref_affine_t at =
        ref_affine(&q, (ref_state_t){.r = wide(s.x.r), .piece = 1});
    if (!leaves_attracting(&q, &at, 1) || !leaves_attracting(&q, &at, -1))
      continue;
    s.x.v = TF_REAL_EPSILON * uniform(-1e-4, 1e-4);
    const tf_slip_t slip = tf_slip(&s.k, s.x.r, s.x.v, s.x.w, s.u.omega0);
    s.x.mode = slip.h > 0 ? TF_SLIP_MINUS : TF_SLIP_PLUS; /* to be ignored */
    if (!ok_to_resolution(sim_step(&s, LOCATED)) || s.x.mode == TF_PINNED)
      continue;
    const bool minus =
        ref_stick_growth(&q, &at, -1) > ref_stick_growth(&q, &at, 1);
    CHECK(s.x.mode == (minus ? TF_STICK_MINUS : TF_STICK_PLUS));
    taken[minus]++;
  }
  for (int i = 0; i < 2; i++) CHECK_ABOVE(taken[i], 20);
}

/* A machine at h = g = 0 whose stick is escaping and moves g by next to nothing
 * from there: loads hold it, but for a torque. */
static int draw_slow_escape(sim_t *s, int i, unsigned mode, real torque) {
  tf_params_t p = any_params(i);
  p.dt = log_uniform(1e-2, 0.3);
  *s = sim_of(&p);
  const real F = tap_uniform(-0.9, 0.9) * wide(p.mu);
  const int side = mode == TF_STICK_PLUS ? 1 : -1;
  const paper_t paper = paper_of(&p);
  s->x.r = uniform(-0.6, 0.6);
  s->x.w = p.omega0;
  s->x.mode = (uint8_t)mode;
  load_for(&p, &s->u, s->x.r, s->x.w, F, (real)side * wide(p.kappa) * F);
  s->u.torque += (tf_real_t)torque;
  return paper_delassus(&paper, wide(s->x.r), side) < 0;
}

/* A stick whose g has the wrong sign by rounding, and comes back, goes on as
 * one at g = 0 does and reports its set, although a step changes g by little
 * more than that. Of a few machines the rounding of the loads decides. */
TEST(rounding_of_g_does_not_choose) {
  int steps = 0, apart = 0, sets = 0;
  for (int i = 0; i < samples(200000); i++) {
    const unsigned mode = i & 1 ? TF_STICK_MINUS : TF_STICK_PLUS;
    const real side = i & 1 ? -1 : 1;
    const real size = exp(tap_uniform(log(1e2), log(1e4))) * EPSILON;
    sim_t s;
    if (!draw_slow_escape(&s, i, mode, size * (i & 2 ? 1 : -1))) continue;
    sim_t at = s;
    s.x.w *= 1 + (tf_real_t)((int)(tap_bits() % 9) - 4) * TF_REAL_EPSILON;
    s.x.v = TF_REAL_EPSILON * uniform(-2, 2);
    const tf_slip_t slip = tf_slip(&s.k, s.x.r, s.x.v, s.x.w, s.u.omega0);
    /* The torque drives g to the side of the stick. */
    const bool returns =
        side * wide(s.x.r * s.k.sin_gamma) * (i & 2 ? 1 : -1) > 0;
    if (!(side * wide(slip.g) < 0) || !returns) continue;
    if (sim_step(&s, MOREAU) != TF_OK || sim_step(&at, MOREAU) != TF_OK)
      continue;
    steps++;
    apart += s.x.mode != at.x.mode;
    sets += s.x.mode == at.x.mode && s.report.set != at.report.set;
  }
  CHECK_ABOVE(steps, samples(5000));
  CHECK_BELOW(apart * 38, steps);
  CHECK_BELOW(sets * 200, steps);
}

/* A slip that comes to h = g = 0 along a limit direction, where |F| > mu would
 * hold it. The hull of the forces has that F. The other laws of rest lack it,
 * and no other mode takes its place: the fixed step finishes what the segments
 * cannot, by a force within the law. */
TEST(slip_without_a_future_at_codim2_is_coarse) {
  if (!IS_DOUBLE) SKIP("a machine whose numbers are of double");
  tf_params_t p = tf_scenes[0]->params;
  p.m = TF_R(10.179499638804538), p.d = 0;
  p.beta = TF_R(7.7993186931236425e-09), p.k2 = TF_R(0.20612287603159693);
  p.c1 = p.c2 = 0;
  p.r0 = TF_R(-0.47937901998058297), p.omega0 = TF_R(-1.5980084216737249);
  p.mu = TF_R(0.096369353564759355), p.kappa = TF_R(0.049321033367547625);
  p.gamma = TF_R(1.5707963267948966), p.dt = TF_R(1.8474401779479359e-05);
  p.rule = TF_RULE_SLIP_MINUS;
  for (int rest = 0; rest < TF_REST_LAWS; rest++) {
    p.rest = (tf_rest_law_t)rest;
    sim_t s = sim_of(&p);
    s.x.r = TF_R(-0.00010049990361183348);
    s.x.v = TF_R(-1.4876972658283903e-21);
    s.x.w = TF_R(-1.839759301626579);
    s.x.mode = TF_SLIP_PLUS;
    const tf_status_t status = sim_step(&s, LOCATED);
    const real F = fabsl(wide(s.report.force.F)) / wide(p.mu);
    const real M = fabsl(wide(s.report.force.M)) / wide(p.mu * p.kappa);
    CHECK(s.x.tick == 1);
    if (rest == TF_REST_HULL) {
      CHECK(status == TF_OK && s.x.mode == TF_PINNED);
      CHECK(s.x.v == 0 && s.x.w == s.u.omega0);
      CHECK_ABOVE(F, 1.05L);
    } else {
      CHECK(status == TF_COARSE && tf_mode_is_slip(s.x.mode));
      CHECK(F <= 1 && M <= 1);
    }
  }
}

/* A slip that comes to h = g = 0 with a choice and stays that slip is listed.
 * Float does not resolve this one. */
TEST(located_changes_have_a_choice_that_changes_nothing) {
  tf_located_change_t list[8];
  size_t count = 0;
  int found = 0;
  tf_params_t params = tf_scenes[0]->params;
  params.d = TF_R(-0.10915277667718826);
  params.beta = TF_R(0.46501501527900346);
  params.k2 = TF_R(10.528720060022424);
  params.mu = TF_R(1.8577782759020631);
  params.kappa = TF_R(0.12210309441777085);
  params.gamma = TF_R(-2.6658333751446825);
  params.dt = TF_R(0.5);
  sim_t s = sim_of(&params);
  s.x = (tf_state_t){.r = TF_R(0.017612645754733931),
                     .v = TF_R(-0.066898044986434577),
                     .w = TF_R(-0.53328025698681536),
                     .mode = TF_SLIP_PLUS};
  CHECK(tf_step_located_changes(&s.k, &s.x, &s.u, &s.report, list, 8, &count) >=
        TF_OK);
  unsigned mode = TF_SLIP_PLUS;
  for (size_t i = 0; i < count; i++) {
    found += list[i].report.mode == mode && list[i].report.choices == 2;
    mode = list[i].report.mode;
  }
  CHECK(found == 1 || !IS_DOUBLE);
}
