/// @file
/// A run as the stream of frames that a board would send: docs/PROTOCOL.md.
#ifndef TWOFOLD_CLI_FRAMES_H
#define TWOFOLD_CLI_FRAMES_H

#include "../setup/scheme.h"

/// Room for the frames of one call.
#define CLI_FRAMES_ROOM (4 * TF_FRAME_SIZE(TF_FRAME_PAYLOAD))

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

/// Writes what comes after the last row: a heartbeat with the counts of the
/// run. A run has no clock that ticks, so its times are 0.
/// steps: in, that this run took. late: in, of these in real time.
/// Returns: the length.
size_t cli_frames_end(uint32_t *sequence, uint64_t tick, uint64_t steps,
                      uint64_t late, const tf_tally_t *tally,
                      uint8_t out[CLI_FRAMES_ROOM]);

#endif
