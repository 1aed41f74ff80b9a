/// @file
/// The simulator behind a table of functions; see library.h.
#include "library.h"

#include <assert.h>
#include <string.h>

#include "told.h"
#include "twofold.h"

typedef struct {
  tf_compensated_t machine;
  tf_state_t state;
  tf_compensation_t compensation;
  tf_input_t input;
  lib_scheme_t scheme;
  lib_machine_t driven; // knots and dt
  tf_state_block_t lanes;
  tf_report_block_t reports;
} run_t;

static tf_params_t params_of(const lib_machine_t *q) {
  tf_params_t p = {PARAMETERS_OF(tf_real_t, q)};
  p.theta = tf_scenes[0]->params.theta;
  p.tolerance = tf_scenes[0]->params.tolerance;
  p.dt = (tf_real_t)q->dt;
  p.rest = (tf_rest_law_t)q->rest;
  p.law = q->coulomb ? TF_TYRE_COULOMB : TF_TYRE_JUMP;
  return p;
}

static run_t *run_of(lib_t *lib) { return (run_t *)(void *)lib->bytes; }

// The inputs of a step from one time to another, as `run --inputs FILE
// --between linear` gives them.
static void drive(run_t *run, double from, double to) {
  if (run->driven.knots > 0) {
    const told_t told = moving_told(&run->driven, from, to);
    run->input.omega0 = (tf_real_t)told.omega0;
    run->input.alpha = (tf_real_t)told.alpha;
    run->input.force = (tf_real_t)told.force;
    run->input.torque = (tf_real_t)told.torque;
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
    drive(run, 0, 0);
    status = place(run, q);
  }
  if (status == TF_OK) {
    status = tf_begin(&run->machine.machine, &run->state, &run->input, &report);
    fill(run, &report, row);
  }
  for (size_t i = 0; i < TF_LANES; ++i) {
    tf_ensemble_put(&run->lanes, i, &run->state);
  }
  return (int)status;
}

static int step(lib_t *lib, lib_row_t *row) {
  run_t *run = run_of(lib);
  tf_report_t report;
  tf_status_t status;
  const double dt = run->driven.dt, ticks = (double)run->state.tick;
  drive(run, ticks * dt, (ticks + 1) * dt);
  if (run->scheme == LIB_LOCATED) {
    status = tf_step_located(&run->machine.machine, &run->state, &run->input,
                             &report);
  } else if (run->scheme == LIB_COMPENSATED) {
    status = tf_step_compensated(&run->machine, &run->state, &run->compensation,
                                 &run->input, &report);
  } else if (run->scheme == LIB_LANES) {
    tf_ensemble_step(&run->machine.machine, &run->lanes, TF_LANES, &run->input,
                     &run->reports);
    run->state = tf_ensemble_get(&run->lanes, TF_LANES - 1);
    report = tf_ensemble_report(&run->reports, TF_LANES - 1);
    status = report.status;
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

const char *const lib_scheme_names[LIB_SCHEMES + 1] = {"moreau", "located",
                                                       "compensated", "lanes"};

void lib_range(const char *name, double *low, double *high) {
  for (int i = 0; i < TF_PARAMETERS; ++i) {
    if (strcmp(tf_parameter_ranges[i].name, name) == 0) {
      *low = tf_parameter_ranges[i].low;
      *high = tf_parameter_ranges[i].high;
    }
  }
}
#endif
