/// @file
/// Numbers as a float has them, in both real types: so that two builds compute
/// with the same parameters, and nothing but their steps differs.
#ifndef TWOFOLD_BENCH_ROUNDED_H
#define TWOFOLD_BENCH_ROUNDED_H

#include <string.h>

#include "twofold.h"

#define TO_FLOAT(x) ((tf_real_t)(float)(x))

/// Rounds all parameters that are numbers.
static inline void round_params(tf_params_t *params) {
  for (int i = 0; i < TF_PARAMETERS; i++) {
    char *member = (char *)params + tf_parameter_ranges[i].offset;
    tf_real_t value;
    memcpy(&value, member, sizeof value);
    value = TO_FLOAT(value);
    memcpy(member, &value, sizeof value);
  }
}

#endif
