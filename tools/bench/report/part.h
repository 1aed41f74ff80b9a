/// @file
/// Parts of the motion, and one run of one scheme through one of them.
#ifndef TWOFOLD_REPORT_PART_H
#define TWOFOLD_REPORT_PART_H

#include "truth.h"

/// A part is a window of a reference problem, and begins and ends where the
/// reference knows the state; inside it knows `pieces` - 1 more, evenly.
typedef struct {
  const char *name, *text, *problem;
  long double from, to; // [s]
  int pieces;
  double border; // an end further off is on another branch
} part_t;

#define PARTS 7
extern const part_t parts[PARTS];

typedef enum { MOREAU, COMPENSATED, LOCATED } scheme_t;
#define SCHEMES 3
/// The real type of this build.
#define REAL (sizeof(tf_real_t) == 8 ? "double" : "float")
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

/// Begins a run: of n steps, from the state of the reference at the part's
/// start. tolerance: of LOCATED; above the range of the parameter it is put
/// into the prepared machine, so that the step alone sets the error.
tf_status_t part_begin(run_t *run, const part_t *part,
                       const truth_state_t *start, scheme_t scheme, long n,
                       double tolerance);

static inline tf_status_t part_step(run_t *run) {
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

/// Prints `dt real scheme r v w`, the end of a run by `name`. A run that
/// carries its rounding ends at the sum.
void part_print_end(const run_t *run, double dt, const char *name);

/// Largest difference of r [m], v [m/s] and w [rad/s]; infinity for no number.
double part_error(const run_t *run, const truth_state_t *truth);

/// A random number in [0, 1): the same in every run of the program.
double part_random(unsigned stream, unsigned i);

#endif
