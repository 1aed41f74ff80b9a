// Runs every cell of every sweep in the real type of this build and prints one
// row a cell, as harness.c does: the error is the largest energy in units of
// what the machine was given.
//
//   stability [SWEEP...]   these sweeps, or all
//   stability --list       sweep|axis|unit|what differs from scene chaos
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bench/own.h"
#include "cell.h"

static const struct {
  const char *name;
  step_t *step;
  tf_real_t theta;
} schemes[] = {
    {"moreau-0.5", tf_step, TF_R(0.5)},
    {"moreau-1", tf_step, TF_R(1.0)},
    {"located", tf_step_located, TF_R(0.5)},
};

#define STEP_SIZES 11 // 1e-6 to 1e-1 s, two a decade

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
    for (size_t s = 0; s < sizeof schemes / sizeof *schemes; s++) {
      for (int n = 0; n < STEP_SIZES; n++) {
        const double dt = pow(10, -6 + n / 2.0);
        const cell_t cell =
            cell_run(&c, schemes[s].step, schemes[s].theta, (tf_real_t)dt);
        print_cell(sweep, i, schemes[s].name, dt, &cell);
      }
    }
  }
}

static bool wanted(const char *name, int argc, char **argv) {
  for (int i = 1; i < argc; i++)
    if (strcmp(argv[i], name) == 0) return true;
  return argc == 1;
}

static int list(void) {
  for (int i = 0; i < SWEEPS; i++)
    printf("%s|%s|%s|%s\n", sweeps[i].name, sweeps[i].axis, sweeps[i].unit,
           sweeps[i].where);
  return 0;
}

int stability_main(int argc, char **argv) {
  int run = 0;
  if (argc == 2 && strcmp(argv[1], "--list") == 0) return list();
  for (int i = 0; i < SWEEPS; i++) {
    if (!wanted(sweeps[i].name, argc, argv)) continue;
    run_sweep(&sweeps[i]);
    run++;
  }
  if (run == 0) fputs("no sweep has that name; see cases.c\n", stderr);
  return run == 0;
}
