/// @file
/// A run as the stream of frames that a board would send: docs/PROTOCOL.md.
#ifndef TWOFOLD_CLI_FRAMES_H
#define TWOFOLD_CLI_FRAMES_H

#include "../setup/scheme.h"

/// Room for the frames of one call.
#define CLI_FRAMES_ROOM 1024

/// Writes what comes before the first row: schema and layouts.
/// tick: in, of the first row. sequence: in/out, of the frames.
/// Returns: the length.
size_t cli_frames_header(const cli_setup_t *setup, const cli_scheme_t *scheme,
                         uint64_t tick, uint32_t *sequence,
                         uint8_t out[CLI_FRAMES_ROOM]);

/// Writes a row: state and report. source: in, whose inputs the step had.
/// Returns: the length.
size_t cli_frames_row(uint32_t *sequence, const tf_state_t *state,
                      const tf_report_t *report, tf_input_source_t source,
                      uint8_t out[CLI_FRAMES_ROOM]);

#endif
