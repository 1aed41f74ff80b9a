/* The simulator against the reference: every scene and two benchmarks, as far
 * as the solution is unique. */
#include "problems.h"
#include "sim.h"

/* Step sizes are taken in groups of neighbours, of which the largest error
 * counts: where in a step an event falls changes the error of one run by its
 * size, and evenly so, which moves the largest less than the mean. */
enum { GROUP = 8, PHASES = 64 };

static tf_tyre_law_t law_of(const reference_t *ref) {
  static const tf_tyre_law_t laws[] = {TF_TYRE_JUMP, TF_TYRE_COULOMB,
                                       TF_TYRE_STRING, TF_TYRE_SMOOTH,
                                       TF_TYRE_NONE};
  return laws[ref->problem->machine.law];
}

static tf_scene_t scene_of(const reference_t *ref, tf_real_t dt) {
  const ref_machine_t *q = &ref->problem->machine;
  tf_scene_t s = {.name = ref->problem->name};
  s.params = (tf_params_t){PARAMETERS_OF(tf_real_t, q),
                           .epsilon = (tf_real_t)q->epsilon,
                           .k = (tf_real_t)q->k,
                           .delta = (tf_real_t)q->delta,
                           .sigma = (tf_real_t)q->sigma,
                           .rho = (tf_real_t)q->rho,
                           .a = (tf_real_t)q->a,
                           .theta = TF_R(0.5),
                           .dt = dt,
                           .law = law_of(ref)};
  s.knots = (uint8_t)q->knots;
  for (int i = 0; i < q->knots; i++)
    s.profile[i] =
        (tf_knot_t){(tf_real_t)q->knot[i].t, (tf_real_t)q->knot[i].omega0};
  return s;
}

typedef struct {
  scheme_t scheme;
  tf_scene_t scene;
  sim_t sim;
} run_t;

static const double finest = 1e-11; /* tolerance of located steps */

static int begin(run_t *run, scheme_t scheme, const reference_t *ref, double dt,
                 double tolerance) {
  sim_t *s = &run->sim;
  const ref_problem_t *problem = ref->problem;
  ref_machine_t q = problem->machine;
  ref_prepare(&q);
  const ref_state_t start = ref_problem_start(problem, &q);
  const real h = problem->v != 0 ? ref_slip(&q, start).h : problem->h;
  run->scheme = scheme;
  run->scene = scene_of(ref, (tf_real_t)dt);
  run->scene.params.tolerance = (tf_real_t)tolerance;
  run->scene.params.segments = TF_LOCATED_MAX_SEGMENTS;
  *s = sim_of(&run->scene.params);
  s->u = tf_scene_input(&run->scene, &s->k, 0);
  s->x = (tf_state_t){.r = (tf_real_t)start.r,
                      .v = (tf_real_t)ref_v(&q, start),
                      .w = (tf_real_t)problem->omega,
                      .mode = (uint8_t)ref->begins};
  /* Where h depends on v, v is rounded to that h. */
  tf_speed_for_slip(&s->k, s->x.r, s->x.w, s->u.omega0, (tf_real_t)h, &s->x.v);
  CHECK(sim_begin(s) == TF_OK);
  /* A float does not know the side of so small an h. */
  if (!IS_DOUBLE && fabsl(h) < 1e-6L)
    return CHECK(fabsl((real)s->report.slip.h) < 1e-6L);
  return CHECK(s->x.mode == ref->begins);
}

static tf_status_t step(run_t *run) {
  sim_t *s = &run->sim;
  s->u = tf_scene_input(&run->scene, &s->k, s->x.tick + 1);
  return sim_step(s, run->scheme);
}

/* Time from one sixteenth of a reference to the next. */
static double sixteenth_of(const reference_t *ref) {
  return (double)ref->problem->t_grid / REF_SIXTEENTHS;
}

/* Largest error where the reference has a state, n steps a sixteenth. */
static double error_of(scheme_t scheme, const reference_t *ref, int n,
                       double tolerance, int *coarse) {
  const double dt = sixteenth_of(ref) / n;
  double worst = 0;
  run_t run;
  const tf_state_t *x = &run.sim.x;
  if (!begin(&run, scheme, ref, dt, tolerance)) return INFINITY;
  for (int i = 0; i < ref->states; i++) {
    const reference_state_t *want = &ref->state[i];
    const uint32_t end = (uint32_t)lround((double)want->t / dt);
    while (x->tick < end) {
      const tf_status_t status = step(&run);
      if (!CHECK(status >= TF_OK)) return INFINITY;
      *coarse += !ok_to_resolution(status);
    }
    worst = fmax(worst, fabs((double)((real)x->r - want->r)));
    worst = fmax(worst, fabs((double)((real)x->v - want->v)));
    worst = fmax(worst, fabs((double)((real)x->w - want->w)));
  }
  return worst;
}

/* The geometric mean over steps of nearly one length: a single step that turns
 * beside h = g = 0 may be off by more, and says so. */
static double group_error(const reference_t *ref, double dt) {
  double worst = 0, sum = 0;
  long steps = 0;
  int coarse = 0;
  for (int i = 0; i < GROUP; i++) {
    const int n = (int)(sixteenth_of(ref) / dt * (1 + 0.37 * i / GROUP));
    const double error = error_of(MOREAU, ref, n, finest, &coarse);
    worst = fmax(worst, error);
    sum += log(error);
    steps += (long)n * REF_SIXTEENTHS;
  }
  /* One step in a thousand may turn beside h = g = 0 and say so; in float,
   * where they are up to 19 ms long, one in thirty may, or end a slip by an
   * impulse. Beyond that the steps are too long for the motion. */
  if (!CHECK((IS_DOUBLE ? 1000L : 33L) * coarse < steps || worst > 1))
    printf("#   %s: %d of %ld steps are coarse\n", ref->problem->name, coarse,
           steps);
  const double mean = exp(sum / GROUP);
  CHECK_BELOW(worst, 20 * mean);
  return mean;
}

TEST(errors_fall_with_the_step) {
  const double ratio = IS_DOUBLE ? 32 : 8, longest = IS_DOUBLE ? 2e-4 : 16e-4;
  for (int i = 0; i < REF_PROBLEMS; i++) {
    const reference_t *ref = reference_course(i);
    const double coarse = longest * (double)ref->problem->t_grid,
                 fine = coarse / ratio;
    const double first = group_error(ref, coarse);
    const double second = group_error(ref, fine);
    const double order = log(first / second) / log(ratio);
    printf("# %-12s error %.2e at dt = %.2e, %.2e at dt = %.2e: order %.2f\n",
           ref->problem->name, first, coarse, second, fine, order);
    /* In float the rounding of some thousand steps stands beside the scheme. */
    CHECK(IS_DOUBLE ? order >= 0.9 : order >= 0.5 || second <= 1e-4);
  }
}

/* The modes in the order in which they come. What lasts one single step is no
 * phase of the motion: a step of stick within a crossing of h = 0, and with
 * law `string` the sign of h next to h = g = 0, where its force is the stiffer
 * the smaller g and h changes its sign from step to step. */
static int phases_of(scheme_t scheme, const reference_t *ref, double dt,
                     unsigned phase[PHASES]) {
  const double end = (double)ref->t_last * (1 - 1e-3);
  int length[PHASES] = {0}, n = 1;
  run_t run;
  const tf_state_t *x = &run.sim.x;
  if (!begin(&run, scheme, ref, dt, finest)) return 0;
  phase[0] = x->mode;
  while (n < PHASES && ((double)x->tick + 1) * dt < end) {
    if (!CHECK(step(&run) >= TF_OK)) return n;
    if (x->mode != phase[n - 1]) {
      if (n > 1 && length[n - 1] == 1) n--;
      if (x->mode != phase[n - 1]) {
        phase[n] = x->mode;
        length[n++] = 0;
      }
    }
    length[n - 1]++;
  }
  return n;
}

static int is_order_of(const unsigned *got, int n, const unsigned *want,
                       int m) {
  int same = 0;
  while (same < n && same < m && got[same] == want[same]) same++;
  /* Steps of float are 1 ms: they may see one event after the last too soon. */
  return same == m && n <= m + (IS_DOUBLE ? 0 : 1);
}

static void check_phases(scheme_t scheme, const reference_t *ref) {
  unsigned got[PHASES], want[PHASES];
  const int n = phases_of(scheme, ref, IS_DOUBLE ? 1e-4 : 1e-3, got);
  int m = 0;
  want[m++] = ref->begins;
  for (int j = 0; j < ref->events && m < PHASES; j++) {
    const unsigned after = ref->event[j].after;
    if (after < TF_MODES && after != want[m - 1]) want[m++] = after;
  }
  /* A float does not know the side of so small an h: it begins on the other, or
   * as the motion goes on. */
  const int either = !IS_DOUBLE && ref->problem->v == 0 &&
                     fabsl(ref->problem->h) < 1e-6L && n > 1 && m > 1;
  if (!CHECK(is_order_of(got, n, want, m) ||
             (either && (is_order_of(got + 1, n - 1, want, m) ||
                         is_order_of(got, n, want + 1, m - 1)))))
    printf("#   %s: %d phases, %d of the reference\n", ref->problem->name, n,
           m);
}

static int is_located(const reference_t *ref) {
  const tf_tyre_law_t law = law_of(ref);
  return law == TF_TYRE_JUMP || law == TF_TYRE_COULOMB || law == TF_TYRE_NONE;
}

TEST(events_come_in_the_order_of_the_reference) {
  for (int i = 0; i < REF_PROBLEMS; i++) {
    const reference_t *ref = reference_course(i);
    check_phases(MOREAU, ref);
    if (is_located(ref)) check_phases(LOCATED, ref);
  }
}

/* The tolerance sets the error, not the step, and after every event. */
TEST(located_steps_keep_to_the_reference) {
  /* From one grid time to the next: what drives has its knots between steps. */
  static const int steps[2] = {90, 720};
  for (int i = 0; i < REF_PROBLEMS; i++) {
    const reference_t *ref = reference_course(i);
    if (!is_located(ref)) continue;
    for (int j = 0; j < 2; j++) {
      int coarse = 0;
      const double error = error_of(LOCATED, ref, steps[j], finest, &coarse);
      printf("# %-12s error %.2e at dt = %.2e, %d coarse\n", ref->problem->name,
             error, sixteenth_of(ref) / steps[j], coarse);
      CHECK(error <= (IS_DOUBLE ? 2e-9 : 5e-4));
      CHECK(coarse == 0);
    }
  }
}

/* Errors at each tolerance past a kink of F and two crossings of h = 0, in the
 * first half second of `crossings`: the worst of several step sizes near by,
 * because an event falls anywhere in a step. They fall with the tolerance, and
 * stay near it. */
TEST(located_error_follows_the_tolerance) {
  if (!IS_DOUBLE) SKIP("rounding of float hides the error of the series");
  reference_t ref = *reference_course(REF_PROBLEMS - 2);
  CHECK(!strcmp(ref.problem->name, "crossings"));
  ref.states = 1;
  for (int n = 3; n <= 300; n *= 10) {
    double before = INFINITY;
    for (double tolerance = 1e-5; tolerance > 1e-12; tolerance /= 100) {
      double worst = 0;
      int coarse = 0;
      for (int k = 0; k < 16; k++)
        worst = fmax(worst, error_of(LOCATED, &ref, n + k, tolerance, &coarse));
      printf("# %d steps a sixteenth, tolerance %.0e: error %.2e\n", n,
             tolerance, worst);
      CHECK(coarse == 0 && worst <= 500 * tolerance + 1e-12);
      CHECK(worst <= before / 5 || worst <= 10 * tolerance);
      before = worst;
    }
  }
}
