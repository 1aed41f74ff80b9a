/// @file
/// The simulator behind a table of functions; see library.h.
#include "library.h"

#include <assert.h>
#include <string.h>

#include "params.h"

typedef struct {
  tf_compensated_t machine;
  tf_state_t state;
  tf_compensation_t compensation;
  tf_input_t input;
  lib_scheme_t scheme;
  lib_machine_t driven; // knots and dt
} run_t;

static run_t *run_of(lib_t *lib) { return (run_t *)(void *)lib->bytes; }

static lib_knot_t knot_at(const lib_machine_t *q, double t) {
  int i = 0;
  while (i < q->knots && q->knot[i].t <= t) {
    ++i;
  }
  const lib_knot_t *a = &q->knot[i > 0 ? i - 1 : 0];
  const lib_knot_t *b = &q->knot[i < q->knots ? i : q->knots - 1];
  const double share = b->t > a->t ? (t - a->t) / (b->t - a->t) : 0;
  return (lib_knot_t){t, a->omega0 + share * (b->omega0 - a->omega0),
                      a->force + share * (b->force - a->force),
                      a->torque + share * (b->torque - a->torque)};
}

// The inputs of the step that ends at t, as `run --inputs FILE --between
// linear` gives them where no knot lies within a step: omega0 at its end, the
// slope, and mean loads.
static void drive(run_t *run, double t) {
  const lib_machine_t *q = &run->driven;
  if (q->knots > 0) {
    const lib_knot_t end = knot_at(q, t), mean = knot_at(q, t - q->dt / 2);
    run->input.omega0 = (tf_real_t)end.omega0;
    run->input.alpha = (tf_real_t)((end.omega0 - mean.omega0) / (q->dt / 2));
    run->input.force = (tf_real_t)mean.force;
    run->input.torque = (tf_real_t)mean.torque;
  }
}

static void fill(const run_t *run, const tf_report_t *report, lib_row_t *row) {
  row->status = (int)report->status;
  row->mode = run->state.mode;
  row->F = (double)report->force.F;
  row->M = (double)report->force.M;
  row->h = (double)report->slip.h;
  row->g = (double)report->slip.g;
  row->r = (double)run->state.r + (double)run->compensation.r;
  row->v = (double)run->state.v + (double)run->compensation.v;
  row->w = (double)run->state.w + (double)run->compensation.w;
}

static tf_status_t place(run_t *run, const lib_machine_t *q) {
  const tf_machine_t *machine = &run->machine.machine;
  run->state = (tf_state_t){.r = (tf_real_t)q->r,
                            .v = (tf_real_t)q->v,
                            .w = (tf_real_t)q->omega,
                            .mode = TF_NO_MODE};
  if (!q->on_surface) {
    return TF_OK;
  }
  if (run->scheme == LIB_COMPENSATED) {
    return tf_speed_for_slip_compensated(
        &run->machine, &run->state, &run->compensation, run->input.omega0, 0);
  }
  return tf_speed_for_slip(machine, run->state.r, run->state.w,
                           run->input.omega0, 0, &run->state.v);
}

static int open_run(lib_t *lib, const lib_machine_t *q, lib_scheme_t scheme,
                    lib_row_t *row) {
  assert(sizeof(run_t) <= sizeof *lib);
  run_t *run = run_of(lib);
  const tf_params_t params = params_of(q);
  tf_report_t report;
  memset(lib, 0, sizeof *lib);
  memset(row, 0, sizeof *row);
  memset(&report, 0, sizeof report);
  run->scheme = scheme;
  run->driven = *q;
  tf_status_t status = tf_prepare_compensated(&run->machine, &params, NULL);
  if (status == TF_OK) {
    run->input = tf_input_default(&run->machine.machine);
    drive(run, 0);
    status = place(run, q);
  }
  if (status == TF_OK) {
    status = tf_begin(&run->machine.machine, &run->state, &run->input, &report);
    fill(run, &report, row);
  }
  return (int)status;
}

static int step(lib_t *lib, lib_row_t *row) {
  run_t *run = run_of(lib);
  tf_report_t report;
  tf_status_t status;
  drive(run, ((double)run->state.tick + 1) * run->driven.dt);
  if (run->scheme == LIB_LOCATED) {
    status = tf_step_located(&run->machine.machine, &run->state, &run->input,
                             &report);
  } else if (run->scheme == LIB_COMPENSATED) {
    status = tf_step_compensated(&run->machine, &run->state, &run->compensation,
                                 &run->input, &report);
  } else {
    status = tf_step(&run->machine.machine, &run->state, &run->input, &report);
  }
  if (status >= TF_OK) {
    fill(run, &report, row);
  }
  row->status = (int)status;
  return (int)status;
}

#ifdef TF_REAL_FLOAT
const lib_table_t lib_f32 = {"float", open_run, step, FLT_EPSILON};
#else
const lib_table_t lib_f64 = {"double", open_run, step, DBL_EPSILON};

const char *const lib_scheme_names[LIB_SCHEMES] = {"moreau", "located",
                                                   "compensated"};

void lib_range(const char *name, double *low, double *high) {
  for (int i = 0; i < TF_PARAMETERS; ++i) {
    if (strcmp(tf_parameter_ranges[i].name, name) == 0) {
      *low = tf_parameter_ranges[i].low;
      *high = tf_parameter_ranges[i].high;
    }
  }
}
#endif
