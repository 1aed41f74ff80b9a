/// @file
/// The pure host run: controller and machine in one process, without a line and
/// without a clock.
#ifndef TWOFOLD_HIL_TWIN_H
#define TWOFOLD_HIL_TWIN_H

#include "hil/board.h"
#include "hil/control.h"

typedef struct {
  uint64_t steps;   ///< to take
  uint32_t every;   ///< steps from sample to sample
  uint32_t delay;   ///< steps from a sample to the effect of its input
  bool in_lockstep; ///< the board stands still until the input is there
} hil_plan_t;

typedef struct {
  size_t compared, differ; ///< states and reports, byte for byte
  size_t inputs, wrong;    ///< inputs that the controller made of the twin
  size_t late;             ///< in effect at another tick than planned
  size_t unanswered;       ///< of which nobody knows
  size_t missing;          ///< samples of the plan that never came
  uint64_t first;          ///< tick of the first difference
  double lacks;            ///< root mean square of wished - speed [rad/s]
  tf_state_t end;
} hil_verdict_t;

/// Runs the twin and compares. Where every input was in time the twin follows
/// the plan alone; else the ticks in the answers tell when one took effect.
/// Returns: HIL_EQUAL, HIL_DIFFERS, HIL_REFUSED (it cannot be run).
hil_code_t hil_twin_compare(hil_board_t *board, const hil_plan_t *plan,
                            const hil_control_t *control,
                            hil_verdict_t *verdict);

#endif
