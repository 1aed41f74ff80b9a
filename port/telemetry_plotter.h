/// @file
/// Telemetry as lines of label:value pairs for a serial plotter: tf_text_row
/// with mode and choices, and a heartbeat of the same form, whose times are in
/// units of port_clock.
#ifndef TWOFOLD_PORT_TELEMETRY_PLOTTER_H
#define TWOFOLD_PORT_TELEMETRY_PLOTTER_H

#include "sim.h"
#include "text.h"

static unsigned telemetry_record(uint8_t *to) {
  text_t text = {to};
  text.end +=
      tf_text_row((char *)to, &SIM_STATE, &SIM_REPORT) - 1; // its newline
  text_pair(&text, " mode:", SIM_REPORT.mode);
  text_pair(&text, " choices:", SIM_REPORT.choices);
  text_pair(&text, " set:", SIM_REPORT.set);
  text_string(&text, "\r\n");
  return (unsigned)(text.end - to);
}

static unsigned telemetry_heartbeat(const loop_counts_t *c, uint8_t *to) {
  text_t text = {to};
  text_pair(&text, "steps:", (uint32_t)c->steps);
  text_pair(&text, " overruns:", c->overruns);
  text_pair(&text, " skipped:", c->skipped);
  text_pair(&text, " sent:", c->sent);
  text_pair(&text, " dropped:", c->dropped);
  text_pair(&text, " flagged:",
            at_most_32_bits(SIM_TALLY.degraded + SIM_TALLY.fell_back +
                            SIM_TALLY.coarse + SIM_TALLY.stalled));
  text_pair(&text, " min:", c->steps > 0 ? c->shortest : 0);
  text_pair(&text, " mean:", loop_mean(c));
  text_pair(&text, " max:", c->longest);
  text_string(&text, "\r\n");
  return (unsigned)(text.end - to);
}

static unsigned telemetry_other(uint8_t *to) {
  (void)to;
  return 0;
}

#endif
