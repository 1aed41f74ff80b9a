// A record of `monitor --record` to `run --replay`. The input is a list of
// rows: commands of every type with any data at any step, or any text; the
// schema before them is that of the machine, or is not, and the last line is
// right or missing. What is accepted is replayed for some steps: states and
// inputs stay in their ranges, and the end comes when the rows do.
#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L // fmemopen
#endif

#include <inttypes.h>
#include <stdio.h>

#include "cli/run/replay.h"
#include "cli/text/buffer.h"
#include "cli/text/message.h"
#include "cli/text/trailer.h"
#include "verify/fuzz/fuzz.h"

#define ROOM 16384
#define MAX_ROWS 24
#define STEPS 200

typedef struct {
  cli_buffer_t text;
  cli_trailer_t sum;
  uint64_t tick; // of the last row
} record_t;

static void add_line(record_t *record, const char *line, uint64_t rows) {
  cli_add(&record->text, line);
  cli_trailer_add(&record->sum, line, strlen(line), rows);
}

static void add_row(record_t *record, uint64_t tick, uint8_t type,
                    const uint8_t *data, size_t length) {
  char row[2 * TF_FRAME_PAYLOAD + 64];
  size_t at = (size_t)snprintf(row, sizeof row, "%" PRIu64 ",%02x,", tick,
                               (unsigned)type);
  for (size_t i = 0; i < length; i++)
    at +=
        (size_t)snprintf(row + at, sizeof row - at, "%02x", (unsigned)data[i]);
  (void)snprintf(row + at, sizeof row - at, ",x\n");
  if (type == TF_DOWN_SCHEMA)
    cli_trailer_name(&record->sum, row, strlen(row) - 1);
  add_line(record, row, 1);
}

// The schema of the machine, with a byte changed where the input says so.
static void add_schema(record_t *record, const cli_setup_t *setup,
                       fuzz_bytes_t *in) {
  uint8_t wire[TF_FRAME_SIZE(TF_FRAME_PAYLOAD)], room[TF_FRAME_PAYLOAD + 32];
  const tf_schema_t schema = {.params = &setup->params,
                              .scene = setup->scene->name,
                              .build = "fuzz",
                              .seed = 1,
                              .takes_commands = true,
                              .deadman = fuzz_byte(in)};
  uint32_t sequence = 0;
  size_t taken = 0;
  tf_decoder_t decoder;
  tf_frame_t frame;
  tf_decoder_init(&decoder, room, sizeof room);
  const size_t size = tf_send_schema(wire, &sequence, 0, &schema);
  if (!tf_decoder_block(&decoder, wire, size, &taken, &frame)) return;
  uint8_t data[TF_FRAME_PAYLOAD];
  memcpy(data, frame.payload, frame.length);
  const unsigned wrong = fuzz_byte(in);
  if (wrong >= 240) data[wrong % 32u] ^= fuzz_byte(in);
  add_row(record, 0, TF_DOWN_SCHEMA, data, frame.length);
}

// Any bytes as a line.
static void add_noise(record_t *record, fuzz_bytes_t *in) {
  char line[34];
  size_t length = fuzz_byte(in) % 32u;
  for (size_t i = 0; i < length; i++) {
    line[i] = (char)fuzz_byte(in);
    if (line[i] == '\0') line[i] = 'x';
  }
  line[length] = '\n';
  line[length + 1] = '\0';
  add_line(record, line, 1);
}

// A command whose data have the length that it asks for, most of the time.
static void add_command(record_t *record, fuzz_bytes_t *in) {
  static const uint8_t lengths[] = {5 * TF_REAL_BYTES,
                                    1 + TF_REAL_BYTES,
                                    5,
                                    0,
                                    0,
                                    0,
                                    0,
                                    8 + TF_STATE_BYTES,
                                    0,
                                    0,
                                    4};
  uint8_t data[TF_FRAME_PAYLOAD];
  const unsigned which = fuzz_byte(in);
  const unsigned type = which % sizeof lengths;
  size_t length = which >= 220 ? fuzz_byte(in) % 240u : lengths[type];
  if (length > sizeof data) length = sizeof data;
  const uint8_t step = fuzz_byte(in);
  if (step < 200) record->tick += step % 32u;
  for (int i = 0; step >= 200 && i < 8; i++)
    record->tick = record->tick << 8 | fuzz_byte(in);
  size_t i = 0;
  if (type < 2) { // numbers, as one corpus says them to both real types
    if (type == 1) data[i++] = fuzz_byte(in);
    for (; i + TF_REAL_BYTES <= length; i += TF_REAL_BYTES)
      (void)tf_wire_put_real(data + i, fuzz_real(in));
  }
  for (; i < length; i++) data[i] = fuzz_byte(in);
  add_row(record, record->tick,
          which % 37u == 0 ? TF_DOWN_STATE : (uint8_t)(TF_UP_INPUT + type),
          data, length);
  if (TF_UP_INPUT + type == TF_UP_RESET) record->tick = 0;
}

static void make(record_t *record, const cli_setup_t *setup, fuzz_bytes_t *in) {
  char last[CLI_TRAILER_ROOM];
  const unsigned seals = fuzz_byte(in);
  add_line(record, "tick,type,data,command\n", 0);
  if (seals % 8u != 1) add_schema(record, setup, in);
  for (int i = 0; i < MAX_ROWS && in->at < in->end; i++) {
    if (fuzz_byte(in) >= 250)
      add_noise(record, in);
    else
      add_command(record, in);
  }
  (void)cli_trailer_line(&record->sum, &cli_whole_shard, last);
  if (seals % 8u != 2) cli_add(&record->text, last);
}

static const char *replay_it(cli_replay_t *replay, cli_setup_t *setup) {
  uint64_t steps = 0;
  cli_system_t system;
  tf_report_t report = setup->report;
  tf_input_t input;
  const int code = cli_replay_begin(replay, setup, &cli_schemes[0], &steps);
  FUZZ_HOLD(code == CLI_DONE || code == CLI_REFUSED);
  if (code != CLI_DONE) return NULL;
  FUZZ_HOLD(steps <= CLI_MAX_STEPS);
  cli_system_begin(&system, &cli_schemes[0], setup, &report);
  uint64_t taken = 0;
  for (; taken < STEPS; taken++) {
    if (!cli_replay_next(replay, &system, setup->scene, &report, &input)) break;
    FUZZ_HOLD(fuzz_in_reach(&system.state));
    FUZZ_HOLD(fuzz_finite(input.omega0) && fuzz_finite(input.r0));
    FUZZ_HOLD(fuzz_finite(input.force) && fuzz_finite(input.torque));
    if (cli_schemes[0].step(&system, &input, &report) < 0) return NULL;
    FUZZ_HOLD(fuzz_in_reach(&system.state));
  }
  FUZZ_HOLD(replay->commands + replay->states <= replay->count);
  FUZZ_HOLD(taken <= steps);
  FUZZ_HOLD(taken == STEPS || replay->failed != NULL ||
            (replay->next == replay->count && taken == steps));
  return NULL;
}

const char *fuzz_record(const uint8_t *data, size_t size) {
  static const cli_settings_t none = {.count = 0};
  static char text[ROOM];
  record_t record = {.text = {text, 0, sizeof text, false}};
  cli_replay_t replay;
  cli_setup_t setup;
  fuzz_bytes_t in = {data, data + size};
  memset(&replay, 0, sizeof replay);
  FUZZ_HOLD(cli_setup_read(&setup, tf_scenes[0], &none, NULL) == CLI_DONE);
  FUZZ_HOLD(cli_setup_machine(&setup) == CLI_DONE);
  FUZZ_HOLD(cli_setup_start(&setup) == CLI_DONE);
  make(&record, &setup, &in);
  FILE *file = fmemopen(text, record.text.used, "r");
  FUZZ_HOLD(file != NULL);
  const int code = cli_replay_parse(&replay, "fuzz.record", file);
  (void)fclose(file);
  const char *broken = NULL;
  if (code == CLI_DONE) broken = replay_it(&replay, &setup);
  cli_replay_free(&replay);
  FUZZ_HOLD(code == CLI_DONE || code == CLI_USAGE || code == CLI_REFUSED);
  return broken;
}
