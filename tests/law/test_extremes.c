/* What a step promises to every machine within the documented ranges and to
 * every state up to the limit, however stiff, far or small: a step that is
 * accepted leaves finite numbers only, in the state and in the report; a step
 * that is refused leaves the state as it was, bit for bit; the report has the
 * status that was returned. */
#include "extremes.h"
#include "sim.h"

static long accepted, refused[-TF_STEP_TOO_LONG + 1];

static int all_finite(const tf_state_t *x, const tf_report_t *o) {
  return isfinite(x->r) && isfinite(x->v) && isfinite(x->w) &&
         isfinite(x->phi) && isfinite(o->force.F) && isfinite(o->force.M) &&
         isfinite(o->slip.h) && isfinite(o->slip.g) && isfinite(o->delassus) &&
         isfinite(o->residual);
}

static void tell(const tf_machine_t *k, const tf_params_t *p,
                 const tf_state_t *x, const tf_report_t *o) {
  printf("# law %d rule %d dt %g theta %g", (int)p->law, (int)p->rule,
         (double)k->dt, (double)k->theta);
  for (int i = 0; i < TF_PARAMETERS; i++)
    printf(" %s %a", tf_parameter_ranges[i].name,
           (double)*(
               const tf_real_t *)(const void *)((const char *)p +
                                                tf_parameter_ranges[i].offset));
  printf(
      "\n# r %a v %a w %a mode %d, then status %d mode %d F %g M %g h %g g "
      "%g delassus %g residual %g\n",
      (double)x->r, (double)x->v, (double)x->w, x->mode, (int)o->status,
      o->mode, (double)o->force.F, (double)o->force.M, (double)o->slip.h,
      (double)o->slip.g, (double)o->delassus, (double)o->residual);
}

/* Up to `steps` steps of one machine, until one is refused. */
static void run(scheme_t scheme, const tf_params_t *p, tf_state_t x,
                const tf_input_t *input, int steps) {
  sim_t s = sim_of(p);
  if (input) s.u = *input;
  s.x = x;
  for (int n = 0; n < steps; n++) {
    const tf_state_t old = s.x;
    memset(&s.report, 0x7f, sizeof s.report);
    memset(&s.low, 0, sizeof s.low); /* each step begins without it */
    const tf_status_t status = sim_step(&s, scheme);
    CHECK(isfinite(s.low.r) && isfinite(s.low.v) && isfinite(s.low.w));
    CHECK(s.report.status == status);
    if (status < TF_OK) {
      CHECK(memcmp(&old, &s.x, sizeof old) == 0);
      CHECK(status >= TF_STEP_TOO_LONG);
      refused[-(int)status]++;
      return;
    }
    accepted++;
    CHECK(s.report.mode == s.x.mode && s.x.mode < TF_MODES);
    CHECK(s.x.tick == old.tick + 1);
    if (!CHECK(all_finite(&s.x, &s.report))) {
      tell(&s.k, p, &old, &s.report);
      return;
    }
  }
}

static void run_schemes(const tf_params_t *p, const tf_state_t *x,
                        const tf_input_t *input, int steps) {
  for (int s = 0; s < SCHEMES; s++) run((scheme_t)s, p, *x, input, steps);
}

static void count_again(void) {
  accepted = 0;
  memset(refused, 0, sizeof refused);
}

static void tell_counts(void) {
  printf(
      "# accepted %ld, refused: parameter %ld, state %ld, diverged %ld, too "
      "long %ld\n",
      accepted, refused[1], refused[2], refused[3], refused[4]);
}

TEST(random_machines_keep_every_number_finite) {
  count_again();
  for (int n = 0; n < samples(50000); n++) {
    const tf_params_t p = draw_machine();
    const tf_real_t limit = one_in(4) ? TF_STATE_LIMIT / 2 : 10;
    const tf_state_t x = draw_state(limit);
    tf_input_t u;
    memset(&u, 0, sizeof u);
    u.omega0 = anything(100);
    u.r0 = anything(100);
    u.force = anything(1000);
    u.torque = anything(1000);
    const bool driven = one_in(4);
    run_schemes(&p, &x, driven ? &u : NULL, 10);
  }
  tell_counts();
  CHECK(accepted > samples(100000));
  for (int i = 2; i <= 4; i++) CHECK(refused[i] > samples(100));
}

/* Forces, speeds and places of one tiny size, whose squares are 0. */
TEST(tiny_machines_keep_every_number_finite) {
  count_again();
  for (int n = 0; n < samples(10000); n++) {
    tf_params_t p = tf_scenes[0]->params;
    const tf_real_t tiny = spread(TF_REAL_MIN * TF_REAL_EPSILON, TF_R(1e-18));
    p.mu = tiny * (tf_real_t)tap_uniform(0, 1);
    p.k2 = p.c1 = p.c2 = one_in(2) ? 0 : tiny;
    p.r0 = one_in(2) ? 0 : tiny;
    p.omega0 = one_in(2) ? 0 : tiny;
    tf_state_t x = draw_state(1);
    x.r = tiny * (tf_real_t)tap_uniform(-1, 1);
    x.w = p.omega0 + tiny * (tf_real_t)tap_uniform(-1, 1);
    x.v = one_in(2) ? p.d * (x.w - p.omega0)
                    : tiny * (tf_real_t)tap_uniform(-1, 1);
    run_schemes(&p, &x, NULL, 4);
  }
  tell_counts();
  CHECK(accepted > samples(50000));
}

/* One set of parameters, from a mild start and through r = 0. */
static void run_all(const tf_params_t *p, tf_real_t scale) {
  static const double step_sizes[] = {1e-9, 1e-6, 1e-4, 1e-2, 0.1, 1};
  for (size_t i = 0; i < sizeof step_sizes / sizeof *step_sizes; i++) {
    tf_params_t q = *p;
    q.dt = (tf_real_t)step_sizes[i];
    for (int start = 0; start < 4; start++) {
      tf_state_t x;
      memset(&x, 0, sizeof x);
      x.r = scale * (start == 1 ? 0 : TF_R(0.18));
      x.v = scale * (start == 2 ? -10 : start == 1 ? 0 : TF_R(0.02));
      x.w = scale * (start == 1 ? 0 : TF_R(-1.037));
      x.mode = (uint8_t)(start == 3 ? TF_STICK_PLUS : TF_PINNED);
      run_schemes(&q, &x, NULL, 8);
    }
  }
}

/* Every parameter at both ends of its range, alone and with every other. */
TEST(ends_of_the_ranges_keep_every_number_finite) {
  count_again();
  for (int i = 0; i < TF_PARAMETERS; i++) {
    for (int j = i; j < TF_PARAMETERS; j++) {
      for (int ends = 0; ends < 4; ends++) {
        tf_params_t p = tf_scenes[0]->params;
        const tf_parameter_range_t *a = &tf_parameter_ranges[i];
        const tf_parameter_range_t *b = &tf_parameter_ranges[j];
        *member(&p, i) = ends & 1 ? a->high : a->low;
        if (j > i) *member(&p, j) = ends & 2 ? b->high : b->low;
        run_all(&p, 1);
      }
    }
  }
  tell_counts();
}

TEST(listed_extremes_keep_every_number_finite) {
  const tf_real_t least = TF_REAL_MIN * TF_REAL_EPSILON;
  count_again();
  for (int i = 0; i < TF_SCENES; i++) {
    const tf_params_t scene = tf_scenes[i]->params;
    tf_params_t p;
    /* subnormal states and parameters */
    for (tf_real_t tiny = least; tiny < TF_REAL_MIN * 1000; tiny *= 16) {
      p = scene;
      p.r0 = p.omega0 = tiny;
      run_all(&p, tiny);
      p = scene;
      p.mu = p.k2 = p.c1 = p.c2 = p.rate = tiny;
      run_all(&p, 1);
      run_all(&p, tiny);
    }
    /* gamma where its sine or cosine is 0 or nearly so */
    for (int n = -4; n <= 4; n++) {
      p = scene;
      p.gamma = tf_parameter_ranges[10].high * (tf_real_t)n / 4;
      run_all(&p, 1);
      p.gamma += p.gamma < 0 ? TF_REAL_EPSILON : -TF_REAL_EPSILON;
      run_all(&p, 1);
    }
    /* at the centrifugal instability, k2 = m w^2, and beyond */
    for (tf_real_t ratio = 0; ratio < 3; ratio += TF_R(0.25)) {
      p = scene;
      p.omega0 = 1000;
      p.k2 = ratio * p.m * p.omega0 * p.omega0;
      run_all(&p, 1);
      run_all(&p, 1000);
    }
    /* far away */
    for (tf_real_t far = 10; far < TF_R(1e9); far *= 10) run_all(&scene, far);
  }
  tell_counts();
  CHECK(accepted > 100000 && refused[-TF_DIVERGED] > 100);
}

/* Slopes of h and g that overflow in float: the first made a stick of 8e11 m/s
 * consistent with an infinite Delassus scalar, and that of the second is
 * infinite while its end is in reach. */
TEST(overflow_of_a_slope_keeps_every_number_finite) {
  static const struct {
    double machine[MACHINE];
    tf_real_t dt;
    tf_rule_t rule;
    tf_state_t x;
  } edges[] = {
      {{1e-12, -1e6, 7e-8, 0, 0, 0, 1e6, 1e6, 6e-6, 5000, -0.965},
       TF_R(0.005),
       TF_RULE_SLIP_MINUS,
       {.r = TF_R(-6.7e-33), .w = TF_R(-0.46), .mode = TF_STICK_MINUS}},
      {{2.9e-11, 8, 2.6e-8, 0, 0, 0, 2500, 0.0039, 0.069, 9.6e4, -0.63},
       TF_R(0.47),
       TF_RULE_PERSIST,
       {.r = TF_R(-1e-30), .v = TF_R(-4e-9), .w = -19, .mode = TF_PINNED}}};
  for (size_t i = 0; i < sizeof edges / sizeof *edges; i++) {
    tf_params_t p = params_from(edges[i].machine);
    p.theta = 1;
    p.dt = edges[i].dt;
    p.rule = edges[i].rule;
    run_schemes(&p, &edges[i].x, NULL, 1);
  }
}
