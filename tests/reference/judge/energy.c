/// @file
/// Runs whose steps with status OK end with more energy than the most that any
/// force within the law, and the inputs, can account for: springs as stiff as
/// they may be, and passages of r = 0.
#include <math.h>

#include "judge.h"

enum { STEPS = 200, REALS = 2 };
static const char *const kinds[] = {"k2", "r=0"};
enum { KINDS = sizeof kinds / sizeof *kinds };
static const lib_real_t *const reals[REALS] = {&lib_f64, &lib_f32};
static count_t *creates[KINDS][LIB_SCHEMES][REALS];

static double energy_of(const lib_machine_t *q, const lib_row_t *x) {
  const ref_machine_t k = {PARAMETERS_OF(long double, q)};
  return (double)ref_energy(&k, x->r, x->v - q->d * x->w, x->w, x->r - q->r0);
}

// The most that friction can put in: |F| <= 4 mu/3, |M| <= kappa mu, at the
// larger of the speeds of both ends.
static double most(const lib_machine_t *q, const lib_row_t *a,
                   const lib_row_t *b) {
  const double v = fmax(fabs(a->v), fabs(b->v));
  const double w = fmax(fabs(a->w), fabs(b->w));
  const double r = fmax(fabs(a->r), fabs(b->r));
  const double s = fabs(sin(q->gamma)), c = fabs(cos(q->gamma));
  return q->dt * q->mu *
         (4 * (s * v + (r * c + q->d * s) * w) / 3 + q->kappa * w);
}

// Noise of the energy in the numbers of the state, and of its differences.
static double noise(const lib_machine_t *q, const lib_row_t *x, double e) {
  const double p = fabs(x->v) + fabs(q->d * x->w);
  return 32 * e *
         (q->m * p * p +
          q->k2 * (fabs(x->r) + fabs(q->r0)) * (fabs(x->r) + fabs(q->r0)) +
          energy_of(q, x));
}

static lib_machine_t machine_of(draw_t *draw, int kind) {
  lib_machine_t q = draw_machine(draw, false);
  q.dt = (float)draw_log(draw, 1e-5, 0.1);
  if (kind == 0) {
    q.k2 = (float)draw_log(draw, 1, 1e10);
  } else { // past r = 0 within about one step
    q.beta = (float)draw_log(draw, 1e-3, 0.1);
    q.v = (float)(draw_uniform(draw, 0.2, 2) * q.beta / q.dt);
    q.r = (float)(-draw_uniform(draw, 0.5, 3) * q.v * q.dt);
    q.on_surface = false;
  }
  return q;
}

typedef struct {
  const lib_machine_t *machine;
  double epsilon, sum; // of the energy that steps created, as shares
  lib_row_t before;
  bool begun;
} account_t;

static void enter(void *context, int status, const lib_row_t *row) {
  account_t *a = context;
  if (a->begun) {
    const double E = energy_of(a->machine, &a->before);
    const double put_in = most(a->machine, &a->before, row);
    const double rounding = noise(a->machine, row, a->epsilon) +
                            noise(a->machine, &a->before, a->epsilon);
    const double over = energy_of(a->machine, row) - E - put_in;
    if (status == 0 && over > rounding) a->sum += over / (E + put_in + 1e-12);
  }
  a->before = *row;
  a->begun = true;
}

static void judge(trial_t *trial) {
  for (int i = 0; i < KINDS * LIB_SCHEMES * REALS; ++i) {
    const int kind = i / REALS / LIB_SCHEMES, scheme = i / REALS % LIB_SCHEMES;
    const lib_real_t *real = reals[i % REALS];
    lib_row_t row;
    trial->draw =
        draw_begin(trial->options->seed, (uint64_t)(2 * trial->index + kind));
    trial->machine = machine_of(&trial->draw, kind);
    trial->t_end = STEPS * trial->machine.dt;
    account_t account = {.machine = &trial->machine, .epsilon = real->epsilon};
    real->run(&trial->machine, (lib_scheme_t)scheme, trial->t_end, &row, enter,
              &account);
    if (account.begun)
      count_try(creates[kind][scheme][i % REALS], trial, account.sum > 1e-2);
  }
}

static int run(const options_t *options) {
  for (int i = 0; i < KINDS * LIB_SCHEMES * REALS; ++i) {
    const int kind = i / REALS / LIB_SCHEMES, scheme = i / REALS % LIB_SCHEMES;
    const char *name = lib_scheme_names[scheme];
    creates[kind][scheme][i % REALS] =
        count_add(name, "%-3s %-11s %-6s runs: 1e-2 in all", kinds[kind], name,
                  reals[i % REALS]->name);
  }
  judge_machines(options, judge);
  return 0;
}

const command_t command_energy = {"energy", "energy from nothing", 2000, 0,
                                  run};
