/// @file
/// Drives a board in response to its states.
#ifndef TWOFOLD_HIL_DRIVE_H
#define TWOFOLD_HIL_DRIVE_H

#include "board/hil/board.h"
#include "board/hil/control.h"
#include "board/hil/twin.h"

/// Reads the board's schema, stops the board at the start of its scene and sets
/// how long its inputs hold.
/// Returns: HIL_EQUAL; after a message another code.
hil_code_t hil_prepare(hil_board_t *board, const hil_plan_t *plan);

/// Runs the board according to the plan, then stops it. Returns: as above.
hil_code_t hil_drive(hil_board_t *board, const hil_plan_t *plan,
                     const hil_control_t *control);

#endif
