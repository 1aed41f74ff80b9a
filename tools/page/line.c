// A board's line for the page: the decoder of the core and the receiver of
// `twofold monitor`, which reads boards of either real type.
#include <string.h>

#include "cli/monitor/receiver.h"
#include "module.h"

#define LINE_BYTES 4096
#define LINE_ROWS 256
#define LINE_COLUMNS 10 // those of the CSV, the mode as its number
static uint8_t bytes[LINE_BYTES];
static uint8_t buffer[TF_DECODER_SIZE(TF_FRAME_PAYLOAD)];
static tf_decoder_t decoder;
static cli_receiver_t receiver;
static double rows[LINE_ROWS][LINE_COLUMNS];
static double counters[9];
static uint32_t sequence;

void EXPORT(line_open)(void) {
  receiver = (cli_receiver_t){0};
  sequence = 0;
  tf_decoder_init(&decoder, buffer, sizeof buffer);
}

// Where the page puts bytes from the line, and takes those for it.
uint8_t *EXPORT(line_bytes)(void) { return bytes; }

uint32_t EXPORT(line_room)(void) { return LINE_BYTES; }

// Decodes so many bytes. Returns: how many rows they completed. A frame takes
// more than LINE_BYTES / LINE_ROWS bytes, so there is room for all.
uint32_t EXPORT(line_take)(uint32_t length) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < length && i < LINE_BYTES; i++) {
    tf_frame_t frame;
    cli_csv_t row;
    if (!tf_decoder_push(&decoder, bytes[i], &frame) ||
        !cli_receiver_take(&receiver, &frame, &row))
      continue;
    memcpy(rows[count], row.column, sizeof row.column);
    rows[count][8] = row.mode;
    rows[count][9] = row.choices;
    count++;
  }
  return count;
}

const double *EXPORT(line_rows)(void) { return rows[0]; }

// Frames, damaged ones, lost ones, rows, rows without their other half,
// unknown frames, whether the schema has come, whether numbers are floats,
// changes of the run.
const double *EXPORT(line_counters)(void) {
  const double now[9] = {
      decoder.frames,
      (double)decoder.bad + decoder.too_long + decoder.bad_version,
      decoder.lost,
      (double)receiver.rows,
      (double)receiver.incomplete,
      (double)receiver.unknown,
      receiver.has_schema,
      receiver.is_float,
      (double)receiver.other_runs};
  memcpy(counters, now, sizeof counters);
  return counters;
}

// The command that asks a board for its schema, in `line_bytes`. Returns: its
// length.
uint32_t EXPORT(line_describe)(void) {
  return (uint32_t)tf_command_seal(bytes, TF_UP_DESCRIBE, 0, 0, &sequence, 0,
                                   0);
}
