/* What a step promises to every machine within the documented ranges and to
 * every state up to the limit, however stiff, far or small: a step that is
 * accepted leaves finite numbers only, in the state and in the report; a step
 * that is refused leaves the state as it was, bit for bit; the report has the
 * status that was returned. */
#include "extremes.h"

typedef tf_status_t step_t(const tf_compensated_t *, tf_state_t *,
                           const tf_input_t *, tf_report_t *);

static tf_status_t moreau(const tf_compensated_t *k, tf_state_t *x,
                          const tf_input_t *u, tf_report_t *report) {
  return tf_step(&k->machine, x, u, report);
}

static tf_status_t located(const tf_compensated_t *k, tf_state_t *x,
                           const tf_input_t *u, tf_report_t *report) {
  return tf_step_located(&k->machine, x, u, report);
}

/* Each step begins with a compensation of zero. */
static tf_status_t compensated(const tf_compensated_t *k, tf_state_t *x,
                               const tf_input_t *u, tf_report_t *report) {
  tf_compensation_t compensation = {0};
  const tf_status_t status =
      tf_step_compensated(k, x, &compensation, u, report);
  CHECK(isfinite(compensation.r) && isfinite(compensation.v) &&
        isfinite(compensation.w));
  return status;
}

static step_t *const schemes[] = {moreau, located, compensated};
#define SCHEMES (sizeof schemes / sizeof *schemes)

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
static void run(step_t *step, const tf_params_t *p, tf_state_t x,
                const tf_input_t *input, int steps) {
  tf_compensated_t k;
  if (!CHECK(tf_prepare_compensated(&k, p, NULL) == TF_OK)) return;
  const tf_input_t u = input ? *input : tf_input_default(&k.machine);
  for (int n = 0; n < steps; n++) {
    tf_state_t old;
    tf_report_t report;
    memcpy(&old, &x, sizeof x);
    memset(&report, 0x7f, sizeof report);
    const tf_status_t status = step(&k, &x, &u, &report);
    CHECK(report.status == status);
    if (status < TF_OK) {
      CHECK(memcmp(&old, &x, sizeof x) == 0);
      CHECK(status >= TF_STEP_TOO_LONG);
      refused[-(int)status]++;
      return;
    }
    accepted++;
    CHECK(report.mode == x.mode && x.mode < TF_MODES);
    CHECK(x.tick == old.tick + 1);
    if (!CHECK(all_finite(&x, &report))) {
      tell(&k.machine, p, &old, &report);
      return;
    }
  }
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
  for (int n = 0; n < 50000; n++) {
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
    for (size_t s = 0; s < SCHEMES; s++)
      run(schemes[s], &p, x, driven ? &u : NULL, 10);
  }
  tell_counts();
  CHECK(accepted > 100000 && refused[2] > 10 && refused[3] > 100);
  CHECK(refused[4] > 100);
}

/* Forces, speeds and places of one tiny size, whose squares are 0. */
TEST(tiny_machines_keep_every_number_finite) {
  count_again();
  for (int n = 0; n < 10000; n++) {
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
    for (size_t s = 0; s < SCHEMES; s++) run(schemes[s], &p, x, NULL, 4);
  }
  tell_counts();
  CHECK(accepted > 50000);
}

/* Every value of the state and of an input: too large, or not a number. */
TEST(bad_states_and_inputs_are_refused_untouched) {
  static const tf_real_t wrong[] = {(tf_real_t)NAN,       (tf_real_t)INFINITY,
                                    -(tf_real_t)INFINITY, TF_REAL_MAX,
                                    -TF_REAL_MAX,         TF_R(1.001e9)};
  const tf_params_t p = tf_scenes[0]->params;
  for (size_t s = 0; s < SCHEMES; s++) {
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
      for (int where = 0; where < 7; where++) {
        tf_state_t x = draw_state(1);
        tf_input_t u;
        memset(&u, 0, sizeof u);
        tf_real_t *const at[] = {&x.r,  &x.v,     &x.w,     &u.omega0,
                                 &u.r0, &u.force, &u.torque};
        *at[where] = wrong[i];
        count_again();
        run(schemes[s], &p, x, &u, 1);
        CHECK(refused[-TF_BAD_STATE] == 1);
      }
    }
    tf_state_t x = draw_state(1);
    x.mode = TF_NO_MODE;
    count_again();
    run(schemes[s], &p, x, NULL, 1);
    CHECK(refused[-TF_BAD_STATE] == 1);
  }
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
      for (size_t s = 0; s < SCHEMES; s++) run(schemes[s], &q, x, NULL, 8);
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

/* A machine at the edge of what float holds, under one start. */
typedef struct {
  tf_real_t m, d, beta, r0, omega0, mu, kappa, gamma, dt;
  tf_rule_t rule;
  tf_real_t r, v, w;
  uint8_t mode;
} edge_t;

/* Slopes of h and g that overflow in float: the first made a stick of 8e11 m/s
 * consistent with an infinite Delassus scalar, and that of the second is
 * infinite while its end is in reach. */
TEST(overflow_of_a_slope_keeps_every_number_finite) {
  static const edge_t edges[] = {
      {TF_R(1e-12), TF_R(-1e6), TF_R(7e-8), TF_R(1e6), TF_R(1e6), TF_R(6e-6),
       5000, TF_R(-0.965), TF_R(0.005), TF_RULE_SLIP_MINUS, TF_R(-6.7e-33), 0,
       TF_R(-0.46), TF_STICK_MINUS},
      {TF_R(2.9e-11), 8, TF_R(2.6e-8), 2500, TF_R(0.0039), TF_R(0.069),
       TF_R(9.6e4), TF_R(-0.63), TF_R(0.47), TF_RULE_PERSIST, TF_R(-1e-30),
       TF_R(-4e-9), -19, TF_PINNED}};
  for (size_t i = 0; i < sizeof edges / sizeof *edges; i++) {
    const edge_t *e = &edges[i];
    tf_params_t p = tf_scenes[0]->params;
    p.m = e->m;
    p.d = e->d;
    p.beta = e->beta;
    p.k2 = p.c1 = p.c2 = 0;
    p.r0 = e->r0;
    p.omega0 = e->omega0;
    p.mu = e->mu;
    p.kappa = e->kappa;
    p.gamma = e->gamma;
    p.theta = 1;
    p.dt = e->dt;
    p.rule = e->rule;
    tf_state_t x;
    memset(&x, 0, sizeof x);
    x.r = e->r;
    x.v = e->v;
    x.w = e->w;
    x.mode = e->mode;
    for (size_t s = 0; s < SCHEMES; s++) run(schemes[s], &p, x, NULL, 1);
  }
}
