/// @file
/// The rows and the summary of a closed loop.
#ifndef TWOFOLD_HIL_REPORT_H
#define TWOFOLD_HIL_REPORT_H

#include "board/hil/board.h"
#include "board/hil/twin.h"

/// Writes a row for every state that was read, to a file that gets its name
/// when it is whole.
/// Returns: HIL_EQUAL, or HIL_STOPPED after a message.
hil_code_t hil_write_csv(const hil_board_t *board, const char *name);

/// Prints the summary.
void hil_report(const hil_board_t *board, const hil_plan_t *plan,
                const hil_verdict_t *v);

#endif
