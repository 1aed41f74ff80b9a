/// @file
/// The time stepping schemes of `run`, as functions of one signature.
#ifndef TWOFOLD_CLI_SCHEME_H
#define TWOFOLD_CLI_SCHEME_H

#include "args.h"
#include "inputs.h"
#include "setup.h"

/// Machine and state, with what the compensated scheme adds to both. The other
/// schemes leave the compensation 0.
typedef struct {
  tf_compensated_t machine;
  tf_state_t state;
  tf_compensation_t compensation;
  tf_real_t accuracy; ///< of moreau; 0: its error is not estimated
  tf_real_t error;    ///< the largest of its steps
} cli_system_t;

/// One step of a scheme.
typedef tf_status_t (*cli_step_t)(cli_system_t *system, const tf_input_t *input,
                                  tf_report_t *report);

typedef struct {
  const char *name; ///< as on the command line
  uint8_t code;     ///< as in the schema frame
  cli_step_t step;
  bool splits;        ///< steps are split at the rows of a linear table
  unsigned laws;      ///< bit set of the tf_tyre_law_t that it accepts
  const char *unused; ///< name of a parameter that it does not use ...
  const char *why;    ///< ... and the end of the message "... has no effect"
} cli_scheme_t;

/// Largest number of steps of a run, and between two rows: a double holds every
/// integer up to it.
#define CLI_MAX_STEPS 1000000000000000u

#define CLI_SCHEMES 3
/// The first is the default.
extern const cli_scheme_t cli_schemes[CLI_SCHEMES];

/// Float loses a motion in the rounding of its state at shorter steps [s].
#define CLI_SHORT_STEP TF_R(1e-3)

/// The scheme that is asked for. Where none is, that of the state or the record
/// that a run goes on from (there; NULL: none); else moreau, and in float at
/// short steps compensated. What is not moreau, or not usual, a note says.
const cli_scheme_t *cli_scheme_for(const cli_args_t *args, tf_real_t dt,
                                   const cli_scheme_t *there);

/// Checks that a scheme accepts a law.
int cli_check_law(const cli_scheme_t *scheme, tf_tyre_law_t law);

/// The number of steps of a run: the integer nearest to t_end / dt.
/// t_end is that of --t-end or of the scene. steps: out.
int cli_count_steps(const cli_args_t *args, tf_real_t dt, uint64_t *steps);

/// The time of the end, as above.
tf_real_t cli_end_of(const cli_args_t *args);

/// Takes a step of a setup's machine under what drives it, from system->state.
/// A scheme that splits steps takes one for each part; the report then has the
/// largest set of them, and the first status that is not TF_OK.
/// input: out, that of the step, or of its last part.
tf_status_t cli_drive_take(cli_drive_t *drive, const cli_scheme_t *scheme,
                           const cli_setup_t *setup, cli_system_t *system,
                           tf_input_t *input, tf_report_t *report);

/// Puts a system into the initial state of a setup. Under the compensated
/// scheme the speed that follows from a given slip speed h is computed with its
/// compensation.
/// report: in/out, of tf_begin.
void cli_system_begin(cli_system_t *system, const cli_scheme_t *scheme,
                      const cli_setup_t *setup, tf_report_t *report);

#endif
