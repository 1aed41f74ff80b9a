/* What the located step reports, judged from outside: residual, angle, Delassus
 * scalar, the slip that follows a stick, and that tf_step took over. */
#include "same_state.h"
#include "sim.h"

static tf_status_t locate(sim_t *s) { return sim_step(s, LOCATED); }

/* A machine of this step at a random place, at most `reach` off h = 0. */
static tf_status_t draw(sim_t *s, double dt, double reach) {
  *s = (sim_t){.params = moderate_params()};
  s->params.dt = (tf_real_t)dt;
  s->params.with_angle = true;
  return sim_place(s, tap_uniform(0.1, 0.8), tap_uniform(-1.5, 1.5),
                   tap_uniform(-reach, reach), TF_NO_MODE);
}

/* Off h = g = 0 the residual of a slip is what the paper's law says about F, M
 * and the slip of the report; a series cut early leaves one, and it falls with
 * the tolerance. */
TEST(located_residual_is_that_of_the_law) {
  const double tolerance[2] = {1e-3, IS_DOUBLE ? 1e-10 : 1e-5};
  double worst[2] = {0, 0}, sum[2] = {0, 0};
  int slips[2] = {0, 0};
  for (int j = 0; j < 2; j++)
    for (int i = 0; i < 60; i++) {
      sim_t s;
      if (draw(&s, 0.05, 0.3) != TF_OK) continue;
      s.params.tolerance = (tf_real_t)tolerance[j];
      CHECK(sim_prepare(&s) == TF_OK);
      const paper_t paper = paper_of(&s.params);
      for (int n = 0; n < 20; n++) {
        if (locate(&s) != TF_OK) break;
        const tf_report_t *o = &s.report;
        if (!tf_mode_is_slip(o->mode)) continue;
        if (fabs((double)o->slip.h) + fabs((double)o->slip.g) < 0.05) continue;
        const double side = o->mode == TF_SLIP_PLUS ? 1 : -1;
        const double beyond = fmax(0, -side * (double)o->slip.h);
        real F, M;
        paper_friction(&paper, beyond > 0 ? side * DBL_MIN : (real)o->slip.h,
                       (real)o->slip.g, &F, &M);
        const real want =
            fabsl((real)o->force.F - F) + fabsl((real)o->force.M - M) + beyond;
        CHECK_NEAR((real)o->residual, want,
                   64 * (double)TF_REAL_EPSILON * (double)s.k.contact.tyre.mu);
        worst[j] = fmax(worst[j], (double)o->residual);
        sum[j] += (double)o->residual;
        slips[j]++;
      }
    }
  for (int j = 0; j < 2; j++) CHECK_ABOVE(slips[j], 300);
  CHECK_ABOVE(worst[0], 1e-4);
  CHECK_BELOW(worst[1], IS_DOUBLE ? 1e-5 : 1e-1);
  CHECK_BELOW(sum[1] / slips[1], sum[0] / slips[0] / 10);
}

/* A step that ends at a change of mode, to the last bit: force and residual are
 * those of the mode that begins there. */
TEST(located_event_at_the_end_of_a_step) {
  int events = 0;
  for (int i = 0; i < 100; i++) {
    sim_t s;
    tf_real_t low = 0, high = TF_R(0.05);
    if (draw(&s, 0.05, 0.1) != TF_OK) continue;
    sim_t end = s;
    const uint8_t mode = s.x.mode;
    if (locate(&end) != TF_OK || end.x.mode == mode) continue;
    for (int n = 0; n < 80; n++) {
      sim_t x = s;
      x.params.dt = low + (high - low) / 2;
      if (!(x.params.dt > low && x.params.dt < high)) break;
      if (sim_prepare(&x) != TF_OK) break;
      const tf_status_t status = locate(&x);
      CHECK(status == TF_OK || status >= TF_COARSE);
      if (x.x.mode == mode) {
        low = x.params.dt;
      } else {
        high = x.params.dt;
        end = x;
      }
    }
    if (fabs((double)end.report.slip.g) < 0.05) continue;
    events++;
    CHECK_NEAR((double)end.report.residual, 0, IS_DOUBLE ? 1e-5 : 2e-2);
  }
  CHECK_ABOVE(events, 20);
}

/* The angle is the integral of w: over one step of 50 ms that of the same
 * motion in 64 parts, by Simpson's rule from their ends. */
TEST(located_angle_is_the_integral_of_the_speed) {
  enum { PARTS = 64 };
  int steps = 0, with_event = 0;
  for (int i = 0; i < 40; i++) {
    sim_t s;
    if (draw(&s, 0.05, 0.3) != TF_OK) continue;
    sim_t fine = s;
    fine.params.dt = TF_R(0.05) / PARTS;
    CHECK(sim_prepare(&fine) == TF_OK);
    for (int n = 0; n < 10; n++) {
      const uint8_t before = s.x.mode;
      const tf_real_t phi = s.x.phi;
      double w[PARTS + 1] = {(double)s.x.w}, want = 0;
      fine.x = s.x;
      if (locate(&s) != TF_OK) break;
      int clean = s.report.choices <= 1;
      for (int k = 1; k <= PARTS; k++) {
        clean &= locate(&fine) == TF_OK && fine.report.choices <= 1;
        w[k] = (double)fine.x.w;
      }
      if (!clean) break;
      for (int k = 0; k < PARTS; k += 2)
        want += (w[k] + 4 * w[k + 1] + w[k + 2]) * (0.05 / PARTS / 3);
      /* An event within two parts bends w once: dw' (dt/64)^2. */
      CHECK_NEAR((double)(s.x.phi - phi), want,
                 (s.x.mode == before ? 1e-6 : 1e-5) * (IS_DOUBLE ? 1 : 10) *
                     (1 + fabs(w[0])));
      steps++;
      with_event += s.x.mode != before;
    }
  }
  CHECK_ABOVE(steps, 200);
  CHECK_ABOVE(with_event, 10);
}

/* In stick the Delassus scalar reported is the paper's A(r, sign g). */
TEST(located_delassus_is_that_of_the_side_of_g) {
  int seen[2] = {0, 0};
  for (int i = 0; i < 4000; i++) {
    sim_t s = {.params = moderate_params()};
    s.params.dt = TF_R(1e-3);
    const unsigned mode = i % 2 ? TF_STICK_PLUS : TF_STICK_MINUS;
    if (sim_place(&s, tap_uniform(-0.8, 0.8), tap_uniform(-1.5, 1.5), 0,
                  mode) != TF_OK ||
        s.x.mode != mode || locate(&s) != TF_OK || s.report.mode != mode)
      continue;
    const paper_t paper = paper_of(&s.params);
    const int sign = mode == TF_STICK_PLUS ? 1 : -1;
    const real r = (real)s.x.r;
    const real want = paper_delassus(&paper, r, sign);
    const real other = paper_delassus(&paper, r, -sign);
    CHECK_NEAR((real)s.report.delassus, want,
               32 * (double)TF_REAL_EPSILON * (fabsl(want) + fabsl(other)));
    seen[sign > 0] += fabsl(want - other) > 0.1L;
  }
  for (int i = 0; i < 2; i++) CHECK_ABOVE(seen[i], 100);
}

/* Slip that starts at g = 0, where the law has a kink, one way or the other.
 * gamma = 0, where g is the speed of the slider. */
TEST(located_slip_starts_at_g_0) {
  for (int i = 0; i < 200; i++) {
    sim_t s = {.params = moderate_params()};
    s.params.gamma = 0;
    s.params.d = 0;
    s.params.dt = TF_R(0.02);
    s.params.tolerance = IS_DOUBLE ? TF_R(1e-10) : TF_R(1e-6);
    s.params.r0 = (tf_real_t)tap_uniform(-1, 1);
    CHECK(sim_prepare(&s) == TF_OK);
    s.u = tf_input_default(&s.k);
    const double slip = tap_uniform(0.2, 1) * (i % 2 ? 1 : -1);
    s.x = (tf_state_t){.r = (tf_real_t)tap_uniform(0.1, 0.5),
                       .w = s.u.omega0 + (tf_real_t)slip,
                       .mode = TF_NO_MODE};
    CHECK(sim_begin(&s) == TF_OK);
    CHECK(s.report.slip.g == 0 && s.report.slip.h != 0);
    const ref_machine_t q = reference_of(&s.params, &s.u);
    ref_orbit_t orbit = {.tolerance = 1e-13L};
    ref_begin(&orbit, &q, ref_state(&q, wide(s.x.r), 0, wide(s.x.w)),
              REF_MODES);
    CHECK(ref_run(&orbit, wide(s.params.dt)) == REF_REACHED);
    CHECK(locate(&s) == TF_OK);
    CHECK_NEAR(wide(s.x.r), orbit.x.r, IS_DOUBLE ? 1e-10L : 1e-5L);
    CHECK_NEAR(wide(s.x.w), ref_w(&q, orbit.x), IS_DOUBLE ? 1e-9L : 1e-4L);
  }
}

/* Without contact a wheel that stays at h = 0 keeps the side that it had. */
TEST(located_without_contact_keeps_its_side_at_h_0) {
  for (unsigned mode = TF_SLIP_PLUS; mode <= TF_SLIP_MINUS; mode++) {
    sim_t s = {.params = tf_scenes[0]->params};
    s.params.law = TF_TYRE_NONE;
    s.params.omega0 = 0;
    CHECK(sim_place(&s, (double)s.params.r0, 0, 0, mode) == TF_OK);
    s.x.mode = (uint8_t)mode;
    for (int n = 0; n < 3; n++) {
      CHECK(locate(&s) == TF_OK);
      CHECK(s.report.slip.h == 0 && s.x.mode == mode);
    }
  }
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
    const tf_status_t s = locate(&p), t = sim_step(&same, MOREAU);
    if (!same_state(&p.x, &same.x)) continue;
    fell_back++;
    /* A step that tf_step finds too coarse keeps that status. */
    CHECK(p.report.status == s && s == (t == TF_OK ? TF_FELL_BACK : t));
    CHECK(p.report.set == same.report.set &&
          p.report.force.F == same.report.force.F);
  }
  CHECK(fell_back > 50);
}
