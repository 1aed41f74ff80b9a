// The parts of the motion and how a run begins in one of them.
//
// Borders between branches: of `chaos`, half of how far from the reference a
// wheel ends at t = 1 that stays pinned at h = g = 0; of the others, where the
// motion has one future, an error that large has met other switches.
#include "part.h"

#include <math.h>
#include <stdio.h>

const part_t parts[PARTS] = {
    {"smooth", "(a) smooth slip", "crossings", 0.5L, 0.625L, 1, 0.5},
    {"crossings", "(b) crossings", "crossings", 0, 2, 16, 0.5},
    {"stick", "(c) stick entry and exit", "stickslip", 1.375L, 1.625L, 2, 0.5},
    {"codim2", "(d) through codimension two", "chaos", 0, 1, 8, 6e-3},
    {"approach", "(e) approach to the two-fold", "chaos", 2, 2.046L, 4, 6e-3},
    {"cycle", "chaos to t = 2", "chaos", 0, 2, 16, 6e-3},
    {"stickslip", "stickslip to t = 2", "stickslip", 0, 2, 16, 0.5}};

const char *const scheme_names[SCHEMES] = {"moreau", "compensated", "located"};

// A member of the state, and what rounding it leaves over.
static void split(long double x, tf_real_t *high, tf_real_t *low) {
  *high = (tf_real_t)x;
  *low = (tf_real_t)(x - (long double)*high);
}

tf_status_t part_begin(run_t *run, const part_t *part,
                       const truth_state_t *start, scheme_t scheme, long n,
                       double tolerance) {
  tf_params_t params;
  if (!truth_params(part->problem, &params)) return TF_BAD_PARAMETER;
  *run = (run_t){.scheme = scheme};
  params.dt = (tf_real_t)((part->to - part->from) / (long double)n);
  if (tolerance <= 1e-2) params.tolerance = (tf_real_t)tolerance;
  const tf_status_t status =
      scheme == COMPENSATED
          ? tf_prepare_compensated(&run->machine, &params, NULL)
          : tf_prepare(&run->machine.machine, &params, NULL);
  if (status != TF_OK) return status;
  if (tolerance > 1e-2) run->machine.machine.tolerance = (tf_real_t)tolerance;
  run->input = tf_input_default(&run->machine.machine);
  split(start->x[0], &run->state.r, &run->compensation.r);
  split(start->x[1], &run->state.v, &run->compensation.v);
  split(start->x[2], &run->state.w, &run->compensation.w);
  run->state.mode = truth_mode(part->problem, part->from);
  return tf_begin(&run->machine.machine, &run->state, &run->input,
                  &run->report);
}

void part_print_end(const run_t *run, double dt, const char *name) {
  const tf_state_t *s = &run->state;
  const tf_compensation_t *c = &run->compensation;
  const tf_real_t high[3] = {s->r, s->v, s->w}, low[3] = {c->r, c->v, c->w};
  printf("%.4g %s %s", dt, REAL, name);
  for (int i = 0; i < 3; i++)
    printf(" %.17g",
           (double)high[i] + (run->scheme == COMPENSATED ? (double)low[i] : 0));
  printf("\n");
}

double part_error(const run_t *run, const truth_state_t *truth) {
  const tf_state_t *s = &run->state;
  const tf_compensation_t *c = &run->compensation;
  const int whole = run->scheme == COMPENSATED;
  const tf_real_t high[3] = {s->r, s->v, s->w}, low[3] = {c->r, c->v, c->w};
  double worst = 0;
  for (int i = 0; i < 3; i++) {
    long double x = (long double)high[i];
    if (whole) x += (long double)low[i];
    const double e = (double)fabsl(x - truth->x[i]);
    if (!(e <= worst)) worst = e;
  }
  return isnan(worst) ? HUGE_VAL : worst;
}

double part_random(unsigned stream, unsigned i) {
  uint32_t out[2];
  tf_philox((uint64_t)stream << 32 | i, 20240607u, out);
  return out[0] / 4294967296.0;
}
