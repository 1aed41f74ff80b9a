/// @file
/// The steps of a stream that cannot be trusted to their bound. A report is
/// of its own step alone, and a heartbeat of all steps up to itself: each may
/// count steps that the other does not.
#ifndef TWOFOLD_CLI_FLAGGED_H
#define TWOFOLD_CLI_FLAGGED_H

#include "receiver.h"

typedef struct {
  tf_tally_t reported; ///< steps whose report has come
  tf_tally_t counted;  ///< most steps that a heartbeat has counted
  double first;        ///< time of the first one among the reported [s]
  uint64_t tick;       ///< of the last report
  bool has_report;     ///< there was one
} cli_flagged_t;

/// Takes note of a frame that the receiver has taken, which a board that stands
/// still may repeat. row: in, the row that the frame completes, or NULL.
void cli_flagged_frame(cli_flagged_t *flagged, const tf_frame_t *frame,
                       const cli_receiver_t *receiver, const cli_csv_t *row);

/// The steps that are known to be flagged.
tf_tally_t cli_flagged_tally(const cli_flagged_t *flagged);

/// Prints the line of the summary if the stream has any status.
void cli_flagged_print(const cli_flagged_t *flagged,
                       const cli_receiver_t *receiver);

/// Returns: CLI_FLAGGED or CLI_DONE.
int cli_flagged_code(const cli_flagged_t *flagged);

#endif
