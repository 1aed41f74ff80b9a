/// @file
/// The simulator behind one function, once in double and once in float.
#include <math.h>
#include <string.h>

#include "judge.h"
#include "twofold.h"

typedef struct {
  const lib_machine_t *q;
  lib_scheme_t scheme;
  tf_compensated_t machine;
  tf_state_t state;
  tf_compensation_t compensation;
  tf_input_t input;
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

// The inputs of a step from one time to another, as `run --inputs FILE
// --between linear` gives them.
static void drive(run_t *run, double from, double to) {
  if (run->q->knots > 0) {
    const moving_input_t u = moving_input(run->q, from, to);
    run->input.omega0 = (tf_real_t)u.omega0;
    run->input.alpha = (tf_real_t)u.alpha;
    run->input.force = (tf_real_t)u.force;
    run->input.torque = (tf_real_t)u.torque;
  }
}

static tf_status_t place(run_t *run) {
  const lib_machine_t *q = run->q;
  tf_state_t *x = &run->state;
  *x = (tf_state_t){.r = (tf_real_t)q->r,
                    .v = (tf_real_t)q->v,
                    .w = (tf_real_t)q->omega,
                    .mode = TF_NO_MODE};
  if (!q->on_surface) return TF_OK;
  if (run->scheme == LIB_COMPENSATED)
    return tf_speed_for_slip_compensated(&run->machine, x, &run->compensation,
                                         run->input.omega0, 0);
  return tf_speed_for_slip(&run->machine.machine, x->r, x->w, run->input.omega0,
                           0, &x->v);
}

static tf_status_t begin(run_t *run) {
  const tf_params_t params = params_of(run->q);
  tf_report_t report;
  tf_status_t status = tf_prepare_compensated(&run->machine, &params, NULL);
  if (status == TF_OK) {
    run->input = tf_input_default(&run->machine.machine);
    drive(run, 0, 0);
    status = place(run);
  }
  if (status == TF_OK)
    status = tf_begin(&run->machine.machine, &run->state, &run->input, &report);
  for (size_t i = 0; i < TF_LANES; ++i)
    tf_ensemble_put(&run->lanes, i, &run->state);
  return status;
}

static tf_status_t step(run_t *run) {
  const tf_machine_t *machine = &run->machine.machine;
  tf_report_t report;
  switch (run->scheme) {
    case LIB_LOCATED:
      return tf_step_located(machine, &run->state, &run->input, &report);
    case LIB_COMPENSATED:
      return tf_step_compensated(&run->machine, &run->state, &run->compensation,
                                 &run->input, &report);
    case LIB_LANES:
      tf_ensemble_step(machine, &run->lanes, TF_LANES, &run->input,
                       &run->reports);
      run->state = tf_ensemble_get(&run->lanes, TF_LANES - 1);
      return tf_ensemble_report(&run->reports, TF_LANES - 1).status;
    case LIB_STEP:
      break;
  }
  return tf_step(machine, &run->state, &run->input, &report);
}

static int run_to(const lib_machine_t *q, lib_scheme_t scheme, double t_end,
                  lib_row_t *end, lib_watch_t watch, void *context) {
  const long steps = lround(t_end / q->dt);
  bool flagged = false;
  run_t run;
  memset(&run, 0, sizeof run);
  run.q = q;
  run.scheme = scheme;
  tf_status_t status = begin(&run);
  for (long n = 0; status >= TF_OK; ++n) {
    end->r = (double)run.state.r + (double)run.compensation.r;
    end->v = (double)run.state.v + (double)run.compensation.v;
    end->w = (double)run.state.w + (double)run.compensation.w;
    flagged |= status > TF_OK;
    if (watch) watch(context, (int)status, end);
    if (n == steps) return flagged;
    drive(&run, (double)n * q->dt, (double)(n + 1) * q->dt);
    status = step(&run);
  }
  return -1;
}

#ifdef TF_REAL_FLOAT
const lib_real_t lib_f32 = {"float", FLT_EPSILON, run_to};
#else
const lib_real_t lib_f64 = {"double", DBL_EPSILON, run_to};

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
