/// @file
/// Scene `chaos` at its start, for both contestants.
#ifndef TWOFOLD_BENCH_CHAOS_H
#define TWOFOLD_BENCH_CHAOS_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rk4_smooth.h"
#include "twofold.h"

/// The width that scene `smooth` has: the widest that an explicit method of
/// order four integrates at dt = 1e-4 without growing.
#define CHAOS_EPSILON TF_R(1e-4)

typedef struct {
  tf_machine_t machine;
  tf_input_t input;
  tf_state_t start;
  rk4_smooth_t smooth;
  rk4_state_t smooth_start;
} chaos_t;

static inline const tf_scene_t *chaos_scene(void) {
  for (int i = 0; i < TF_SCENES; i++) {
    if (strcmp(tf_scenes[i]->name, "chaos") == 0) return tf_scenes[i];
  }
  fputs("there is no scene chaos\n", stderr);
  exit(1);
}

static inline chaos_t chaos_begin(void) {
  const tf_scene_t *scene = chaos_scene();
  chaos_t c;
  memset(&c, 0, sizeof c);
  tf_params_t params = scene->params;
  params.epsilon = CHAOS_EPSILON;
  tf_report_t report;
  tf_status_t status = tf_prepare(&c.machine, &params, NULL);
  c.input = tf_input_default(&c.machine);
  c.start.r = scene->r;
  c.start.w = scene->omega;
  if (status == TF_OK) {
    status =
        tf_begin_with_slip(&c.machine, &c.start, &c.input, scene->h, &report);
  }
  if (status != TF_OK) {
    fprintf(stderr, "chaos does not begin: %s\n", tf_status_name(status));
    exit(1);
  }
  c.smooth = rk4_smooth_prepare(&params);
  c.smooth_start = (rk4_state_t){c.start.r, c.start.v, c.start.w};
  return c;
}

#endif
