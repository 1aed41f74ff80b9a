/// What a stream of frames has reported so far, and the rows that it makes. The
/// numbers are floats or doubles as the sender computes: a program built for
/// double reads a board that computes in float.
#pragma once

#include "../run/row.h"

#define CLI_RECEIVED_TEXT 64

typedef struct {
  bool has_schema;
  bool is_float;
  double dt;         ///< [s]
  double base;       ///< time = base + tick dt; not 0 once dt was changed [s]
  uint32_t hash;     ///< of the parameters
  bool ends;         ///< the stream has an end, which is a heartbeat
  uint32_t session;  ///< that commands have to name
  uint32_t sequence; ///< least number of a command that is still taken
  uint64_t schemas;  ///< that have come
  bool knows_run;
  uint32_t run;        ///< hash of the run, of the last schema or heartbeat
  uint64_t other_runs; ///< changes of the run that no start explains
  uint32_t next;       ///< number of the frame behind the last one
  bool knows_chain;    ///< no frame is missing since a heartbeat or number 0
  bool breaks;         ///< the last frame is a heartbeat of another chain
  uint32_t chain;      ///< of the frames up to the last one
  uint64_t vouched;    ///< tick of the last heartbeat, or of number 0
  uint64_t between[2]; ///< ticks that the first of other_runs is between
  char scene[CLI_RECEIVED_TEXT], build[CLI_RECEIVED_TEXT];

  uint64_t tick;    ///< of the state
  double state[4];  ///< r, v, omega, phi
  double report[6]; ///< h, g, F, M, delassus, residual
  uint8_t mode, choices;
  tf_status_t status; ///< of the last report
  bool has_state;     ///< a state has come, its report not yet
  bool early;         ///< ... before the schema

  bool has_heartbeat;
  tf_heartbeat_t heartbeat;

  uint64_t rows;       ///< complete: state and report of one tick
  uint64_t incomplete; ///< states without a report, or before the schema
  uint64_t unknown;    ///< frames of unknown type or length
} cli_receiver_t;

/// frame: in, in its decoder's buffer. row: out, written if it completes a row.
/// Returns: whether it does.
bool cli_receiver_take(cli_receiver_t *receiver, const tf_frame_t *frame,
                       cli_csv_t *row);

double cli_receiver_real(const cli_receiver_t *receiver, const uint8_t *at);
