/// @file
/// Telemetry as CSV, for tools that plot numbers separated by commas: the
/// columns of `twofold run`, time to a microsecond, the others in up to six
/// digits; mode and set are numbers (docs/PROTOCOL.md), because such tools draw
/// numbers only. The header is sent
/// at the start and every ten seconds, for readers who connect late; nothing
/// else is sent, because a row of another length is another table to them.
#ifndef TWOFOLD_PORT_TELEMETRY_CSV_H
#define TWOFOLD_PORT_TELEMETRY_CSV_H

#include "../tools/columns.h"
#include "sim.h"
#include "text.h"

/// Heartbeats, which come once a second, from header to header.
#define TELEMETRY_HEADER_EVERY 10u

static uint8_t telemetry_until_header;
static bool telemetry_header_is_due;

// Of whole numbers: six digits would lose the milliseconds after a while.
static void telemetry_time(text_t *text, uint64_t tick) {
  const uint32_t part = (uint32_t)(tick % RATE);
  text_whole(text, (uint32_t)(tick / RATE), 1);
  text_byte(text, '.');
  text_whole(text, (uint32_t)((uint64_t)part * 1000000u / RATE), 6);
  text_byte(text, ',');
}

static void telemetry_number(text_t *text, tf_real_t value) {
  text->end += tf_decimal((char *)text->end, value);
  text_byte(text, ',');
}

#define TELEMETRY_TIME(name, unit, value) telemetry_time(&text, state->tick);
#define TELEMETRY_NUMBER(name, unit, value) telemetry_number(&text, value);

static unsigned telemetry_record(uint8_t *to) {
  const tf_state_t *state = &SIM_STATE;
  const tf_report_t *report = &SIM_REPORT;
  text_t text = {to};
  EACH_COLUMN(TELEMETRY_TIME, TELEMETRY_NUMBER, COLUMN_NONE)
  text_whole(&text, SIM_REPORT.mode, 1);
  text_pair(&text, ",", SIM_REPORT.choices);
  text_pair(&text, ",", SIM_REPORT.set);
  text_string(&text, "\r\n");
  return (unsigned)(text.end - to);
}

static unsigned telemetry_heartbeat(const loop_counts_t *c, uint8_t *to) {
  (void)c;
  (void)to;
  if (telemetry_until_header == 0) {
    telemetry_until_header = TELEMETRY_HEADER_EVERY;
    telemetry_header_is_due = true;
  }
  telemetry_until_header--;
  return 0;
}

static unsigned telemetry_other(uint8_t *to) {
  text_t text = {to};
  if (telemetry_header_is_due) text_string(&text, COLUMN_HEADER "\r\n");
  telemetry_header_is_due = false;
  return (unsigned)(text.end - to);
}

#endif
