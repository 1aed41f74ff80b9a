/// What is swept: one parameter or start each, from the mild to the extreme,
/// all else as in scene `chaos` unless the sweep says otherwise.
#pragma once

#include "twofold.h"

/// One machine and its start.
typedef struct {
  tf_params_t params;
  tf_real_t r, v, w;       ///< start ...
  tf_real_t h;             ///< ... where v_from_h, v follows from this h
  bool v_from_h;           ///< and from v where h does not depend on it
  const tf_scene_t *scene; ///< of the inputs; NULL: inputs at rest
} case_t;

/// One sweep. Values are 10^(low + i / per_decade); where per_decade is 0,
/// sweep_value has them.
typedef struct {
  const char *name;
  int count;
  int low, per_decade;
  bool from_zero; ///< one more value, 0, before the others
  void (*set)(case_t *c, tf_real_t value);
} sweep_t;

#define SWEEPS 25
extern const sweep_t sweeps[SWEEPS];

/// Value i of a sweep.
double sweep_value(const sweep_t *sweep, int i);

/// The case of value i of a sweep.
void sweep_case(const sweep_t *sweep, int i, case_t *c);
