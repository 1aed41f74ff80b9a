/// @file
/// What a stream of frames has told so far, in numbers of either real type:
/// a program built for double reads a board in float.
#ifndef TWOFOLD_CLI_PICTURE_H
#define TWOFOLD_CLI_PICTURE_H

#include "run.h"

#define CLI_PICTURE_TEXT 64

typedef struct {
  bool has_schema;
  bool is_float;
  double dt;     ///< [s]
  double base;   ///< time = base + tick dt; not 0 once dt was changed [s]
  uint32_t hash; ///< of the parameters
  char scene[CLI_PICTURE_TEXT], build[CLI_PICTURE_TEXT];

  uint64_t tick;    ///< of the state
  double state[4];  ///< r, v, omega, phi
  double report[6]; ///< h, g, F, M, delassus, residual
  uint8_t mode, choices;
  bool has_state; ///< a state came and its report is still awaited

  bool has_heartbeat;
  tf_heartbeat_t heartbeat;

  uint64_t rows;       ///< complete: state and report of one tick, or compact
  uint64_t incomplete; ///< states without their report, or before a schema
  uint64_t unknown;    ///< frames of a type or length that is not known here
} cli_picture_t;

/// Takes a frame.
/// row: out, written where it completes a row.
/// Returns: whether it did.
bool cli_picture_take(cli_picture_t *picture, const tf_frame_t *frame,
                      cli_csv_t *row);

/// Reads a real of the sender's type.
double cli_picture_real(const cli_picture_t *picture, const uint8_t *at);

#endif
