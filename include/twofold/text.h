/// @file
/// State as text, for the serial plotter of the Arduino IDE; programs read
/// frames (telemetry.h).
#ifndef TWOFOLD_TEXT_H
#define TWOFOLD_TEXT_H

#include "twofold/step.h"

TF_BEGIN_C

/// Longest line.
#define TF_TEXT_ROW_ROOM 96

/// Writes "r:0.18 v:1.2 omega:-1.037 h:1e-10 g:0.05" and a newline, in up to
/// six digits, without a terminating zero.
/// out: out, TF_TEXT_ROW_ROOM characters. state, report: in.
/// Returns: the length.
#define tf_text_row TF_LINK(tf_text_row)
TF_API size_t tf_text_row(char *out, const tf_state_t *state,
                          const tf_report_t *report);

TF_END_C

#endif
