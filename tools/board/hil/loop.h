/// @file
/// The closed loop: its plan, how a board is driven in response to its states
/// (drive.c), and what judges it (twin.c).
#ifndef TWOFOLD_HIL_LOOP_H
#define TWOFOLD_HIL_LOOP_H

#include "board/hil/board.h"
#include "board/hil/control.h"

typedef struct {
  uint64_t steps;   ///< number of steps
  uint32_t every;   ///< steps from sample to sample
  uint32_t delay;   ///< steps from a sample to the effect of its input
  bool in_lockstep; ///< the board waits for each input
  uint64_t silent;  ///< from this step on no input is sent
  bool has_deadman; ///< the board is told how long an input holds ...
  uint32_t deadman; ///< ... in steps; else it keeps its own number
} hil_plan_t;

typedef struct {
  size_t compared, differ; ///< states and reports, byte for byte
  size_t inputs, wrong;    ///< inputs, and those unlike the twin's
  size_t late;             ///< inputs in effect at another tick than planned
  size_t unanswered;       ///< inputs without an answer
  size_t missing;          ///< samples of the plan that were not received
  uint32_t expired;        ///< inputs that were not renewed in time
  uint64_t first;          ///< tick of the first difference
  double rms_error;        ///< of the disc's speed [rad/s]
  tf_state_t end;
} hil_verdict_t;

/// Reads the board's schema, stops the board at the start of its scene and sets
/// how long its inputs hold.
/// Returns: HIL_EQUAL; after a message another code.
hil_code_t hil_prepare(hil_board_t *board, const hil_plan_t *plan);

/// Runs the board according to the plan, then stops it. Returns: as above.
hil_code_t hil_drive(hil_board_t *board, const hil_plan_t *plan,
                     const hil_control_t *control);

/// Runs the digital twin, controller and machine in one process without a line
/// and without a clock, whose bits the closed loop should have, and compares.
/// Inputs take effect at the ticks that the board's answers give: the planned
/// ones, unless an input was late.
/// Returns: HIL_EQUAL, HIL_DIFFERS, HIL_REFUSED (a step is refused).
hil_code_t hil_twin_compare(hil_board_t *board, const hil_plan_t *plan,
                            const hil_control_t *control,
                            hil_verdict_t *verdict);

#endif
