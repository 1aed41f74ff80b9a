// A board's line for the page: the decoder of the core and the receiver of
// `twofold monitor`, which reads boards of either real type.
#include <string.h>

#include "cli/monitor/receiver.h"
#include "module.h"

#define LINE_ROWS 256
static uint8_t buffer[TF_DECODER_SIZE(TF_FRAME_PAYLOAD)];
static tf_decoder_t decoder;
static cli_receiver_t receiver;
static double rows[LINE_ROWS][CLI_CSV_COLUMNS + 3]; // mode, set: numbers
static double counters[9];
static uint32_t sequence;

void EXPORT(line_open)(void) {
  receiver = (cli_receiver_t){0};
  sequence = 0;
  tf_decoder_init(&decoder, buffer, sizeof buffer);
}

// Decodes so many bytes of the text. Returns: how many rows they completed. A
// frame takes more than 16 bytes, so there is room for all of 4096.
uint32_t EXPORT(line_take)(uint32_t length) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < length && count < LINE_ROWS; i++) {
    tf_frame_t frame;
    cli_csv_t row;
    if (!tf_decoder_push(&decoder, (uint8_t)page_text[i], &frame) ||
        !cli_receiver_take(&receiver, &frame, &row))
      continue;
    memcpy(rows[count], row.column, sizeof row.column);
    rows[count][CLI_CSV_COLUMNS] = row.mode;
    rows[count][CLI_CSV_COLUMNS + 1] = row.choices;
    rows[count][CLI_CSV_COLUMNS + 2] = row.set;
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

// The command that asks a board for its schema, as the text. Returns: its
// length.
uint32_t EXPORT(line_describe)(void) {
  return (uint32_t)tf_command_seal((uint8_t *)page_text, TF_UP_DESCRIBE, 0, 0,
                                   &sequence, 0, 0);
}
