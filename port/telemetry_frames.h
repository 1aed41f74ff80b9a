/// @file
/// Telemetry as frames (docs/PROTOCOL.md): state and report in every record,
/// heartbeats, and after each heartbeat the schema and the layouts once more,
/// so that a reader who connects late can decode the rest.
#ifndef TWOFOLD_PORT_TELEMETRY_FRAMES_H
#define TWOFOLD_PORT_TELEMETRY_FRAMES_H

#include "port.h"
#include "sim.h"

static uint32_t telemetry_sequence;
static uint8_t telemetry_description; // its next part
// Behind a heartbeat its parts are 4 ms apart: together they would delay the
// records of several ticks, and controllers at 1 kHz by as much.
static bool telemetry_is_paced;
static uint32_t telemetry_described_at; // ticks of the board's clock
static uint32_t telemetry_run;
static uint32_t telemetry_chain;

// Counts a frame in the chain that the next heartbeat reports. Returns: its
// size.
static unsigned telemetry_done(uint8_t *frame, size_t size) {
  const uint8_t *crc = frame + size - 1 - TF_FRAME_CRC;
  telemetry_chain = tf_frame_chain(telemetry_chain, crc);
  return (unsigned)size;
}

// With the tag of a board that has a key.
static size_t telemetry_vouched(uint8_t *frame, size_t size) {
#ifdef UPLINK_KEY
  return tf_frame_vouch(frame, size, sim_key, sim.link.nonce);
#else
  (void)frame;
  return size;
#endif
}

static unsigned telemetry_record(uint8_t *to) {
  const unsigned n =
      telemetry_done(to, tf_send_state(to, &telemetry_sequence, &SIM_STATE));
  return n + telemetry_done(to + n, tf_send_report(to + n, &telemetry_sequence,
                                                   SIM_STATE.tick, &SIM_REPORT,
                                                   SIM_SOURCE));
}

// time: less than 2^32, so the product fits. What does not fit the frame stays
// at its largest number.
static uint32_t nanoseconds(uint64_t time) {
  return at_most_32_bits(time * 1000000000u / port_clock_rate());
}

static unsigned telemetry_heartbeat(const loop_counts_t *c, uint8_t *to) {
  tf_heartbeat_t beat = {.steps = (uint32_t)c->steps,
                         .refused = at_most_32_bits(SIM_TALLY.refused),
                         .overruns = c->overruns,
                         .dropped = c->dropped,
                         .exec_max = nanoseconds(c->longest),
                         .period = 1000000000u / RATE,
                         .degraded = at_most_32_bits(SIM_TALLY.degraded),
                         .fell_back = at_most_32_bits(SIM_TALLY.fell_back),
                         .coarse = at_most_32_bits(SIM_TALLY.coarse),
                         .stalled = at_most_32_bits(SIM_TALLY.stalled),
                         .skipped = c->skipped,
                         .run = telemetry_run,
                         .chain = telemetry_chain};
  if (c->steps > 0) {
    beat.exec_min = nanoseconds(c->shortest);
    beat.exec_mean = nanoseconds(loop_mean(c));
  }
#ifdef UPLINK
  beat.unread = port_unread();
  const tf_decoder_t *decoder = &sim.link.decoder;
  beat.bad = decoder->bad + decoder->too_long + decoder->bad_version;
  beat.lost = sim.link.lost;
  beat.ignored = sim.link.ignored;
  beat.superseded = sim.link.superseded;
  beat.late = sim.link.late;
  beat.expired = sim.simulation.expired;
#endif
  telemetry_description = 0;
  telemetry_is_paced = c->steps > 0;
  const size_t n =
      tf_send_heartbeat(to, &telemetry_sequence, SIM_STATE.tick, &beat);
  return telemetry_done(to, telemetry_vouched(to, n));
}

static tf_schema_t telemetry_described(void) {
  tf_schema_t schema = {.params = &SIM_PARAMS,
                        .scene = SCENE->name,
                        .build = BUILD_NAME,
                        .seed = SIM_STATE.seed,
                        .scheme = SCHEME + (TF_STEP_SPLITS ? 0 : 4),
                        .takes_commands = SIM_TAKES_COMMANDS,
                        .run = telemetry_run};
#ifdef UPLINK
  schema.wants_tag = SIM_WANTS_TAG;
  schema.session = sim.link.session;
  schema.sequence = sim.link.next;
  schema.deadman = sim.simulation.deadman;
#endif
  return schema;
}

// At the start, of which the hash of the run is.
static void telemetry_begin(void) {
  const tf_schema_t schema = telemetry_described();
  telemetry_run = tf_run_hash(0, &schema, &SIM_STATE);
}

static size_t telemetry_schema(uint8_t *to) {
  const tf_schema_t schema = telemetry_described();
  return telemetry_vouched(
      to, tf_send_schema(to, &telemetry_sequence, SIM_STATE.tick, &schema));
}

static size_t telemetry_layout(uint8_t *to, tf_type_t type,
                               const char *layout) {
  return tf_send_layout(to, &telemetry_sequence, SIM_STATE.tick, type, layout);
}

#ifdef UPLINK
// The next answer, or that inputs have expired. Returns: bytes; 0: neither.
static size_t telemetry_answer(uint8_t *to) {
  if (!sim.has_expired || sim.answers > 0) {
    const size_t n = tf_link_answer(&sim.link, to, &telemetry_sequence);
    if (sim.answers > 0) sim.answers--;
    if (n > 0 || !sim.has_expired) return n;
  }
  sim.has_expired = false;
  sim.answers = 0;
  (void)tf_wire_put(to + TF_FRAME_AT, sim.simulation.expired, TF_EXPIRED_BYTES);
  return tf_frame_seal(to, TF_DOWN_EXPIRED, TF_EXPIRED_BYTES,
                       &telemetry_sequence, sim.expired_at);
}
#endif

static size_t telemetry_next(uint8_t *to) {
#ifdef UPLINK
  const size_t n = telemetry_answer(to);
  if (n > 0) return telemetry_vouched(to, n);
  // Behind the answer to the command that wants it.
  if (sim.link.describe && !sim.link.has_aside) {
    telemetry_description = 0;
    telemetry_is_paced = false;
    sim.link.describe = false;
  }
#endif
  const uint32_t now = port_ticks(), gap = RATE / 250;
  if (telemetry_is_paced && now - telemetry_described_at < gap) return 0;
  telemetry_described_at = now;
  switch (telemetry_description) {
    case 0:
      telemetry_description++;
      return telemetry_schema(to);
    case 1:
      telemetry_description++;
      return telemetry_layout(to, TF_DOWN_STATE, tf_layout_state);
    case 2:
      telemetry_description++;
      return telemetry_layout(to, TF_DOWN_REPORT, tf_layout_report);
    case 3:
      telemetry_description++;
      return telemetry_layout(to, TF_DOWN_HEARTBEAT, tf_layout_heartbeat);
    default:
      return 0;
  }
}

static unsigned telemetry_other(uint8_t *to) {
  const size_t n = telemetry_next(to);
  return n > 0 ? telemetry_done(to, n) : 0;
}

#endif
