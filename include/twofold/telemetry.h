/// @file
/// Telemetry: the frames that go down, from the board to the host.
/// docs/PROTOCOL.md describes their payloads byte by byte. Each tf_send
/// function writes one whole frame into memory; a program contains only those
/// that it calls. Last, a state as text.
/// wire: out, TF_FRAME_SIZE of the payload's bytes.
/// sequence: in/out, number of this frame; then that of the next.
/// tick: in, of the state that the contents belong to.
/// Returns: bytes of the frame.
#ifndef TWOFOLD_TELEMETRY_H
#define TWOFOLD_TELEMETRY_H

#include "twofold/frame.h"
#include "twofold/simulation.h"

TF_BEGIN_C

/// Types of frames: those below 0x40 go down, the others up.
typedef enum {
  TF_DOWN_SCHEMA = 0x01,    ///< scene, parameters, scheme, real type
  TF_DOWN_LAYOUT = 0x02,    ///< names, types, scales, units of one payload
  TF_DOWN_STATE = 0x03,     ///< the complete state
  TF_DOWN_REPORT = 0x04,    ///< tf_report_t of the last step
  TF_DOWN_HEARTBEAT = 0x06, ///< counters of the real-time loop
  TF_DOWN_ANSWER = 0x08,    ///< the result of a command
  TF_DOWN_EXPIRED = 0x09,   ///< inputs from outside have expired
  TF_UP_INPUT = 0x41,
  TF_UP_PARAMETER = 0x42,
  TF_UP_RULE = 0x43,
  TF_UP_START = 0x44,
  TF_UP_STOP = 0x45,
  TF_UP_RESET = 0x46,
  TF_UP_SNAPSHOT = 0x47,
  TF_UP_RESTORE = 0x48,
  TF_UP_CLEAR = 0x49,
  TF_UP_DESCRIBE = 0x4A,
  TF_UP_DEADMAN = 0x4B,
  TF_UP_EVERY = 0x4C,
  TF_UP_SETPOINT = 0x4D
} tf_type_t;

/// Bytes of the payloads; at most, of those that end with text. Behind a schema
/// there is room for a tag.
#define TF_SCHEMA_BYTES (TF_FRAME_PAYLOAD - 8u)
#define TF_LAYOUT_BYTES TF_FRAME_PAYLOAD
#define TF_STATE_BYTES (4 * TF_REAL_BYTES + 5)
#define TF_REPORT_BYTES (6 * TF_REAL_BYTES + 5)
#define TF_HEARTBEAT_BYTES 88u
#define TF_EXPIRED_BYTES 4u

/// Contents of a schema frame.
typedef struct {
  const tf_params_t *params;
  const char *scene, *build; ///< names, cut off where they do not fit
  uint32_t seed;
  uint8_t scheme; ///< 0 tf_step, 1 _located, 2 _compensated; 4 more: no split
  bool takes_commands; ///< the build has an uplink
  bool wants_tag;      ///< commands without the tag of its key are refused
  bool ends;           ///< the last frame is a heartbeat; a board's has no end
  uint32_t session;    ///< that commands have to name; 0: none yet
  uint32_t sequence;   ///< least number of a command that is still taken
  uint32_t deadman;    ///< tf_simulation_t.deadman
  uint32_t run;        ///< tf_run_hash: in the heartbeats of this run too
} tf_schema_t;

/// Counters of a real-time loop, in the order of their payload. Each is modulo
/// 2^32, except those of steps that were not TF_OK: they stay at 2^32 - 1.
typedef struct {
  uint32_t steps;    ///< taken
  uint32_t refused;  ///< by the scheme; the state is untouched
  uint32_t overruns; ///< steps that ended after the next tick
  uint32_t dropped;  ///< telemetry records, for lack of room or time
  uint32_t bad;      ///< frames from the host that came broken
  uint32_t ignored;  ///< commands without an answer: queue full, cleared
  /// Execution time of a step, from input to output, since the start [ns].
  uint32_t exec_min, exec_mean, exec_max;
  uint32_t period;    ///< nominal period of the tick [ns]
  uint32_t degraded;  ///< steps TF_DEGRADED
  uint32_t fell_back; ///< steps TF_FELL_BACK
  uint32_t coarse;    ///< steps TF_COARSE
  uint32_t stalled;   ///< steps TF_STALLED
  uint32_t expired;   ///< inputs from outside that were not renewed in time
  uint32_t skipped;   ///< ticks that got no step
  uint32_t lost;      ///< commands that never came, by their numbers
  uint32_t
      superseded;  ///< setpoints that a newer one replaced before their step
  uint32_t late;   ///< setpoints that took effect after the tick they name
  uint32_t unread; ///< bytes that came broken, or to a full buffer
  uint32_t run;    ///< tf_schema_t.run
  uint32_t chain;  ///< tf_frame_chain of all frames before this one
} tf_heartbeat_t;

/// Hash of all parameters that the motion depends on, the same on every board:
/// CRC-32 over them in the order of tf_parameter_ranges, as they are sent, then
/// law, rule and bits 0, 2 and 3 of the flags of a schema frame, a byte each.
#define tf_params_hash TF_LINK(tf_params_hash)
TF_API uint32_t tf_params_hash(const tf_params_t *params);

/// Hash of a run, which separates the frames of two: CRC-32 over the hash
/// of its parameters, scheme, tick and state of its start as they are sent, and
/// the names of scene and build.
/// before: in, 0, or a CRC-32 of what else the run depends on. schema: in, but
///   for `run`. start: in.
#define tf_run_hash TF_LINK(tf_run_hash)
TF_API uint32_t tf_run_hash(uint32_t before, const tf_schema_t *schema,
                            const tf_state_t *start);

/// Frame TF_DOWN_SCHEMA, of up to TF_SCHEMA_BYTES.
#define tf_send_schema TF_LINK(tf_send_schema)
TF_API size_t tf_send_schema(uint8_t *wire, uint32_t *sequence, uint64_t tick,
                             const tf_schema_t *schema);

/// Names, types, scales and units of the payloads, for tf_send_layout, in the
/// form that docs/PROTOCOL.md has (02 layout).
#define tf_layout_state TF_LINK(tf_layout_state)
TF_API_DATA const char *const tf_layout_state;
#define tf_layout_report TF_LINK(tf_layout_report)
TF_API_DATA const char *const tf_layout_report;
#define tf_layout_heartbeat TF_LINK(tf_layout_heartbeat)
TF_API_DATA const char *const tf_layout_heartbeat;

/// Frame TF_DOWN_LAYOUT, of up to TF_LAYOUT_BYTES.
/// type: in, of the frames that are described. layout: in, one of those above;
///   a longer text is cut off at the end of the frame.
#define tf_send_layout TF_LINK(tf_send_layout)
TF_API size_t tf_send_layout(uint8_t *wire, uint32_t *sequence, uint64_t tick,
                             tf_type_t type, const char *layout);

/// Frame TF_DOWN_STATE, of TF_STATE_BYTES: all that tf_step needs to continue.
#define tf_send_state TF_LINK(tf_send_state)
TF_API size_t tf_send_state(uint8_t *wire, uint32_t *sequence,
                            const tf_state_t *state);

/// Frame TF_DOWN_REPORT, of TF_REPORT_BYTES.
/// source: in, whose inputs its step had.
#define tf_send_report TF_LINK(tf_send_report)
TF_API size_t tf_send_report(uint8_t *wire, uint32_t *sequence, uint64_t tick,
                             const tf_report_t *report,
                             tf_input_source_t source);

/// Frame TF_DOWN_HEARTBEAT, of TF_HEARTBEAT_BYTES.
#define tf_send_heartbeat TF_LINK(tf_send_heartbeat)
TF_API size_t tf_send_heartbeat(uint8_t *wire, uint32_t *sequence,
                                uint64_t tick, const tf_heartbeat_t *heartbeat);

/// Reads the payload of TF_DOWN_HEARTBEAT, TF_HEARTBEAT_BYTES.
#define tf_read_heartbeat TF_LINK(tf_read_heartbeat)
TF_API void tf_read_heartbeat(const uint8_t *payload,
                              tf_heartbeat_t *heartbeat);

/// Reads the payload of TF_DOWN_STATE, TF_STATE_BYTES from a sender of the same
/// real type, and the tick from the header of its frame.
/// state: out, not validated.
#define tf_read_state TF_LINK(tf_read_state)
TF_API void tf_read_state(const uint8_t *payload, uint64_t tick,
                          tf_state_t *state);

/// What a line carries, and what telemetry needs of it [bytes/s].
typedef struct {
  uint32_t rate;    ///< steps a second
  uint32_t record;  ///< bytes that go with each record, at most
  uint32_t beside;  ///< for what is sent each second
  uint32_t carries; ///< 0: not known, and no limit
} tf_line_t;

/// For frames: state and report in each record, and, where commands are taken,
/// the answer to one; a heartbeat, a schema and the three layouts each second.
/// baud: in, of 10 bits a byte; 0: not known. scene, build: in, names. tag: in,
///   bytes of the tag of a board with a key, or 0.
#define tf_line_of_frames TF_LINK(tf_line_of_frames)
TF_API tf_line_t tf_line_of_frames(uint32_t rate, uint32_t baud,
                                   const char *scene, const char *build,
                                   bool takes_commands, uint32_t tag);

/// Returns: what the line must carry for a record every `every` > 0 steps.
#define tf_line_asks TF_LINK(tf_line_asks)
TF_API uint64_t tf_line_asks(const tf_line_t *line, uint32_t every);

/// Longest line.
#define TF_TEXT_ROW_ROOM 96

/// A state as text, for the serial plotter of the Arduino IDE: writes "r:0.18
/// v:1.2 omega:-1.037 h:1e-10 g:0.05" and a newline, in up to six digits,
/// without a terminating zero.
/// out: out, TF_TEXT_ROW_ROOM characters. state, report: in.
/// Returns: the length.
#define tf_text_row TF_LINK(tf_text_row)
TF_API size_t tf_text_row(char *out, const tf_state_t *state,
                          const tf_report_t *report);

TF_END_C

#endif
