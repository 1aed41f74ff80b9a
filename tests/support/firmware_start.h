/* How firmware starts a scene: the functions of port/core.h and of
 * tools/board/constants/constants.c, which contain a core of their own. */
#ifndef TESTS_FIRMWARE_START_H
#define TESTS_FIRMWARE_START_H

#include <stdio.h>

#include "twofold.h"

/* As a firmware that has all scenes does. Returns: whether it could. */
bool generic_firmware_start(const tf_scene_t *scene, tf_state_t *state,
                            tf_report_t *report);

/* Writes the constants of a firmware of one scene. Returns: the exit code. */
int write_firmware_constants(FILE *out, const tf_scene_t *scene);

/* tf_step of a firmware with SPLIT=no. */
tf_status_t unsplit_step(const tf_machine_t *machine, tf_state_t *state,
                         const tf_input_t *input, tf_report_t *report);

#endif
