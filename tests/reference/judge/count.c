/// @file
/// Counting offenders; see classes.h.
#include <math.h>
#include <stdio.h>

#include "classes.h"

void count_try(count_t *count, bool hit, const options_t *options, long index,
               const lib_machine_t *machine, double t_end, const char *scheme) {
  ++count->tries;
  count->hits += hit;
  if (hit && count->shown < options->show) {
    ++count->shown;
    printf("# %s, machine %ld:\n  ", count->what, index);
    draw_print(machine, t_end, scheme);
  }
}

void count_print(const count_t *count) {
  const double n = (double)count->tries, z = 1.959964;
  if (count->tries == 0) {
    printf("%-50s %9d of %9d\n", count->what, 0, 0);
    return;
  }
  const double p = (double)count->hits / n, z2 = z * z;
  const double mid = (p + z2 / (2 * n)) / (1 + z2 / n);
  const double half =
      z * sqrt(p * (1 - p) / n + z2 / (4 * n * n)) / (1 + z2 / n);
  printf("%-50s %9ld of %9ld  %9.3g %%  [%.3g, %.3g]\n", count->what,
         count->hits, count->tries, 100 * p, 100 * fmax(0, mid - half),
         100 * (mid + half));
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

long class_steps(const lib_table_t *real, lib_t *lib, long steps,
                 lib_row_t *row) {
  long others = 0;
  for (long i = 0; i < steps; ++i) {
    const int status = real->step(lib, row);
    if (status < 0) {
      return -1;
    }
    others += status != 0;
  }
  return others;
}

long class_run(const lib_table_t *real, const lib_machine_t *machine,
               lib_scheme_t scheme, double end, lib_row_t *row) {
  lib_t lib;
  if (real->open(&lib, machine, scheme, row) < 0) {
    return -1;
  }
  return class_steps(real, &lib, lround(end / machine->dt), row);
}
