// Cells of the map, with rows as of harness.c.
//
//   stability [SWEEP...]   every cell of these sweeps, or of all, in the real
//                          type of this build: the error is the largest energy
//                          in units of what the machine was given
//   map                    stability and accuracy in one: what the steps of a
//                          run say and how far it ends from the motion, over
//                          the step and one parameter
//
// In the map the error is the distance of the end x from the end y of the
// motion in the norm of the energy, sqrt(E(x - y) / max(E(y), E(start))). So a
// spring that loses its energy is wrong, and one that loses its phase as well.
// y is the end of the located step where that of half its step is within a
// thousandth of it; where none is, the error is not a number. The verdict is
// the worst that a step said; of a refusal the error is 1.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../../../tests/reference/reference.h"
#include "bench/own.h"
#include "cell.h"

#define LENGTH 0.4 // [s]
#define FIRST 4000 // steps of the motion, to begin with ...
#define HALVINGS 7 // ... and how often they are halved at most
#define NEAR 1e-3  // error of y

static const struct {
  const char *sweep;
  int low, high; // powers of ten
} maps[] = {{"k2_rest", -2, 8}, {"conservative", -2, 8}, {"mu", -4, 6}};

typedef struct {
  tf_state_t x;
  tf_status_t said; // the largest, or the refusal that ended it
} end_t;

static end_t run_to_end(const case_t *c, step_t *step, tf_real_t theta,
                        tf_real_t tolerance, long n) {
  end_t end;
  tf_machine_t k;
  case_t within = *c;
  memset(&end, 0, sizeof end);
  within.params.tolerance = tolerance;
  end.said =
      cell_begin(&within, theta, (tf_real_t)(LENGTH / (double)n), &k, &end.x);
  for (long i = 0; i < n && end.said >= TF_OK; i++) {
    const tf_input_t u = tf_input_default(&k);
    tf_report_t report;
    const tf_status_t said = step(&k, &end.x, &u, &report);
    if (said < TF_OK || said > end.said) end.said = said;
  }
  return end;
}

// Of velocities at r, and of a spring that is stretched by s.
static double energy(const tf_params_t *p, double r, double v, double w,
                     double s) {
  const ref_machine_t q = {PARAMETERS_OF(ref_real_t, p)};
  const ref_real_t speed = (ref_real_t)(v - (double)p->d * w);
  return (double)ref_energy(&q, (ref_real_t)r, speed, (ref_real_t)w,
                            (ref_real_t)s);
}

static double distance(const tf_params_t *p, const tf_state_t *x,
                       const tf_state_t *y, double E0) {
  const double r = (double)y->r;
  const double E = energy(p, r, (double)y->v, (double)y->w, r - (double)p->r0);
  return sqrt(energy(p, r, (double)x->v - (double)y->v,
                     (double)x->w - (double)y->w, (double)x->r - r) /
              fmax(E, E0));
}

// The end of the motion. Returns 0 where it is not found.
static int find_end(const case_t *c, double E0, tf_state_t *y) {
  end_t coarse = {.said = TF_BAD_STATE};
  for (int i = 0; i <= HALVINGS; i++) {
    const end_t fine = run_to_end(c, tf_step_located, TF_R(0.5), TF_R(1e-10),
                                  (long)FIRST << i);
    *y = fine.x;
    if (i > 0 && fine.said >= TF_OK && coarse.said >= TF_OK &&
        distance(&c->params, &coarse.x, y, E0) < NEAR)
      return 1;
    coarse = fine;
  }
  return 0;
}

static const char *verdict(tf_status_t said) {
  static const char *const names[] = {"ok", "degraded", "fell_back", "coarse",
                                      "stalled"};
  return said < TF_OK ? "refused" : names[said];
}

static void run_value(const case_t *c, const char *sweep, double value) {
  tf_machine_t k;
  tf_state_t start, y;
  if (cell_begin(c, c->params.theta, c->params.dt, &k, &start) != TF_OK) return;
  const double E0 =
      energy(&c->params, (double)start.r, (double)start.v, (double)start.w,
             (double)start.r - (double)c->params.r0);
  const int found = find_end(c, E0, &y);
  for (int s = 0; s < CELL_SCHEMES; s++) {
    for (int i = 0; i < CELL_DTS; i++) {
      const long n = lround(LENGTH / cell_dt(i));
      const end_t end = run_to_end(c, cell_schemes[s].step,
                                   cell_schemes[s].theta, TF_R(1e-8), n);
      const double error = !found ? (double)NAN
                           : end.said < TF_OK
                               ? 1
                               : distance(&c->params, &end.x, &y, E0);
      printf("map %s=%.3g,%s,dt=%.3g,%.3e,%s\n", sweep, value,
             cell_schemes[s].name, cell_dt(i), error, verdict(end.said));
    }
  }
}

int map_main(int argc, char **argv) {
  (void)argv;
  for (size_t m = 0; m < sizeof maps / sizeof *maps && argc == 1; m++) {
    int s = 0;
    while (strcmp(sweeps[s].name, maps[m].sweep) != 0) s++;
    for (int power = maps[m].low; power <= maps[m].high; power++) {
      const double value = pow(10, power);
      case_t c;
      sweep_case(&sweeps[s], 0, &c);
      sweeps[s].set(&c, (tf_real_t)value);
      run_value(&c, maps[m].sweep, value);
    }
  }
  return argc == 1 ? 0 : 2;
}

static void print_cell(const sweep_t *sweep, int i, const char *scheme,
                       double dt, const cell_t *cell) {
  if (strcmp(sweep->name, "scenes") == 0)
    printf("%s=%s", sweep->name, tf_scenes[i]->name);
  else
    printf("%s=%.3g", sweep->name, sweep_value(sweep, i));
  printf(",%s%s,dt=%.3g,%.4Lg,%s\n", scheme,
         sizeof(tf_real_t) == 8 ? "" : " float", dt, cell->excess,
         cell_verdict_names[cell->verdict]);
}

static void run_sweep(const sweep_t *sweep) {
  for (int i = 0; i < sweep->count; i++) {
    case_t c;
    sweep_case(sweep, i, &c);
    for (int s = 0; s < CELL_SCHEMES; s++) {
      const cell_scheme_t *scheme = &cell_schemes[s];
      for (int n = 0; n < CELL_DTS; n++) {
        const double dt = cell_dt(n);
        const cell_t cell =
            cell_run(&c, scheme->step, scheme->theta, (tf_real_t)dt);
        print_cell(sweep, i, scheme->name, dt, &cell);
      }
    }
  }
}

static bool wanted(const char *name, int argc, char **argv) {
  for (int i = 1; i < argc; i++)
    if (strcmp(argv[i], name) == 0) return true;
  return argc == 1;
}

int stability_main(int argc, char **argv) {
  int run = 0;
  for (int i = 0; i < SWEEPS; i++) {
    if (!wanted(sweeps[i].name, argc, argv)) continue;
    run_sweep(&sweeps[i]);
    run++;
  }
  if (run == 0) fputs("no sweep has that name; see cases.c\n", stderr);
  return run == 0;
}
