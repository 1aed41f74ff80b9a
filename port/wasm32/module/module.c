// The simulator as a module that imports nothing: a web page or a program in
// node starts a scene, steps it, and reads the state from the module's memory.
#include "../../core.h"

// Hosts look these functions up by their names.
#pragma GCC diagnostic ignored "-Wmissing-prototypes"
#define EXPORT(symbol) __attribute__((export_name(#symbol))) symbol

static tf_simulation_t simulation;
static const tf_scene_t *scene;

// Always double, whatever the real type: the page views it as a Float64Array.
static double row[14];

uint32_t EXPORT(twofold_scenes)(void) { return TF_SCENES; }

// Text that ends with a zero; 0 where there is no such scene.
const char *EXPORT(twofold_name)(uint32_t number) {
  return number < TF_SCENES ? tf_scenes[number]->name : 0;
}

// dt: 0 for that of the scene. Returns: a tf_status_t; 0 is success.
int32_t EXPORT(twofold_begin)(uint32_t number, double dt, uint32_t rule,
                              uint32_t seed) {
  if (number >= TF_SCENES || rule >= TF_RULES) return TF_BAD_PARAMETER;
  const tf_scene_t *chosen = tf_scenes[number];
  tf_params_t params = chosen->params;
  if (dt > 0 || dt < 0) params.dt = (tf_real_t)dt;
  params.rule = (tf_rule_t)rule;
  const tf_status_t status =
      tf_simulation_open(&simulation, chosen, &params, seed);
  scene = status == TF_OK ? chosen : 0;
  return status;
}

// Inputs from the next step on, in place of the scene's. An omega0 that is not
// that of the step before is a jump: alpha is 0.
int32_t EXPORT(twofold_drive)(double omega0, double r0, double force,
                              double torque) {
  if (!scene) return TF_BAD_STATE;
  const tf_input_t input = {.omega0 = (tf_real_t)omega0,
                            .r0 = (tf_real_t)r0,
                            .force = (tf_real_t)force,
                            .torque = (tf_real_t)torque};
  tf_simulation_set_input(&simulation, &input);
  return TF_OK;
}

// Returns: the status of the last step; if that is < 0 it was refused, and no
// further one was taken.
int32_t EXPORT(twofold_step)(uint32_t steps) {
  tf_status_t status = scene ? TF_OK : TF_BAD_STATE;
  for (; steps > 0 && status >= 0; steps--) {
    const tf_input_t input = tf_simulation_input(&simulation, scene);
    status = tf_step(&simulation.machine, &simulation.state, &input,
                     &simulation.report);
  }
  return status;
}

// t, r, v, omega, phi, h, g, F, M, Delassus, residual, mode, set, choices.
const double *EXPORT(twofold_state)(void) {
  const tf_state_t *x = &simulation.state;
  const tf_report_t *report = &simulation.report;
  const double now[14] = {(double)((tf_real_t)x->tick * simulation.machine.dt),
                          (double)x->r,
                          (double)x->v,
                          (double)x->w,
                          (double)x->phi,
                          (double)report->slip.h,
                          (double)report->slip.g,
                          (double)report->force.F,
                          (double)report->force.M,
                          (double)report->delassus,
                          (double)report->residual,
                          (double)report->mode,
                          (double)report->set,
                          (double)report->choices};
  for (unsigned i = 0; i < 14; i++) row[i] = now[i];
  return row;
}
