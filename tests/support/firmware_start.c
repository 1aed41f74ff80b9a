/* See firmware_start.h. The core in here is local to this file. */
#define TF_STEP_SPLITS false
#include "../../port/core.h" /* NOLINT(bugprone-suspicious-include) */
/* After the core, whose functions are local. */
#include "../../tools/board/constants/constants.c" /* NOLINT */
#include "firmware_start.h"

const uint8_t chosen_scene = 0;

bool generic_firmware_start(const tf_scene_t *scene, tf_state_t *state,
                            tf_report_t *report) {
  return begin_given_scene(scene, state, report);
}

int write_firmware_constants(FILE *out, const tf_scene_t *scene) {
  return constants_of_firmware(out, scene, NULL);
}

tf_status_t unsplit_step(const tf_machine_t *machine, tf_state_t *state,
                         const tf_input_t *input, tf_report_t *report) {
  return tf_step(machine, state, input, report);
}
