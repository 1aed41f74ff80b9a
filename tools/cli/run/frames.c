// A run as frames, made by the functions that a board calls, so that whatever
// reads a board reads a recorded run as well.

#include "frames.h"

size_t cli_frames_header(const cli_setup_t *setup, const cli_scheme_t *scheme,
                         uint64_t tick, uint32_t *sequence,
                         uint8_t out[CLI_FRAMES_ROOM]) {
  const tf_schema_t schema = {.params = &setup->params,
                              .scene = setup->scene->name,
                              .build = "twofold " TF_VERSION ", host",
                              .seed = setup->seed,
                              .scheme = scheme->code,
                              .ends = true};
  size_t at = tf_send_schema(out, sequence, tick, &schema);
  at +=
      tf_send_layout(out + at, sequence, tick, TF_DOWN_STATE, tf_layout_state);
  at += tf_send_layout(out + at, sequence, tick, TF_DOWN_REPORT,
                       tf_layout_report);
  return at + tf_send_layout(out + at, sequence, tick, TF_DOWN_HEARTBEAT,
                             tf_layout_heartbeat);
}

size_t cli_frames_row(uint32_t *sequence, const tf_state_t *state,
                      const tf_report_t *report, tf_input_source_t source,
                      uint8_t out[CLI_FRAMES_ROOM]) {
  const size_t at = tf_send_state(out, sequence, state);
  return at + tf_send_report(out + at, sequence, state->tick, report,
                             (uint8_t)source);
}

static uint32_t at_most_32_bits(uint64_t count) {
  return count < UINT32_MAX ? (uint32_t)count : UINT32_MAX;
}

size_t cli_frames_end(uint32_t *sequence, uint64_t tick, uint64_t steps,
                      uint64_t late, const tf_tally_t *tally,
                      uint8_t out[CLI_FRAMES_ROOM]) {
  const tf_heartbeat_t beat = {.steps = (uint32_t)steps,
                               .refused = at_most_32_bits(tally->refused),
                               .overruns = (uint32_t)late,
                               .degraded = at_most_32_bits(tally->degraded),
                               .fell_back = at_most_32_bits(tally->fell_back),
                               .coarse = at_most_32_bits(tally->coarse)};
  return tf_send_heartbeat(out, sequence, tick, &beat);
}
