/// @file
/// What all subcommands share; see classes.h.
#include <assert.h>
#include <math.h>
#include <stdio.h>

#include "classes.h"

static count_t rows[64];
static int row_count;

count_t *count_add(bool shows, const char *what) {
  assert(row_count < (int)(sizeof rows / sizeof *rows));
  count_t *count = &rows[row_count++];
  snprintf(count->what, sizeof count->what, "%s", what);
  count->scheme = lib_scheme_names[LIB_STEP];
  count->shows = shows;
  return count;
}

void count_try(count_t *count, const trial_t *trial, bool hit) {
  ++count->tries;
  count->hits += hit;
  if (hit && count->shows && count->shown < trial->options->show) {
    ++count->shown;
    printf("# %s, machine %ld:\n  ", count->what, trial->index);
    draw_print(&trial->machine, trial->t_end, count->scheme);
  }
}

// One line: hits, tries, rate and its 95 % interval (Wilson).
static void count_print(const count_t *count) {
  const double n = (double)count->tries, z = 1.959964;
  if (count->tries == 0) {
    printf("%-50s %9d of %9d\n", count->what, 0, 0);
  } else {
    const double p = (double)count->hits / n, z2 = z * z;
    const double mid = (p + z2 / (2 * n)) / (1 + z2 / n);
    const double half =
        z * sqrt(p * (1 - p) / n + z2 / (4 * n * n)) / (1 + z2 / n);
    printf("%-50s %9ld of %9ld  %9.3g %%  [%.3g, %.3g]\n", count->what,
           count->hits, count->tries, 100 * p, 100 * fmax(0, mid - half),
           100 * (mid + half));
  }
}

int class_run(const class_t *class, const options_t *options) {
  if (class->begin) {
    class->begin(class);
  }
  const long end = options->first + options->machines;
  for (long i = options->first; class->judge && i < end; ++i) {
    trial_t trial = {.options = options, .class = class, .index = i};
    trial.draw = draw_begin(options->seed, (uint64_t)i);
    trial.machine = draw_machine(&trial.draw, false);
    trial.t_end = options->t_end > 0 ? options->t_end : class->t_end;
    class->judge(&trial);
  }
  const int code = class->finish ? class->finish(options) : 0;
  for (int i = 0; i < row_count; ++i) {
    count_print(&rows[i]);
  }
  return code;
}

int runs_count(const runs_t *runs) {
  return LIB_SCHEMES * runs->reals * runs->dts;
}

run_t runs_at(const runs_t *runs, int k) {
  const lib_scheme_t scheme = (lib_scheme_t)(k / runs->dts / runs->reals);
  const int real = k / runs->dts % runs->reals;
  const double dt = runs->dt[k % runs->dts];
  return (run_t){scheme, real ? &lib_f32 : &lib_f64,
                 scheme == LIB_LOCATED ? runs->located * dt : dt};
}

void count_runs(count_t *counts[RUNS], const runs_t *runs, const char *kind) {
  for (int k = 0; k < runs_count(runs); ++k) {
    const run_t run = runs_at(runs, k);
    const char *scheme = lib_scheme_names[run.scheme];
    char real[16] = "", dt[32] = "", what[96];
    if (run.dt > 0) {
      snprintf(dt, sizeof dt, "%.0e: ", run.dt);
    }
    if (runs->reals > 1) {
      snprintf(real, sizeof real, "%-6s ", run.real->name);
    }
    snprintf(what, sizeof what, "%s%-11s %s%s%s", runs->group, scheme, real, dt,
             kind);
    counts[k] = count_add(true, what);
    counts[k]->scheme = scheme;
  }
}

long trial_run(trial_t *trial, const runs_t *runs, int k, lib_row_t *row) {
  const run_t run = runs_at(runs, k);
  lib_t lib;
  trial->machine.dt = run.dt;
  if (run.real->open(&lib, &trial->machine, run.scheme, row) < 0) {
    return -1;
  }
  long others = 0;
  for (long n = lround(trial->t_end / run.dt); n > 0; --n) {
    const int status = run.real->step(&lib, row);
    if (status < 0) {
      return -1;
    }
    others += status != 0;
  }
  return others;
}

ref_orbit_t class_orbit(const lib_machine_t *machine, ref_machine_t *q,
                        const lib_table_t *real) {
  ref_orbit_t orbit = {.tolerance = 1e-11L, .law = REF_HEXAGON};
  *q = draw_reference(machine, real);
  ref_begin(&orbit, q, draw_start(machine, q, real), REF_MODES);
  return orbit;
}

double class_difference(const ref_machine_t *q, ref_state_t x,
                        const lib_row_t *row) {
  const real_t w = ref_w(q, x), v = ref_v(q, x);
  const real_t scale = ref_speed_scale(q, x);
  const real_t in_r = fabsl(x.r - row->r) / (fabsl(x.r) + q->beta);
  const real_t in_v = fabsl(v - row->v) / (fabsl(v) + scale);
  const real_t in_w = fabsl(w - row->w) / (fabsl(w) + fabsl(q->omega0));
  const real_t e = fmaxl(in_r, fmaxl(in_v, in_w));
  return e >= 0 ? (double)e : HUGE_VAL;
}

double class_distance(const ref_machine_t *q, ref_state_t a, ref_state_t b) {
  const lib_row_t row = {
      .r = (double)b.r, .v = (double)ref_v(q, b), .w = (double)ref_w(q, b)};
  return class_difference(q, a, &row);
}
