/// What a stream of frames has reported so far, the rows that it makes, and
/// what is missing in it. The numbers are floats or doubles as the sender
/// computes: a program built for double reads a board that computes in float.
///
/// A file of frames and a pipe begin where the sender began: everything in them
/// that is not a frame is damage. A line does not: whoever starts to listen
/// hears half a frame first, and states that mean nothing before the schema.
#pragma once

#include "../run/row.h"

#define CLI_RECEIVED_TEXT 64

typedef struct {
  const char *source;   ///< name of the file or device
  tf_decoder_t decoder; ///< its counts are those of the stream
  uint64_t bytes;

  double dt;           ///< [s]
  double base;         ///< time = base + tick dt; not 0 once dt was changed [s]
  uint64_t schemas;    ///< that have come
  uint64_t other_runs; ///< changes of the run that no start explains
  uint64_t vouched;    ///< tick of the last heartbeat, or of number 0
  uint64_t between[2]; ///< ticks that the first of other_runs is between
  uint32_t hash;       ///< of the parameters
  uint32_t session;    ///< that commands have to name
  uint32_t sequence;   ///< least number of a command that is still taken
  uint32_t run;        ///< hash of the run, of the last schema or heartbeat
  uint32_t next;       ///< number of the frame behind the last one
  uint32_t chain;      ///< of the frames up to the last one
  bool is_device;      ///< the stream began before it was read
  bool has_schema, is_float;
  bool ends;        ///< the stream has an end, which is a heartbeat
  bool knows_chain; ///< no frame is missing since a heartbeat or number 0
  bool breaks;      ///< the last frame is a heartbeat of another chain
  char scene[CLI_RECEIVED_TEXT], build[CLI_RECEIVED_TEXT];

  uint64_t tick;      ///< of the state
  double state[4];    ///< r, v, omega, phi
  double report[6];   ///< h, g, F, M, delassus, residual
  tf_status_t status; ///< of the last report
  uint8_t mode, choices;
  bool has_state; ///< a state has come, its report not yet
  bool early;     ///< ... before the schema
  bool has_heartbeat;
  bool ended;     ///< the last frame is a heartbeat
  bool has_first; ///< one of the reported is not to be trusted: first
  tf_heartbeat_t heartbeat;

  uint64_t rows;       ///< complete: state and report of one tick
  uint64_t incomplete; ///< states without a report, or before the schema
  uint64_t unknown;    ///< frames of unknown type or length
  uint64_t not_finite; ///< rows with a value that is not finite
  uint64_t first_tick; ///< of the first of these

  uint64_t missed;  ///< of what the decoder counts, without end
  uint64_t unheard; ///< missed before a device was heard from its start on
  uint64_t before;  ///< missing before a device was heard from its start on
  uint64_t dropped; ///< frames that the board itself dropped
  uint64_t skipped; ///< its ticks that got no step
  uint32_t counted; ///< by the decoder, modulo 2^32

  // The steps that cannot be trusted to their bound. A report is of its own
  // step alone, and a heartbeat of all steps up to itself: each may count steps
  // that the other does not.
  tf_tally_t reported;    ///< steps whose report has come
  tf_tally_t told;        ///< most steps that a heartbeat has counted
  double first;           ///< time of the first that is not to be trusted [s]
  uint64_t last_reported; ///< tick of the last report
} cli_receiver_t;

/// Takes a frame, which a board that stands still may repeat.
/// frame: in, in its decoder's buffer. row: out, written if it completes a row.
/// Returns: whether it does.
bool cli_receiver_take(cli_receiver_t *receiver, const tf_frame_t *frame,
                       cli_csv_t *row);

double cli_receiver_real(const cli_receiver_t *receiver, const uint8_t *at);

/// Frames that were lost or broken on the line.
uint64_t cli_receiver_lost(const cli_receiver_t *receiver);

/// Frames that were lost, broken or dropped, and states without their report.
uint64_t cli_receiver_missing(const cli_receiver_t *receiver);

/// The steps that are known to be flagged.
tf_tally_t cli_receiver_flagged(const cli_receiver_t *receiver);
