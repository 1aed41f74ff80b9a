/// What `monitor` says of a stream at its end, and what makes its exit code.
#pragma once

#include "receiver.h"

/// A count of the board, which goes round, or begins again with it.
typedef struct {
  uint64_t more; ///< since the first heartbeat that told it
  uint32_t last; ///< as the last one has it
  bool is_known;
} cli_told_t;

typedef struct {
  const char *source; ///< name of the file or device
  cli_receiver_t receiver;
  tf_decoder_t decoder;
  uint64_t bytes;

  uint64_t missed;       ///< of what the decoder counts, without end
  uint32_t last_counted; ///< by the decoder, modulo 2^32
  uint64_t before;     ///< missing before a device was heard from its start on
  cli_told_t dropped;  ///< frames that the board itself dropped
  cli_told_t skipped;  ///< its ticks that got no step
  uint64_t not_finite; ///< rows with a value that is not finite
  uint64_t first_tick; ///< of the first of these

  // The steps that cannot be trusted to their bound. A report is of its own
  // step alone, and a heartbeat of all steps up to itself: each may count steps
  // that the other does not.
  tf_tally_t reported; ///< steps whose report has come
  tf_tally_t counted;  ///< most steps that a heartbeat has counted
  double first;        ///< time of the first one among the reported [s]
  uint64_t tick;       ///< of the last report
  bool has_report;     ///< there was one

  bool is_device; ///< the stream began before it was read
  bool heard;     ///< the first schema has come
  bool is_open;   ///< the stream has an end, which has not come yet
} cli_seen_t;

/// Takes a frame, which a board that stands still may repeat.
/// row, returns: as cli_receiver_take.
bool cli_seen_frame(cli_seen_t *seen, const tf_frame_t *frame, cli_csv_t *row);

/// Frames that were lost, broken or dropped, and states without their report.
uint64_t cli_seen_missing(const cli_seen_t *seen);

/// The steps that are known to be flagged.
tf_tally_t cli_seen_flagged(const cli_seen_t *seen);

/// The summary for a person, on standard error.
void cli_seen_print(const cli_seen_t *seen);

/// The same as one line of JSON, with the exit code.
void cli_seen_put(const cli_seen_t *seen, int code);

#define CLI_RECEIVED_ROOM 1024

/// Four lines that begin with #, as cli_provenance() writes them, of the
/// sender.
size_t cli_received_provenance(const cli_receiver_t *receiver,
                               char out[CLI_RECEIVED_ROOM]);
