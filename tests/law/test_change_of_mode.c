/* A step that loses its slip is of second order, as a common one is: the
 * located step judges. */
#include "sim.h"

enum { MOTIONS = 500, SIZES = 3 };

/* How the inputs move: not at all, omega0 along a ramp, force, torque and r0 by
 * jumps where a step of any size begins. */
typedef enum { HELD, RAMP, JUMPS, MOVES } moves_t;
static const char *const move_names[MOVES] = {"held inputs", "a ramp of omega0",
                                              "jumps of the inputs"};

typedef struct {
  tf_params_t params;
  tf_state_t start;
  double alpha;
  tf_input_t jump; /* what each of four jumps adds */
} case_t;

static case_t draw_case(moves_t moves) {
  case_t m = {.params = wide_params()};
  tf_params_t *p = &m.params;
  p->beta = log_uniform(0.05, 0.5);
  p->d = uniform(-1, 1);
  p->c1 = log_uniform(1e-3, 0.3);
  p->c2 = log_uniform(1e-3, 0.3);
  p->rest = (tf_rest_law_t)(tap_bits() % TF_REST_LAWS);
  p->tolerance = TF_R(1e-12);
  p->segments = 0;
  m.start = (tf_state_t){.r = uniform(-0.5, 0.5),
                         .v = uniform(-1, 1),
                         .w = uniform(-1, 1),
                         .mode = TF_NO_MODE};
  if (moves == RAMP) m.alpha = uniform(-2, 2);
  if (moves == JUMPS)
    m.jump = (tf_input_t){.force = uniform(-1, 1),
                          .torque = uniform(-0.3, 0.3),
                          .r0 = uniform(-0.1, 0.1)};
  return m;
}

/* The motion over a second. lost: slips that are lost. Returns: whether it
 * stays away from h = g = 0, where the order of a step is another matter. */
static bool run_case(const case_t *m, double dt, scheme_t scheme, sim_t *s,
                     int *lost) {
  tf_params_t p = m->params;
  p.dt = (tf_real_t)dt;
  *s = sim_of(&p);
  s->x = m->start;
  s->u.alpha = (tf_real_t)m->alpha;
  if (sim_begin(s) != TF_OK) return false;
  const long steps = lround(1 / dt);
  for (long n = 0; n < steps; n++) {
    if (n > 0 && n % (steps / 5) == 0) {
      s->u.force += m->jump.force;
      s->u.torque += m->jump.torque;
      s->u.r0 += m->jump.r0;
    }
    s->u.omega0 += s->u.alpha * s->k.dt;
    const uint8_t before = s->x.mode;
    const tf_status_t status = sim_step(s, scheme);
    if (status < TF_OK || (scheme == LOCATED && status != TF_OK)) return false;
    *lost += tf_mode_is_slip(before) && s->x.mode != before;
    if (s->x.mode == TF_PINNED ||
        hypot((double)s->report.slip.h, (double)s->report.slip.g) < 1e-2)
      return scheme != LOCATED;
  }
  return true;
}

/* Errors at 4, 2 and 1 ms. False where the motion is not one to judge. */
static bool errors_of(const case_t *m, double error[SIZES]) {
  sim_t exact, s;
  int lost = 0, none = 0;
  if (!run_case(m, 1e-3, LOCATED, &exact, &lost) || lost == 0) return false;
  for (int i = 0; i < SIZES; i++) {
    if (!run_case(m, 4e-3 / (1 << i), MOREAU, &s, &none)) return false;
    error[i] = sim_apart(&s.x, &exact.x);
  }
  return error[0] > 0 && error[0] < 0.05 && error[SIZES - 1] > 0;
}

static int by_size(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* In float rounding stands beside the scheme: there only errors are judged. */
TEST(a_lost_slip_is_of_second_order) {
  for (moves_t moves = HELD; moves < MOVES; moves++) {
    static double order[MOTIONS], last[MOTIONS];
    const int motions = samples(MOTIONS) < MOTIONS ? samples(MOTIONS) : MOTIONS;
    for (int n = 0; n < motions;) {
      const case_t m = draw_case(moves);
      double error[SIZES];
      if (!errors_of(&m, error)) continue;
      order[n] = log2(error[0] / error[SIZES - 1]) / (SIZES - 1);
      last[n++] = error[SIZES - 1];
    }
    qsort(order, (size_t)motions, sizeof *order, by_size);
    qsort(last, (size_t)motions, sizeof *last, by_size);
    const double quarter = order[motions / 4], median = order[motions / 2];
    printf(
        "# %d motions with %s: order %.2f (a quarter less than %.2f), "
        "error at 1 ms %.1e\n",
        motions, move_names[moves], median, quarter, last[motions / 2]);
    CHECK(last[motions / 2] < 1e-4);
    if (IS_DOUBLE) CHECK(quarter >= 1.7 && median >= 1.9);
  }
}
