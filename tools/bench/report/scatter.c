// After the two-fold the future is not unique, and under the rule `random` two
// schemes cannot follow the same path: they have to agree in distribution.
//
//   scatter reference SECONDS FILE RUNS   writes r at so many seconds after the
//                       two-fold, of many runs of the located scheme, finely
//   scatter distance SECONDS FILE RUNS    Kolmogorov-Smirnov distances, CSV
//   scatter quantiles SECONDS FILE RUNS   quantiles of some settings, CSV
//
// Every run has a seed of its own; none of the reference is used again.
#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/steps/timing.h"
#include "part.h"

#define MOST 40000
// What randomises: a kick at the two-fold, h uniform within so many m/s, and
// the rule with its rate. Without a kick the rule alone decides nothing: a
// wheel on the escaping stick stands on a knife's edge and falls within a step
// or two, to the side that rounding takes.
#define KICK 1e-3
static double length; // [s] of motion after the two-fold
static const char *const problem = "chaos";

typedef struct {
  int n, refused;
  double ns; // of one run
  double r[MOST];
} sample_t;

// A machine at the two-fold; the part's own start is not used.
static int begin(run_t *run, scheme_t scheme, long steps, double tolerance,
                 uint32_t seed, double kick) {
  truth_state_t at;
  tf_params_t params;
  tf_machine_t *machine = &run->machine.machine;
  if (!truth_twofold(problem, &at) || !truth_params(problem, &params)) return 0;
  *run = (run_t){.scheme = scheme};
  params.dt = (tf_real_t)(length / (double)steps);
  params.tolerance = (tf_real_t)tolerance;
  params.rule = TF_RULE_RANDOM;
  if (tf_prepare(machine, &params, NULL) != TF_OK) return 0;
  run->input = tf_input_default(machine);
  run->state.r = (tf_real_t)at.x[0];
  run->state.w = (tf_real_t)at.x[2];
  run->state.seed = seed;
  run->state.mode = kick > 0 ? TF_SLIP_PLUS : TF_SLIP_MINUS;
  return tf_speed_for_slip(machine, run->state.r, run->state.w,
                           run->input.omega0, (tf_real_t)kick,
                           &run->state.v) == TF_OK &&
         tf_begin(machine, &run->state, &run->input, &run->report) == TF_OK;
}

static void draw(sample_t *out, scheme_t scheme, long steps, double tolerance,
                 int runs, uint32_t first_seed) {
  out->n = out->refused = 0;
  const double start = timing_wall();
  for (int i = 0; i < runs; i++) {
    const uint32_t seed = first_seed + (uint32_t)i;
    const double kick = KICK * (2 * part_random(902, seed) - 1);
    run_t run;
    int goes_on = begin(&run, scheme, steps, tolerance, seed, kick);
    for (long k = 0; k < steps && goes_on; k++) goes_on = part_step(&run) >= 0;
    if (goes_on)
      out->r[out->n++] = (double)run.state.r;
    else
      out->refused++;
  }
  out->ns = 1e9 * (timing_wall() - start) / runs;
  timing_sort(out->r, (size_t)out->n);
}

// Kolmogorov and Smirnov: the largest difference of the two distributions.
static double distance(const sample_t *a, const sample_t *b) {
  double worst = 0;
  int i = 0, j = 0;
  while (i < a->n && j < b->n) {
    const double x = a->r[i] < b->r[j] ? a->r[i] : b->r[j];
    while (i < a->n && a->r[i] <= x) i++;
    while (j < b->n && b->r[j] <= x) j++;
    worst = fmax(worst, fabs((double)i / a->n - (double)j / b->n));
  }
  return a->n && b->n ? worst : 1;
}

static sample_t reference, other;

static int read_reference(const char *name) {
  FILE *file = fopen(name, "r");
  if (!file) return 0;
  while (reference.n < MOST &&
         fscanf(file, "%lf", &reference.r[reference.n]) == 1)
    reference.n++;
  fclose(file);
  return reference.n > 0;
}

static int write_reference(const char *name, int runs) {
  FILE *file = fopen(name, "w");
  if (!file) return 0;
  draw(&reference, LOCATED, 2000, 1e-12, runs, 1);
  for (int i = 0; i < reference.n; i++)
    fprintf(file, "%.17g\n", reference.r[i]);
  return fclose(file) == 0;
}

static void print_row(scheme_t scheme, const char *dial, long steps,
                      double tolerance, int runs) {
  static uint32_t seed = 1000000;
  draw(&other, scheme, steps, tolerance, runs, seed);
  seed += (uint32_t)runs;
  // 95 %: 1.358 of the two samples together.
  printf("%g,%s,%s,%s,%.4e,%.1e,%d,%d,%.5f,%.5f,%.0f,%d\n", length,
         scheme_names[scheme], REAL, dial, length / (double)steps, tolerance,
         other.n, reference.n, distance(&reference, &other),
         1.358 * sqrt(1. / (other.n + 1e-9) + 1. / reference.n), other.ns,
         other.refused);
}

static void compare(int runs) {
  for (int i = 0; i < 11; i++) {
    const double shift = part_random(900, (unsigned)i) - 0.5;
    print_row(MOREAU, "dt", lrint(6 * pow(2, i + shift)), 1e-8, runs);
  }
  for (int i = 0; i < 9; i++) {
    const double shift = part_random(901, (unsigned)i) - 0.5;
    print_row(LOCATED, "dt", lrint(3 * pow(1.9, i + shift)), 1e-8, runs);
  }
  for (int i = 0; i < 4; i++)
    print_row(LOCATED, "tolerance@1ms", lrint(1e3 * length),
              pow(10, -3 - 2 * i), runs);
}

static double quantile(const sample_t *s, double p) {
  const int i = (int)(p * s->n);
  return s->n ? s->r[i < s->n ? i : s->n - 1] : (double)NAN;
}

static void quantiles(int runs) {
  static sample_t set[3];
  draw(&set[0], MOREAU, lrint(length / 4e-3), 1e-8, runs, 3000000);
  draw(&set[1], MOREAU, lrint(length / 1e-4), 1e-8, runs, 4000000);
  draw(&set[2], LOCATED, lrint(length / 1e-2), 1e-8, runs, 5000000);
  printf("p,reference,moreau 4 ms,moreau 0.1 ms,located 10 ms\n");
  for (int i = 0; i <= 400; i++) {
    const double p = i / 400.0;
    printf("%g,%.9g,%.9g,%.9g,%.9g\n", p, quantile(&reference, p),
           quantile(&set[0], p), quantile(&set[1], p), quantile(&set[2], p));
  }
}

int main(int argc, char **argv) {
  const char *const what = argc == 5 ? argv[1] : "";
  const int makes = strcmp(what, "reference") == 0;
  const int shows = strcmp(what, "quantiles") == 0;
  const int runs = argc == 5 ? atoi(argv[4]) : 0;
  length = argc == 5 ? strtod(argv[2], NULL) : 0;
  if (!(makes || shows || strcmp(what, "distance") == 0) || runs < 1 ||
      runs > MOST || !(length > 0)) {
    fputs("usage: scatter reference|distance|quantiles SECONDS FILE RUNS\n",
          stderr);
    return 2;
  }
  if (makes ? !write_reference(argv[3], runs) : !read_reference(argv[3])) {
    fprintf(stderr, "%s: not a reference\n", argv[3]);
    return 1;
  }
  if (shows) quantiles(runs);
  if (!makes && !shows) compare(runs);
  return 0;
}
