/* What the module twofold.py calls beside the public functions: the layout of
 * structs, so that the module can hold them, scenes by number, and a loop of
 * steps, which would be slow in Python. */
#include "twofold.c"

#ifdef TF_REAL_FLOAT
#define SHARED(name) name##_f32
#else
#define SHARED(name) name##_f64
#endif

/* Sizes and offsets in the order that the module knows. */
const uint32_t SHARED(twofold_layout)[] = {
    sizeof(tf_params_t),
    offsetof(tf_params_t, law),
    offsetof(tf_params_t, rule),
    offsetof(tf_params_t, with_angle),
    sizeof(tf_machine_t),
    sizeof(tf_state_t),
    sizeof(tf_input_t),
    sizeof(tf_report_t),
    sizeof(tf_state_block_t),
    sizeof(tf_report_block_t),
    sizeof(tf_surface_point_t),
    TF_PARAMETERS,
    TF_TWO_FOLDS,
};

/* A row of twofold_run. */
typedef struct {
  double t;
  tf_real_t r, v, omega, phi, h, g, F, M;
  uint8_t mode, set, choices;
  int8_t status;
} row_t;
const uint32_t SHARED(twofold_row_size) = sizeof(row_t);

const tf_scene_t *SHARED(twofold_scene)(unsigned index) {
  return index < TF_SCENES ? tf_scenes[index] : NULL;
}

const char *SHARED(twofold_scene_text)(const tf_scene_t *scene, int shows) {
  return shows ? scene->shows : scene->name;
}

const tf_params_t *SHARED(twofold_scene_params)(const tf_scene_t *scene) {
  return &scene->params;
}

double SHARED(twofold_scene_end)(const tf_scene_t *scene) {
  return scene->t_end;
}

/* The row of a state; its report is of the step that led to it. */
void SHARED(twofold_row)(const tf_machine_t *machine, const tf_state_t *state,
                         const tf_report_t *report, int status, row_t *row) {
  *row = (row_t){.t = (double)state->tick * (double)machine->dt,
                 .r = state->r,
                 .v = state->v,
                 .omega = state->w,
                 .phi = state->phi,
                 .h = report->slip.h,
                 .g = report->slip.g,
                 .F = report->force.F,
                 .M = report->force.M,
                 .mode = report->mode,
                 .set = report->set,
                 .choices = report->choices,
                 .status = (int8_t)status};
}

/* Takes so many steps, and writes a row after every `every` of them and after
 * the last. input: those of the first step, held afterwards; NULL: those of the
 * scene. Returns: steps taken; fewer
 * where one is refused, whose status is in `status`. */
uint64_t SHARED(twofold_run)(const tf_machine_t *machine,
                             const tf_scene_t *scene, int located,
                             tf_state_t *state, const tf_input_t *input,
                             tf_report_t *report, uint64_t steps,
                             uint64_t every, row_t *rows, int *status) {
  for (uint64_t i = 1; i <= steps; i++) {
    tf_input_t u =
        input ? *input : tf_scene_input(scene, machine, state->tick + 1);
    if (input && i > 1) u.alpha = 0;
    const tf_status_t done = located
                                 ? tf_step_located(machine, state, &u, report)
                                 : tf_step(machine, state, &u, report);
    if (done < 0) {
      *status = done;
      return i - 1;
    }
    if (i % every == 0 || i == steps)
      SHARED(twofold_row)(machine, state, report, done, rows++);
  }
  return steps;
}
