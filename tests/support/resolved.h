/* A step in which nothing was wrong but the resolution of float. */
#ifndef TESTS_SUPPORT_RESOLVED_H
#define TESTS_SUPPORT_RESOLVED_H

#include "twofold.h"

/* TF_OK; in float also TF_COARSE, because there a slow motion stands still at
 * the steps of these tests (test_standing.c). */
static inline int ok_to_resolution(tf_status_t status) {
  return status == TF_OK || (sizeof(tf_real_t) == 4 && status == TF_COARSE);
}

#endif
