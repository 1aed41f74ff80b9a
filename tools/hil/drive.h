/// @file
/// Drives a board by its states.
#ifndef TWOFOLD_HIL_DRIVE_H
#define TWOFOLD_HIL_DRIVE_H

#include "hil/board.h"
#include "hil/control.h"
#include "hil/twin.h"

/// Brings the board to rest at the start of its scene, and makes it known.
/// Returns: HIL_EQUAL, or why it cannot go on (complained).
hil_code_t hil_prepare(hil_board_t *board);

/// Lets the board run by the plan, then stops it. Returns: as above.
hil_code_t hil_drive(hil_board_t *board, const hil_plan_t *plan,
                     const hil_control_t *control);

#endif
