/// @file
/// Telemetry as frames (docs/PROTOCOL.md): state and report in every record,
/// a heartbeat, and after each heartbeat once more what describes them, so that
/// a reader who comes late can read.
#ifndef TWOFOLD_PORT_TELL_FRAMES_H
#define TWOFOLD_PORT_TELL_FRAMES_H

static uint16_t tell_sequence;
static uint8_t tell_description; // the next part of it

static unsigned tell_record(uint8_t *to) {
  const size_t n = tf_send_state(to, &tell_sequence, &STATE);
  return (unsigned)(n + tf_send_report(to + n, &tell_sequence, STATE.tick,
                                       &REPORT));
}

static uint32_t nanoseconds(uint64_t time) {
  return (uint32_t)(time * 1000000000u / port_clock_rate());
}

static unsigned tell_heartbeat(const loop_counts_t *c, uint8_t *to) {
  tf_heartbeat_t beat = {.steps = c->steps,
                         .refused = REFUSED,
                         .overruns = c->overruns,
                         .dropped = c->dropped,
                         .exec_max = nanoseconds(c->longest),
                         .period = 1000000000u / RATE};
  if (c->steps > 0) {
    beat.exec_min = nanoseconds(c->shortest);
    beat.exec_mean = nanoseconds(c->sum / c->steps);
  }
#ifdef UPLINK
  beat.bad = uplink.decoder.bad + uplink.decoder.lost;
  beat.ignored = uplink.ignored;
#endif
  tell_description = 0;
  return (unsigned)tf_send_heartbeat(to, &tell_sequence, STATE.tick, &beat);
}

static size_t tell_schema(uint8_t *to) {
  const tf_schema_t schema = {.params = &PARAMS,
                              .scene = SCENE->name,
                              .build = "twofold",
                              .seed = STATE.seed,
                              .scheme = SCHEME,
                              .takes_commands = TAKES_COMMANDS};
  return tf_send_schema(to, &tell_sequence, STATE.tick, &schema);
}

static size_t tell_layout(uint8_t *to, tf_type_t type, const char *layout) {
  return tf_send_layout(to, &tell_sequence, STATE.tick, type, layout);
}

static unsigned tell_other(uint8_t *to) {
#ifdef UPLINK
  const size_t n = tf_link_answer(&uplink, to, &tell_sequence);
  if (n > 0) return (unsigned)n;
  if (uplink.describe) tell_description = 0;
  uplink.describe = false;
#endif
  switch (tell_description) {
    case 0:
      tell_description++;
      return (unsigned)tell_schema(to);
    case 1:
      tell_description++;
      return (unsigned)tell_layout(to, TF_DOWN_STATE, tf_layout_state);
    case 2:
      tell_description++;
      return (unsigned)tell_layout(to, TF_DOWN_REPORT, tf_layout_report);
    case 3:
      tell_description++;
      return (unsigned)tell_layout(to, TF_DOWN_HEARTBEAT, tf_layout_heartbeat);
    default:
      return 0;
  }
}

#endif
