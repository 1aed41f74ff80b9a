/// One run of one scheme of this project on a problem.
#pragma once

#include "harness.h"

typedef enum { MOREAU, COMPENSATED, LOCATED } scheme_t;
#define SCHEMES 3
extern const char *const scheme_names[SCHEMES];

/// A machine in motion.
typedef struct {
  scheme_t scheme;
  tf_compensated_t machine;
  tf_state_t state;
  tf_compensation_t compensation; // used by COMPENSATED
  tf_input_t input;
  tf_report_t report;
} run_t;

/// Begins a run of a problem in n steps; SCHEMES is refused.
/// tolerance, segments: of LOCATED; 0 is the default. A tolerance above the
/// range of the parameter is put into the prepared machine, so that the step
/// alone sets the error.
tf_status_t run_begin(run_t *run, const problem_t *problem, scheme_t scheme,
                      long n, double tolerance, int segments);

static inline tf_status_t run_step(run_t *run) {
  switch (run->scheme) {
    case COMPENSATED:
      return tf_step_compensated(&run->machine, &run->state, &run->compensation,
                                 &run->input, &run->report);
    case LOCATED:
      return tf_step_located(&run->machine.machine, &run->state, &run->input,
                             &run->report);
    case MOREAU:
    default:
      return tf_step(&run->machine.machine, &run->state, &run->input,
                     &run->report);
  }
}

/// The scheme of that name; SCHEMES where there is none.
scheme_t scheme_named(const char *name);

/// The commands `single` and `ensemble`. Return: an exit code.
int single_main(int argc, char **argv);
int ensemble_main(void);
