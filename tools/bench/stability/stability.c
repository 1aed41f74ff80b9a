// Runs every cell of every sweep in the real type of this build and prints one
// row a cell, as harness.c does: the error is the largest energy in units of
// what the machine was given.
//
//   stability [SWEEP...]   these sweeps, or all
#include <stdio.h>
#include <string.h>

#include "bench/own.h"
#include "cell.h"

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
