/// @file
/// State as text, for a serial plotter: lines of `label:value` pairs, which the
/// plotter of the Arduino IDE and Serial Studio read as they are. For looking
/// at; what a program is to read goes in frames.
#ifndef TWOFOLD_TEXT_H
#define TWOFOLD_TEXT_H

#include <stddef.h>

#include "twofold/machine.h"
#include "twofold/step.h"

/// Longest number: "-1.23456e-308".
#define TF_TEXT_REAL_ROOM 13
/// Longest line.
#define TF_TEXT_ROW_ROOM 96

/// Writes a number in up to six digits, without a terminating zero.
/// Scheme: scaled by powers of ten in tf_real_t, which may cost a unit of the
///   last digit; e notation below 1e-5 and from 1e6 on.
/// out: out, TF_TEXT_REAL_ROOM characters.
/// value: in, any; "nan", "inf", "-inf" too.
/// Returns: the length.
/// Cost: at most 1600 instructions; many powers of ten away from 1.
///   Stack: 128 B.
/// Memory: caller's, reentrant.
/// Claims: text_numbers_read_back, text_numbers_are_plain
#define tf_text_real TF_LINK(tf_text_real)
TF_API size_t tf_text_real(char *out, tf_real_t value);

/// Writes "r:0.18 v:1.2 omega:-1.037 h:1e-10 g:0.05" and a newline, without a
/// terminating zero.
/// Scheme: none.
/// out: out, TF_TEXT_ROW_ROOM characters.
/// state, report: in.
/// Returns: the length.
/// Cost: at most 8000 instructions; 5 such numbers. Stack: 144 B.
/// Memory: caller's, no overlap, reentrant.
/// Claims: text_rows_are_label_value_pairs
#define tf_text_row TF_LINK(tf_text_row)
TF_API size_t tf_text_row(char *out, const tf_state_t *state,
                          const tf_report_t *report);

#endif
