/// @file
/// Telemetry as lines that a plotter reads: tf_text_row with mode and choices,
/// and a heartbeat of the same form; its times are in units of port_clock.
#ifndef TWOFOLD_PORT_TELL_TEXT_H
#define TWOFOLD_PORT_TELL_TEXT_H

#include "text.h"

static unsigned tell_record(uint8_t *to) {
  text_t text = {to};
  text.end += tf_text_row((char *)to, &STATE, &REPORT) - 1; // its newline
  text_pair(&text, " mode:", REPORT.mode);
  text_pair(&text, " choices:", REPORT.choices);
  text_string(&text, "\r\n");
  return (unsigned)(text.end - to);
}

static unsigned tell_heartbeat(const loop_counts_t *c, uint8_t *to) {
  text_t text = {to};
  text_pair(&text, "steps:", c->steps);
  text_pair(&text, " overruns:", c->overruns);
  text_pair(&text, " skipped:", c->skipped);
  text_pair(&text, " sent:", c->sent);
  text_pair(&text, " dropped:", c->dropped);
  text_pair(&text, " min:", c->steps ? c->shortest : 0);
  text_pair(&text, " mean:", c->steps ? (uint32_t)(c->sum / c->steps) : 0);
  text_pair(&text, " max:", c->longest);
  text_string(&text, "\r\n");
  return (unsigned)(text.end - to);
}

static unsigned tell_other(uint8_t *to) {
  (void)to;
  return 0;
}

#endif
