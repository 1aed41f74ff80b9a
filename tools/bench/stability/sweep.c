// Runs every cell of every sweep in the real type of this build and prints one
// line of CSV a cell, in the order of the header below.
//
//   sweep [SWEEP...]    these sweeps, or all
//   sweep --list        name|axis|unit|what differs from scene chaos, a line
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

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

// The codes by their names in status.h: tf_status_name has words with commas.
static const char *code(tf_status_t status) {
  static const char *const refusals[] = {"", "TF_BAD_PARAMETER", "TF_BAD_STATE",
                                         "TF_DIVERGED", "TF_STEP_TOO_LONG"};
  return status < TF_OK ? refusals[-(int)status] : "";
}

#define STEP_SIZES 11 // 1e-6 to 1e-1 s, two a decade

static void print_cell(const sweep_t *sweep, int i, const char *scheme,
                       double dt, const cell_t *cell) {
  static const char *const real = sizeof(tf_real_t) == 4 ? "float" : "double";
  if (sweep->per_decade == 0 && strcmp(sweep->name, "scenes") == 0)
    printf("%s,%d,%s,", sweep->name, i, tf_scenes[i]->name);
  else
    printf("%s,%d,%.3g,", sweep->name, i, sweep_value(sweep, i));
  printf("%s,%s,%.3g,%s,", real, scheme, dt, cell_verdict_names[cell->verdict]);
  printf("%s,%s,", code(cell->status), code(cell->finer));
  printf("%ld,%ld,%ld,%ld,", cell->steps, cell->degraded, cell->fell_back,
         cell->sticks);
  printf("%.3Lg,%.4Lg,%d,%d,", cell->stick, cell->excess, cell->grows,
         cell->conservative);
  printf("%.3Lg,%.3Lg,%.3Lg,%.3Lg,%ld\n", cell->drift[0], cell->drift[1],
         cell->end_drift, cell->largest, cell->coarse);
}

#define LOG_EVERY 10 // [s] between two lines of progress
#define SCHEMES (sizeof schemes / sizeof *schemes)

// How much is done, in cases under a scheme: each has all step sizes.
static struct {
  long done, all;
  time_t started, told;
} progress;

static void tell_progress(void) {
  const time_t now = time(NULL);
  progress.done++;
  if (difftime(now, progress.told) < LOG_EVERY) return;
  const double share = (double)progress.done / (double)progress.all;
  const double spent = difftime(now, progress.started);
  progress.told = now;
  fprintf(stderr, "stability, %s: %ld of %ld cases, %.0f s left\n",
          sizeof(tf_real_t) == 4 ? "float" : "double", progress.done,
          progress.all, spent * (1 - share) / share);
}

static void run_sweep(const sweep_t *sweep) {
  for (int i = 0; i < sweep->count; i++) {
    case_t c;
    sweep_case(sweep, i, &c);
    for (size_t s = 0; s < SCHEMES; s++, tell_progress()) {
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

int main(int argc, char **argv) {
  int run = 0;
  if (argc == 2 && strcmp(argv[1], "--list") == 0) return list();
  puts(
      "sweep,index,value,real,scheme,dt,verdict,refusal,finer,steps,degraded,"
      "fell_back,sticks,stick_drift,energy_excess,grows,conservative,"
      "drift_first_half,drift_second_half,drift_end,largest,coarse");
  for (int i = 0; i < SWEEPS; i++)
    if (wanted(sweeps[i].name, argc, argv))
      progress.all += sweeps[i].count * (long)SCHEMES;
  progress.started = progress.told = time(NULL);
  for (int i = 0; i < SWEEPS; i++) {
    if (!wanted(sweeps[i].name, argc, argv)) continue;
    run_sweep(&sweeps[i]);
    run++;
  }
  if (run == 0) fputs("no sweep has that name; see cases.c\n", stderr);
  return run == 0 || ferror(stdout) ? 2 : 0;
}
