/* What the module twofold.py calls beside the public functions: the layout of
 * structs, so that the module can hold them, scenes by number, and a loop of
 * steps, which would be slow in Python. */
#ifdef TWOFOLD_AVX2_LANES /* once more, for the vectors of AVX2 alone */
#define TF_API_STATIC
#endif
#include "twofold.c"

#ifdef TF_REAL_FLOAT
#define SHARED(name) name##_f32
#else
#define SHARED(name) name##_f64
#endif

/* Takes so many steps of an ensemble, block by block. input: that of the first
 * of them, behind which the turntable keeps its speed. */
typedef void ensemble_run_t(const tf_machine_t *machine,
                            tf_state_block_t *states, size_t n,
                            const tf_input_t *input, tf_report_block_t *reports,
                            uint64_t steps);
ensemble_run_t SHARED(twofold_ensemble_with_avx2);

static void run_ensemble(const tf_machine_t *machine, tf_state_block_t *states,
                         size_t n, const tf_input_t *input,
                         tf_report_block_t *reports, uint64_t steps) {
  for (size_t at = 0; at < n; at += TF_LANES) {
    const size_t lanes = n - at < TF_LANES ? n - at : TF_LANES;
    tf_input_t u = *input;
    for (uint64_t i = 0; i < steps; i++) {
      tf_ensemble_step(machine, states + at / TF_LANES, lanes, &u,
                       reports + at / TF_LANES);
      u.alpha = 0;
    }
  }
}

#ifdef TWOFOLD_AVX2_LANES
void SHARED(twofold_ensemble_with_avx2)(const tf_machine_t *machine,
                                        tf_state_block_t *states, size_t n,
                                        const tf_input_t *input,
                                        tf_report_block_t *reports,
                                        uint64_t steps) {
  run_ensemble(machine, states, n, input, reports, steps);
}
#else

void SHARED(twofold_ensemble_run)(const tf_machine_t *machine,
                                  tf_state_block_t *states, size_t n,
                                  tf_input_t *input, tf_report_block_t *reports,
                                  uint64_t steps) {
  ensemble_run_t *run = run_ensemble;
#ifdef TWOFOLD_HAS_AVX2_LANES
  if (__builtin_cpu_supports("avx2")) run = SHARED(twofold_ensemble_with_avx2);
#endif
  run(machine, states, n, input, reports, steps);
  if (steps > 0) input->alpha = 0;
}

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

/* Goes on behind `from` of so many steps, for `most` of them, and writes a row
 * after every `every` of all and after the last. input: held, its alpha is 0
 * behind a step; NULL: those of the scene. Returns: steps taken, with `from`;
 * fewer where one is refused, whose status is in `status`. */
uint64_t SHARED(twofold_run)(const tf_machine_t *machine,
                             const tf_scene_t *scene, int located,
                             tf_state_t *state, tf_input_t *input,
                             tf_report_t *report, uint64_t from, uint64_t most,
                             uint64_t steps, uint64_t every, row_t *rows,
                             int *status) {
  const uint64_t end = steps - from > most ? from + most : steps;
  for (uint64_t i = from + 1; i <= end; i++) {
    const tf_input_t u =
        input ? *input : tf_scene_input(scene, machine, state->tick + 1);
    const tf_status_t done = located
                                 ? tf_step_located(machine, state, &u, report)
                                 : tf_step(machine, state, &u, report);
    if (done < 0) {
      *status = done;
      return i - 1;
    }
    if (input) input->alpha = 0;
    if (i % every == 0 || i == steps)
      SHARED(twofold_row)(machine, state, report, done, rows + (i - 1) / every);
  }
  return end;
}
#endif
