// Functions of bytes, frames, commands and text.
#include <string.h>

#include "verify/cost/calls.h"
#include "verify/cost/count.h"
#include "verify/cost/inline.h"

#define GENE(n) (s->genes->gene[OWN_GENES + (n)])
#define WIRE TF_FRAME_SIZE(TF_FRAME_PAYLOAD)

// Bytes of one kind: 0, which COBS must replace, others, or a mixture.
static void fill(uint8_t *at, size_t length, uint32_t gene) {
  for (size_t i = 0; i < length; i++) switch (gene & 3u) {
      case 0:
        at[i] = 0;
        break;
      case 1:
        at[i] = 0xff;
        break;
      default:
        gene = gene * 1664525u + 1013904223u;
        at[i] = gene >> 28 & 1u ? 0 : (uint8_t)(gene >> 16);
        gene |= 2u;
    }
}

#define CALL(function) static uint32_t count_##function(const subject_t *s)

CALL(wire_put) {
  uint8_t at[8];
  return COUNT(cost_wire_put(at, GENE(0), s->units));
}
CALL(wire_get) {
  uint8_t at[8] = {0};
  return COUNT(cost_wire_get(at, s->units));
}
CALL(wire_put_real) {
  uint8_t at[8];
  const tf_real_t value = real_of(GENE(0));
  return COUNT(cost_wire_put_real(at, value));
}
CALL(wire_get_real) {
  uint8_t at[8];
  fill(at, sizeof at, GENE(0));
  return COUNT(cost_wire_get_real(at));
}
CALL(frame_seal) {
  uint8_t wire[WIRE];
  uint32_t sequence = GENE(1);
  const uint64_t tick = GENE(2) & 1u ? 0 : UINT64_MAX;
  fill(wire + TF_FRAME_AT, s->units, GENE(0));
  return COUNT(
      tf_frame_seal(wire, (uint8_t)GENE(3), s->units, &sequence, tick));
}
CALL(decoder_init) {
  tf_decoder_t decoder;
  (void)s;
  uint8_t buffer[TF_DECODER_SIZE(TF_FRAME_PAYLOAD)];
  return COUNT(tf_decoder_init(&decoder, buffer, sizeof buffer));
}

// A frame with a payload of some length, and a decoder that knows a sequence.
typedef struct {
  uint8_t wire[WIRE], buffer[TF_DECODER_SIZE(TF_FRAME_PAYLOAD)];
  size_t size;
  tf_decoder_t decoder;
} line_t;

static void line_of(const subject_t *s, unsigned payload, line_t *line) {
  memset(line, 0, sizeof *line);
  uint32_t sequence = GENE(1);
  const uint64_t tick = GENE(2) & 1u ? 0 : UINT64_MAX;
  fill(line->wire + TF_FRAME_AT, payload, GENE(0));
  line->size =
      tf_frame_seal(line->wire, (uint8_t)GENE(3), payload, &sequence, tick);
  if (GENE(4) & 16u) line->wire[GENE(5) % line->size] ^= 1u;
  const uint16_t room = (uint16_t)(GENE(4) & 32u ? 8 : sizeof line->buffer);
  tf_decoder_init(&line->decoder, line->buffer, room);
  line->decoder.started = (GENE(4) & 64u) != 0;
  line->decoder.sequence = GENE(6) >> 4;
  line->decoder.tick = GENE(7);
}

// Whichever of its bytes costs most.
CALL(decoder_push) {
  uint32_t worst = 0;
  line_t line;
  tf_frame_t frame;
  line_of(s, s->units, &line);
  for (size_t i = 0; i < line.size; i++) {
    const uint32_t n =
        COUNT(tf_decoder_push(&line.decoder, line.wire[i], &frame));
    if (n > worst) worst = n;
  }
  return worst;
}
CALL(decoder_block) {
  line_t line;
  tf_frame_t frame;
  size_t taken;
  // The bytes of a whole frame are what is left of the units.
  const unsigned around = TF_FRAME_SIZE(0);
  line_of(s, s->units > around ? s->units - around : 0, &line);
  if (s->units < line.size) line.size = s->units;
  // Or bytes between zeros that are not frames.
  if (GENE(8) & 1u) {
    line.size = s->units;
    fill(line.wire, line.size, GENE(9));
    for (size_t i = GENE(8) >> 4; GENE(8) & 2u && i < line.size; i += 2)
      line.wire[i] = 1;
  }
  return COUNT(
      tf_decoder_block(&line.decoder, line.wire, line.size, &taken, &frame));
}

// A link with a queue of commands of one kind that all take effect.
typedef struct {
  tf_scene_t scene;
  tf_simulation_t simulation;
  tf_link_t link;
  uint8_t key[TF_KEY_BYTES];
  bool wants_tag;
} uplink_t;

static size_t command_of(const subject_t *s, unsigned kind, uint8_t *payload,
                         uint8_t *type) {
  static const uint8_t plain[] = {
      TF_UP_RESET,    TF_UP_START, TF_UP_STOP,  TF_UP_SNAPSHOT, TF_UP_RESTORE,
      TF_UP_DESCRIBE, TF_UP_CLEAR, TF_UP_INPUT, TF_UP_DEADMAN,  0x7f};
  uint8_t *at = payload;
  switch (kind % 6) {
    case 0: {
      const unsigned index = (GENE(8) >> 4) % TF_PARAMETERS;
      tf_real_t value;
      memcpy(&value,
             (const char *)&s->params + tf_parameter_ranges[index].offset,
             sizeof value);
      *type = TF_UP_PARAMETER;
      *at++ = (uint8_t)index;
      at = tf_wire_put_real(at, value);
      break;
    }
    case 1:
      *type = TF_UP_RULE;
      *at++ = (uint8_t)(GENE(8) % TF_RULES);
      at = tf_wire_put(at, GENE(9), 4);
      break;
    case 2:
      *type = TF_UP_RESTORE;
      at = tf_wire_put(at, GENE(9), 8);
      at = tf_wire_put_real(at, s->state.r);
      at = tf_wire_put_real(at, s->state.v);
      at = tf_wire_put_real(at, s->state.w);
      at = tf_wire_put_real(at, s->state.phi);
      at = tf_wire_put(at, s->state.seed, 4);
      *at++ = s->state.mode;
      break;
    case 3:
      *type = TF_UP_INPUT;
      at = tf_wire_put_real(at, s->input.omega0);
      at = tf_wire_put_real(at, s->input.r0);
      at = tf_wire_put_real(at, s->input.force);
      at = tf_wire_put_real(at, s->input.torque);
      at = tf_wire_put_real(at, s->input.alpha);
      break;
    case 4: // too long for its kind
      *type = (uint8_t)(TF_UP_INPUT + GENE(8) % 12);
      fill(payload, TF_COMMAND_DATA, GENE(9));
      at += TF_COMMAND_DATA;
      break;
    default:
      *type = plain[GENE(8) % sizeof plain];
  }
  return (size_t)(at - payload);
}

static void start_uplink(const subject_t *s, uplink_t *u) {
  u->scene = *tf_scenes[0];
  u->scene.params = s->params;
  u->scene.r = s->state.r;
  u->scene.omega = s->state.w;
  u->scene.h = sized_of(GENE(10), -40, 4);
  memset(&u->simulation, 0, sizeof u->simulation);
  fill(u->key, sizeof u->key, GENE(10));
  u->simulation.machine = s->machine.machine;
  u->simulation.state = s->state;
  u->simulation.state.tick = GENE(11);
  tf_link_open(&u->link, &u->scene, &s->params);
  u->link.session = 1;
  u->wants_tag = (GENE(12) & 2u) != 0;
  u->link.has_saved = (GENE(12) & 1u) != 0;
  u->link.saved = s->state;
}

// Sends n commands. Returns: what the most expensive byte of the last one took.
static uint32_t send_commands(const subject_t *s, uplink_t *u, unsigned n) {
  uint32_t worst = 0;
  for (unsigned i = 0; i < n; i++) {
    uint8_t wire[WIRE], type;
    uint32_t number = i + (GENE(13) & 1u ? i << 8 : 0);
    const unsigned kind =
        GENE(14) & 1u ? GENE(14) >> 1 : GENE(14) >> (1 + 3 * i);
    const size_t length = command_of(s, kind, wire + TF_COMMAND_AT, &type);
    const size_t size = tf_command_seal(
        wire, type, length, GENE(13) & 2u ? 2u : 1u, &number, GENE(15) & 1u,
        !u->wants_tag || GENE(13) & 4u ? NULL : u->key);
    for (size_t j = 0; j < size; j++) {
      const uint32_t cost =
          u->wants_tag
              ? COUNT(tf_link_receive_tagged(&u->link, wire[j], u->key))
              : COUNT(tf_link_receive(&u->link, wire[j]));
      if (i + 1 == n && cost > worst) worst = cost;
    }
  }
  return worst;
}

CALL(link_open) {
  tf_link_t link;
  return COUNT(tf_link_open(&link, tf_scenes[0], &s->params));
}
CALL(link_add_entropy) {
  tf_link_t link;
  memset(&link, 0, sizeof link);
  link.noise = GENE(0);
  return COUNT(tf_link_add_entropy(&link, GENE(1)));
}
CALL(command_seal) {
  uint8_t wire[WIRE], key[TF_KEY_BYTES];
  uint32_t number = GENE(1);
  fill(wire + TF_COMMAND_AT, s->units, GENE(0));
  fill(key, sizeof key, GENE(3));
  return COUNT(tf_command_seal(wire, TF_UP_INPUT, s->units, GENE(4), &number,
                               GENE(2) & 1u ? 0 : UINT64_MAX,
                               GENE(6) & 1u ? NULL : key));
}
CALL(link_receive) {
  uplink_t u;
  start_uplink(s, &u);
  u.wants_tag = false;
  return send_commands(s, &u, 1 + GENE(16) % (TF_LINK_QUEUE + 1));
}
CALL(link_receive_tagged) {
  uplink_t u;
  start_uplink(s, &u);
  u.wants_tag = true;
  return send_commands(s, &u, 1 + GENE(16) % (TF_LINK_QUEUE + 1));
}
CALL(link_boundary) {
  uplink_t u;
  start_uplink(s, &u);
  (void)send_commands(s, &u, TF_LINK_QUEUE);
  return COUNT(tf_link_boundary(&u.link, &u.simulation));
}
CALL(link_answer) {
  uplink_t u;
  uint8_t wire[WIRE];
  uint32_t sequence = GENE(17);
  start_uplink(s, &u);
  (void)send_commands(s, &u, TF_LINK_QUEUE);
  (void)tf_link_boundary(&u.link, &u.simulation);
  return COUNT(tf_link_answer(&u.link, wire, &sequence));
}

CALL(params_hash) { return COUNT(tf_params_hash(&s->params)); }

static tf_report_t report_of(const subject_t *s) {
  return (tf_report_t){.force = {real_of(GENE(0)), real_of(GENE(1))},
                       .slip = {real_of(GENE(2)), real_of(GENE(3))},
                       .delassus = real_of(GENE(4)),
                       .residual = real_of(GENE(5)),
                       .mode = (uint8_t)(GENE(6) % TF_MODES),
                       .set = (uint8_t)(GENE(6) >> 8),
                       .choices = (uint8_t)(GENE(6) >> 16)};
}

// Frames that go down.
CALL(send_schema) {
  char text[TF_FRAME_PAYLOAD + 1];
  uint8_t wire[WIRE];
  uint32_t sequence = GENE(1);
  memset(text, '.', sizeof text - 1);
  text[sizeof text - 1] = '\0';
  const tf_schema_t schema = {.params = &s->params,
                              .scene = GENE(2) & 1u ? text : "",
                              .build = GENE(3) & 1u ? text : "",
                              .scheme = 1,
                              .takes_commands = true};
  return COUNT(tf_send_schema(wire, &sequence, GENE(4), &schema));
}
CALL(send_layout) {
  char text[TF_FRAME_PAYLOAD + 1];
  uint8_t wire[WIRE];
  uint32_t sequence = GENE(1);
  memset(text, '.', sizeof text - 1);
  text[sizeof text - 1] = '\0';
  return COUNT(tf_send_layout(wire, &sequence, GENE(4), TF_DOWN_STATE, text));
}
CALL(send_state) {
  uint8_t wire[WIRE];
  uint32_t sequence = GENE(8);
  tf_state_t state = s->state;
  state.tick = GENE(9);
  if (GENE(10) & 1u) memset(&state, 0, sizeof state);
  return COUNT(tf_send_state(wire, &sequence, &state));
}
CALL(send_report) {
  uint8_t wire[WIRE];
  uint32_t sequence = GENE(8);
  const tf_report_t report = report_of(s);
  return COUNT(tf_send_report(wire, &sequence, GENE(9), &report, TF_INPUT_SET));
}
CALL(send_compact) {
  uint8_t wire[WIRE];
  uint32_t sequence = GENE(8);
  const tf_report_t report = report_of(s);
  tf_state_t state = s->state;
  state.tick = GENE(9);
  if (GENE(10) & 1u) memset(&state, 0, sizeof state);
  return COUNT(tf_send_compact(wire, &sequence, &state, &report));
}
CALL(send_heartbeat) {
  uint8_t wire[WIRE];
  uint32_t sequence = GENE(8);
  tf_heartbeat_t beat;
  fill((uint8_t *)&beat, sizeof beat, GENE(10));
  return COUNT(tf_send_heartbeat(wire, &sequence, GENE(9), &beat));
}
CALL(send_parameter) {
  uint8_t wire[WIRE];
  uint32_t sequence = GENE(8);
  return COUNT(tf_send_parameter(wire, &sequence, GENE(9), &s->params,
                                 GENE(10) % (TF_PARAMETERS + 1)));
}
CALL(read_state) {
  uint8_t payload[TF_STATE_BYTES];
  tf_state_t state;
  fill(payload, sizeof payload, GENE(0));
  return COUNT(tf_read_state(payload, GENE(1), &state));
}
CALL(read_heartbeat) {
  uint8_t payload[TF_HEARTBEAT_BYTES];
  tf_heartbeat_t beat;
  fill(payload, sizeof payload, GENE(0));
  return COUNT(tf_read_heartbeat(payload, &beat));
}
CALL(read_report) {
  uint8_t payload[TF_REPORT_BYTES];
  tf_report_t report;
  fill(payload, sizeof payload, GENE(0));
  return COUNT(tf_read_report(payload, &report));
}

// Numbers as text: long ones, and those that take many powers of ten.
CALL(text_row) {
  char out[TF_TEXT_ROW_ROOM];
  tf_report_t report = report_of(s);
  const tf_state_t state = {
      .r = real_of(GENE(7)), .v = real_of(GENE(8)), .w = real_of(GENE(9))};
  return COUNT(tf_text_row(out, &state, &report));
}

#define ENTRY(function) \
  { #function, count_##function, NULL, 0, 1 }
#define BYTES(function, most) \
  { #function, count_##function, "byte", most, 1 }
const call_t line_calls[] = {
    BYTES(wire_put, 8),
    BYTES(wire_get, 8),
    ENTRY(wire_put_real),
    ENTRY(wire_get_real),
    BYTES(frame_seal, TF_FRAME_PAYLOAD),
    ENTRY(decoder_init),
    BYTES(decoder_push, TF_FRAME_PAYLOAD),
    BYTES(decoder_block, TF_FRAME_SIZE(TF_FRAME_PAYLOAD)),
    ENTRY(link_open),
    ENTRY(link_receive_tagged),
    ENTRY(link_add_entropy),
    BYTES(command_seal, TF_COMMAND_MOST),
    ENTRY(link_receive),
    ENTRY(link_boundary),
    ENTRY(link_answer),
    ENTRY(params_hash),
    ENTRY(send_schema),
    ENTRY(send_layout),
    ENTRY(send_state),
    ENTRY(send_report),
    ENTRY(send_compact),
    ENTRY(send_heartbeat),
    ENTRY(send_parameter),
    ENTRY(read_state),
    ENTRY(read_heartbeat),
    ENTRY(read_report),
    ENTRY(text_row),
};
const unsigned line_call_count = sizeof line_calls / sizeof line_calls[0];
