// The payloads of telemetry. Each is written where tf_frame_seal expects it, so
// that nothing is copied.
#include "twofold/telemetry.h"

#include "parts.h"

// Appends as much of a text as fits before `end`. Returns: the byte after it.
static uint8_t *put_text(uint8_t *at, const uint8_t *end, const char *text) {
  while (*text != '\0' && at < end) *at++ = (uint8_t)*text++;
  return at;
}

static tf_real_t value_of(const tf_params_t *params, unsigned index) {
  return *(const tf_real_t *)(const void *)((const char *)params +
                                            tf_parameter_ranges[index].offset);
}

static size_t seal(uint8_t *wire, tf_type_t type, const uint8_t *end,
                   uint32_t *sequence, uint64_t tick) {
  return tf_frame_seal(wire, (uint8_t)type, (size_t)(end - wire) - TF_FRAME_AT,
                       sequence, tick);
}

// Bit 0: with_angle; bits 2 and 3: the law of rest.
static uint8_t flags_of(const tf_params_t *params) {
  return (uint8_t)((params->with_angle ? 1u : 0u) | (unsigned)params->rest
                                                        << 2);
}

TF_API uint32_t tf_params_hash(const tf_params_t *params) {
  uint32_t crc = 0;
  uint8_t bytes[sizeof(tf_real_t)];
  for (unsigned i = 0; i < TF_PARAMETERS; i++) {
    (void)tf_wire_put_real(bytes, value_of(params, i));
    crc = tf_crc32(crc, bytes, sizeof bytes);
  }
  const uint8_t choices[3] = {(uint8_t)params->law, (uint8_t)params->rule,
                              flags_of(params)};
  return tf_crc32(crc, choices, sizeof choices);
}

static uint8_t *put_state(uint8_t *at, const tf_state_t *state) {
  at = tf_wire_put_real(at, state->r);
  at = tf_wire_put_real(at, state->v);
  at = tf_wire_put_real(at, state->w);
  at = tf_wire_put_real(at, state->phi);
  at = tf_wire_put(at, state->seed, 4);
  *at++ = state->mode;
  return at;
}

static uint32_t length_of(const char *text) {
  uint32_t length = 0;
  while (text[length] != '\0') length++;
  return length;
}

static uint32_t hash_text(uint32_t crc, const char *text) {
  return tf_crc32(crc, (const uint8_t *)text, length_of(text));
}

TF_API uint32_t tf_run_hash(uint32_t before, const tf_schema_t *schema,
                            const tf_state_t *start) {
  uint8_t bytes[4 + 1 + 8 + TF_STATE_BYTES];
  uint8_t *at = tf_wire_put(bytes, tf_params_hash(schema->params), 4);
  *at++ = schema->scheme;
  at = tf_wire_put(at, start->tick, 8);
  at = put_state(at, start);
  const uint32_t crc = tf_crc32(before, bytes, (size_t)(at - bytes));
  return hash_text(hash_text(crc, schema->scene), schema->build);
}

TF_API size_t tf_send_schema(uint8_t *wire, uint32_t *sequence, uint64_t tick,
                             const tf_schema_t *schema) {
  const tf_params_t *params = schema->params;
  const uint8_t *end = wire + TF_FRAME_AT + TF_SCHEMA_BYTES;
  uint8_t *at = wire + TF_FRAME_AT;
  *at++ = (uint8_t)TF_REAL_BYTES;
  *at++ = (uint8_t)params->law;
  *at++ = (uint8_t)params->rule;
  *at++ = schema->scheme;
  *at++ = (uint8_t)(flags_of(params) | (schema->takes_commands ? 2u : 0u) |
                    (schema->wants_tag ? 16u : 0u) | (schema->ends ? 32u : 0u));
  at = tf_wire_put(at, schema->seed, 4);
  at = tf_wire_put(at, tf_params_hash(params), 4);
  at = tf_wire_put(at, schema->session, 4);
  at = tf_wire_put(at, schema->sequence, 4);
  at = tf_wire_put(at, schema->deadman, 4);
  at = tf_wire_put(at, schema->run, 4);
  at = tf_wire_put_real(at, params->dt);
  at = put_text(at, end - 2, schema->scene);
  *at++ = 0;
  at = put_text(at, end - 1, schema->build);
  *at++ = 0;
  return seal(wire, TF_DOWN_SCHEMA, at, sequence, tick);
}

TF_API const char *const tf_layout_state =
    "r,real,1,m;v,real,1,m/s;omega,real,1,rad/s;phi,real,1,rad;seed,u32;"
    "mode,u8";
TF_API const char *const tf_layout_report =
    "h,real,1,m/s;g,real,1,m/s;F,real,1,N;M,real,1,N m;delassus,real,1,1/kg;"
    "residual,real,1,N;mode,u8;set,u8;choices,u8;status,i8;input,u8";
TF_API const char *const tf_layout_heartbeat =
    "steps;refused;overruns;dropped;bad;ignored;min,u32,1e-9,s;"
    "mean,u32,1e-9,s;max,u32,1e-9,s;period,u32,1e-9,s;degraded;fell_back;"
    "coarse;stalled;expired;skipped;lost;superseded;late;unread;run;chain";

TF_API size_t tf_send_layout(uint8_t *wire, uint32_t *sequence, uint64_t tick,
                             tf_type_t type, const char *layout) {
  uint8_t *at = wire + TF_FRAME_AT;
  *at++ = (uint8_t)type;
  at = put_text(at, wire + TF_FRAME_AT + TF_LAYOUT_BYTES, layout);
  return seal(wire, TF_DOWN_LAYOUT, at, sequence, tick);
}

TF_API size_t tf_send_state(uint8_t *wire, uint32_t *sequence,
                            const tf_state_t *state) {
  uint8_t *end = put_state(wire + TF_FRAME_AT, state);
  return seal(wire, TF_DOWN_STATE, end, sequence, state->tick);
}

TF_API size_t tf_send_report(uint8_t *wire, uint32_t *sequence, uint64_t tick,
                             const tf_report_t *report,
                             tf_input_source_t source) {
  uint8_t *at = wire + TF_FRAME_AT;
  at = tf_wire_put_real(at, report->slip.h);
  at = tf_wire_put_real(at, report->slip.g);
  at = tf_wire_put_real(at, report->force.F);
  at = tf_wire_put_real(at, report->force.M);
  at = tf_wire_put_real(at, report->delassus);
  at = tf_wire_put_real(at, report->residual);
  *at++ = report->mode;
  *at++ = report->set;
  *at++ = report->choices;
  *at++ = (uint8_t)report->status;
  *at++ = (uint8_t)source;
  return seal(wire, TF_DOWN_REPORT, at, sequence, tick);
}

// Of members in the order of the payload, without a gap.
typedef char
    heartbeat_is_as_sent[sizeof(tf_heartbeat_t) == TF_HEARTBEAT_BYTES ? 1 : -1];

TF_API size_t tf_send_heartbeat(uint8_t *wire, uint32_t *sequence,
                                uint64_t tick,
                                const tf_heartbeat_t *heartbeat) {
  const uint32_t *counters = (const uint32_t *)(const void *)heartbeat;
  uint8_t *at = wire + TF_FRAME_AT;
  for (size_t i = 0; i < TF_HEARTBEAT_BYTES / 4; i++)
    at = tf_wire_put(at, counters[i], 4);
  return seal(wire, TF_DOWN_HEARTBEAT, at, sequence, tick);
}

TF_API void tf_read_heartbeat(const uint8_t *payload,
                              tf_heartbeat_t *heartbeat) {
  uint32_t *counters = (uint32_t *)(void *)heartbeat;
  for (size_t i = 0; i < TF_HEARTBEAT_BYTES / 4; i++)
    counters[i] = (uint32_t)tf_wire_get(payload + 4 * i, 4);
}

TF_API tf_line_t tf_line_of_frames(uint32_t rate, uint32_t baud,
                                   const char *scene, const char *build,
                                   bool takes_commands, uint32_t tag) {
  // As one type, in which none of these sums comes near the end.
  const uint32_t frame = TF_FRAME_SIZE(0u), heartbeat = TF_HEARTBEAT_BYTES;
  const uint32_t step = TF_STATE_BYTES + TF_REPORT_BYTES;
  const uint32_t names = length_of(scene) + length_of(build) + 2u;
  const uint32_t schema = 29u + TF_REAL_BYTES + names;
  const uint32_t layouts = length_of(tf_layout_state) +
                           length_of(tf_layout_report) +
                           length_of(tf_layout_heartbeat) + 3u;
  const uint32_t most = TF_SCHEMA_BYTES;
  return (tf_line_t){
      .rate = rate,
      .record = 2u * frame + step + (takes_commands ? frame + 8u + tag : 0u),
      .beside = 5u * frame + heartbeat + layouts +
                (schema < most ? schema : most) + 2u * tag,
      .carries = baud / 10u};
}

TF_API uint64_t tf_line_asks(const tf_line_t *line, uint32_t every) {
  const uint64_t records = (uint64_t)line->record * line->rate;
  return line->beside + (records + every - 1u) / every;
}

TF_API void tf_read_state(const uint8_t *payload, uint64_t tick,
                          tf_state_t *state) {
  const uint8_t *behind = payload + 4 * TF_REAL_BYTES;
  *state = (tf_state_t){.r = tf_wire_get_real(payload),
                        .v = tf_wire_get_real(payload + TF_REAL_BYTES),
                        .w = tf_wire_get_real(payload + 2 * TF_REAL_BYTES),
                        .phi = tf_wire_get_real(payload + 3 * TF_REAL_BYTES),
                        .tick = tick,
                        .seed = (uint32_t)tf_wire_get(behind, 4),
                        .mode = behind[4]};
}
