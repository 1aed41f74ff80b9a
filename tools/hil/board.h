/// @file
/// The board at the other end of the line: what it says, what it is told, and
/// what became of that. Nothing here knows a controller.
#ifndef TWOFOLD_HIL_BOARD_H
#define TWOFOLD_HIL_BOARD_H

#include "cli/host/source.h"
#include "twofold.h"

/// Exit codes.
typedef enum {
  HIL_EQUAL = 0,   ///< closed loop and pure host run have the same bits
  HIL_DIFFERS = 1, ///< they have not
  HIL_USAGE = 2,
  HIL_REFUSED = 3, ///< the board is not one that this program can drive
  HIL_STOPPED = 4  ///< the line, or a time without a word on it
} hil_code_t;

/// Tells on standard error. Returns: the code.
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
hil_code_t
hil_message(hil_code_t code, const char *format, ...);

/// A state as it came, with what the controller made of it. The payloads are
/// kept as bytes: what is compared is what was on the line.
typedef struct {
  uint64_t tick;
  uint8_t state[TF_STATE_BYTES], report[TF_REPORT_BYTES];
  bool has_report;
  bool sent;         ///< an input went up
  bool answered;     ///< ... and its answer came back
  int code;          ///< of the answer
  uint16_t sequence; ///< of the input's frame
  uint64_t effect;   ///< tick of the state that the input found
  tf_input_t input;
  tf_input_t own; ///< what the controller makes of the twin
} hil_sample_t;

typedef struct {
  cli_source_t source;
  tf_decoder_t decoder;
  uint8_t buffer[TF_DECODER_ROOM(TF_FRAME_PAYLOAD)];
  uint16_t sequence; ///< of the next frame that goes up
  // From its schema.
  bool has_schema;
  tf_params_t params;
  const tf_scene_t *scene;
  uint32_t seed;
  // The command that waits for its answer, said `tries` times from `first` on.
  uint16_t first;
  int tries;
  bool has_answer;
  int answer;
  // The states of the run, in order, of ticks that are multiples of `every`;
  // one of a tick seen before is not kept.
  uint32_t every;
  hil_sample_t *samples;
  size_t count, room;
  bool listens; ///< states are kept
  bool has_new; ///< one came since it was last looked at
  tf_heartbeat_t heartbeat;
  bool has_heartbeat;
} hil_board_t;

/// Reads what comes within so many milliseconds.
/// Returns: HIL_EQUAL, or why it cannot go on (complained).
hil_code_t hil_board_listen(hil_board_t *board, int milliseconds);

/// Sends a command. payload: NULL where it has none.
hil_code_t hil_board_send(hil_board_t *board, tf_type_t type, uint64_t tick,
                          const uint8_t *payload, size_t length);

/// Sends a command and waits until it took effect.
hil_code_t hil_board_order(hil_board_t *board, tf_type_t type);

/// Sends the input of a sample, not to take effect before a tick.
hil_code_t hil_board_drive(hil_board_t *board, hil_sample_t *sample,
                           uint64_t tick);

/// Samples of late whose input has no answer yet.
size_t hil_board_waiting(const hil_board_t *board);

#endif
