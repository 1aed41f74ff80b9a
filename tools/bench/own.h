/// One run of one scheme of this project on a problem.
#pragma once

#include "harness.h"
#include "motion.h"

/// A machine in motion.
typedef struct {
  motion_scheme_t scheme;
  motion_t motion;
  tf_input_t input;
} run_t;

/// Begins a run of a problem in n steps; MOTION_SCHEMES is refused.
/// tolerance, segments: of MOTION_LOCATED; 0 is the default. A tolerance above
/// the range of the parameter is put into the prepared machine, so that the
/// step alone sets the error.
tf_status_t run_begin(run_t *run, const problem_t *problem,
                      motion_scheme_t scheme, long n, double tolerance,
                      int segments);

static inline tf_status_t run_step(run_t *run) {
  return motion_step(&run->motion, run->scheme, &run->input);
}

/// The scheme of that name; MOTION_SCHEMES where there is none.
motion_scheme_t scheme_named(const char *name);

/// The commands `single` and `ensemble`. Return: an exit code.
int single_main(int argc, char **argv);
int ensemble_main(void);
