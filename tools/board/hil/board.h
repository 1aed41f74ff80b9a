/// The board at the other end of the line, the plan of the closed loop, how a
/// board is driven in response to its states (board.c), and what judges it
/// (twin.c). The controller is control.h.
#pragma once

#include "board/hil/control.h"
#include "cli/host/host.h"
#include "cli/text/text.h"

/// Exit codes are those of the command line. The closed loop ends with CLI_DONE
/// if its bits are those of the run on the host alone, else with this code.
enum { HIL_DIFFERS = 1 };

/// Prints "hil: " and a message on standard error. Returns: the code.
int hil_message(int code, const char *format, ...) CLI_PRINTF(2, 3);

typedef struct {
  uint64_t steps;  ///< number of steps
  uint64_t every;  ///< steps from sample to sample
  uint64_t delay;  ///< steps from a sample to the effect of its input
  uint64_t silent; ///< from this step on no input is sent
  uint64_t
      deadman; ///< ticks that an input holds; HIL_BOARDS: as the board says
  bool in_lockstep; ///< the board waits for each input
} hil_plan_t;
#define HIL_BOARDS UINT64_MAX

/// A state as it was received, with the controller's response to it. Payloads
/// are kept as bytes, because the bytes on the line are what is compared.
typedef struct {
  uint64_t tick;
  uint8_t state[TF_STATE_BYTES], report[TF_REPORT_BYTES];
  bool has_report;
  bool sent;         ///< an input was sent
  bool answered;     ///< ... and answered
  int code;          ///< of the answer
  uint32_t sequence; ///< number of the input
  uint64_t effect;   ///< tick at which the input took effect
  tf_input_t input;
  tf_input_t own; ///< the controller's response to the host run
} hil_sample_t;

typedef struct {
  hil_plan_t plan;
  cli_source_t source;
  tf_decoder_t decoder;
  uint8_t buffer[TF_DECODER_SIZE(TF_FRAME_PAYLOAD)];
  uint32_t sequence;  ///< number of the next command
  const uint8_t *key; ///< NULL: the board wants no tag
  cli_guard_t guard;
  // From the schema frame.
  uint32_t session; ///< that commands name; 0: not known yet
  bool has_session; ///< it is not 0
  uint32_t deadman; ///< ticks that an input holds, before this host changes it
  tf_params_t params;
  const tf_scene_t *scene;
  uint32_t seed;
  // The command whose answer is awaited.
  tf_type_t ordered;
  uint32_t number;
  int tries; // how often it was sent
  bool has_answer;
  int answer;
  // The dated stop of a board in lockstep.
  uint32_t stop_number;
  bool has_stopped;
  uint64_t stopped_at;
  // The states of the run in order, one for each tick that is a multiple of
  // plan.every.
  uint64_t stride; ///< divides the ticks of all states that came; 0: of none
  hil_sample_t *samples;
  size_t count, room;
  uint64_t *expired;    ///< ticks from which inputs that expired held no longer
  size_t expired_count; ///< at most `room`
  bool listens;         ///< states are kept
  bool has_new;         ///< a state has come since the last response
  bool is_answered;     ///< no recent input waits for its answer
  tf_heartbeat_t heartbeat;
  bool has_heartbeat;
} hil_board_t;

typedef struct {
  size_t compared, differ; ///< states and reports, byte for byte
  size_t inputs, wrong;    ///< inputs, and those unlike the twin's
  size_t late;             ///< inputs in effect at another tick than planned
  size_t unanswered;       ///< inputs without an answer
  size_t missing;          ///< samples of the plan that were not received
  uint32_t expired;        ///< inputs that were not renewed in time
  uint64_t first;          ///< tick of the first difference
  double rms_error;        ///< of the disc's speed [rad/s]
  tf_state_t end;
} hil_verdict_t;

/// Puts the board at the start of its scene, runs it according to the plan, and
/// stops it.
int hil_drive(hil_board_t *board);

/// Runs the digital twin, controller and machine in one process without a line
/// and without a clock, whose bits the closed loop should have, and compares.
/// Inputs take effect at the ticks that the board's answers give: the planned
/// ones, unless an input was late.
/// Returns: CLI_DONE, HIL_DIFFERS, CLI_REFUSED (a step is refused).
int hil_twin_compare(hil_board_t *board, hil_verdict_t *verdict);
