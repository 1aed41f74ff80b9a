/// The simulator behind one function, once in double and once in float.
#include <math.h>
#include <string.h>

#include "../../../tools/motion.h"
#include "judge.h"

typedef struct {
  const lib_machine_t *q;
  motion_t motion;
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

static tf_status_t begin(run_t *run, lib_scheme_t scheme) {
  const lib_machine_t *q = run->q;
  const tf_params_t params = params_of(q);
  const motion_start_t start = {.state = {.r = (tf_real_t)q->r,
                                          .v = (tf_real_t)q->v,
                                          .w = (tf_real_t)q->omega,
                                          .mode = TF_NO_MODE},
                                .from_h = q->on_surface};
  motion_t *motion = &run->motion;
  tf_status_t status =
      motion_prepare(motion, MOTION_COMPENSATED, &params, NULL);
  if (status != TF_OK) return status;
  run->input = tf_input_default(&motion->machine.machine);
  drive(run, 0, 0);
  status = motion_begin(motion, (motion_scheme_t)scheme, &start, &run->input);
  for (size_t i = 0; i < TF_LANES; ++i)
    tf_ensemble_put(&run->lanes, i, &motion->state);
  return status;
}

static tf_status_t step(run_t *run, lib_scheme_t scheme) {
  if (scheme != LIB_LANES)
    return motion_step(&run->motion, (motion_scheme_t)scheme, &run->input);
  tf_ensemble_step(&run->motion.machine.machine, &run->lanes, TF_LANES,
                   &run->input, &run->reports);
  run->motion.state = tf_ensemble_get(&run->lanes, TF_LANES - 1);
  return tf_ensemble_report(&run->reports, TF_LANES - 1).status;
}

// A machine and its inputs as a mirror along the slot shows them.
static lib_machine_t mirrored(const lib_machine_t *machine) {
  lib_machine_t q = *machine;
  q.d = -q.d;
  q.gamma = -q.gamma;
  q.omega0 = -q.omega0;
  q.omega = -q.omega;
  q.swing = -q.swing;
  for (int i = 0; i < q.knots; ++i) {
    q.knot[i].omega0 = -q.knot[i].omega0;
    q.knot[i].torque = -q.knot[i].torque;
  }
  return q;
}

static int follow(const lib_machine_t *q, lib_scheme_t scheme, double t_end,
                  lib_row_t *end) {
  const long steps = lround(t_end / q->dt);
  bool flagged = false;
  run_t run;
  memset(&run, 0, sizeof run);
  run.q = q;
  tf_status_t status = begin(&run, scheme);
  for (long n = 0; status >= TF_OK; ++n) {
    end->r = (double)run.motion.state.r + (double)run.motion.low.r;
    end->v = (double)run.motion.state.v + (double)run.motion.low.v;
    end->w = (double)run.motion.state.w + (double)run.motion.low.w;
    flagged |= status > TF_OK;
    if (n == steps) return flagged;
    drive(&run, (double)n * q->dt, (double)(n + 1) * q->dt);
    status = step(&run, scheme);
  }
  return -1;
}

static int run_to(const lib_machine_t *q, lib_scheme_t scheme, double t_end,
                  lib_row_t *end, bool *parts) {
  const lib_machine_t image = mirrored(q);
  lib_row_t seen = {0, 0, 0};
  const int outcome = follow(q, scheme, t_end, end);
  *parts = follow(&image, scheme, t_end, &seen) != outcome ||
           (outcome >= 0 &&
            (seen.r != end->r || seen.v != end->v || seen.w != -end->w));
  return outcome;
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
