// Bytes to the decoder of frames and to the uplink. The input comes in twice:
// as it is, and as a list of things to do: noise, whole frames, frames with a
// byte changed, ticks. A decoder of its own, slow and plain, says what is a
// frame; nothing else may be taken for one, and nothing may act without one.
#include "cli/monitor/receiver.h"
#include "verify/fuzz/fuzz.h"

#define HALF_ROOM TF_DECODER_SIZE(TF_COMMAND_BYTES)
#define FULL_ROOM TF_DECODER_SIZE(TF_FRAME_PAYLOAD)
#define MAX_ITEMS 64

static uint32_t plain_crc(const uint8_t *bytes, size_t length) {
  uint32_t crc = 0xffffffffu;
  for (size_t i = 0; i < length; i++) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; bit++)
      crc = crc & 1u ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
  }
  return ~crc;
}

// What stands between two zeros, as docs/PROTOCOL.md has it. out: FULL_ROOM
// bytes, header and payload. Returns: their number, 0 where it is not a frame.
static size_t plain_frame(const uint8_t *code, size_t used, uint8_t *out) {
  if (used < 1 + TF_FRAME_HEADER + 5) return 0;
  const size_t stuffed = used - 5;
  const uint32_t crc = plain_crc(code, stuffed);
  for (size_t i = 0; i < 5; i++)
    if (code[stuffed + i] != (0x80u | (crc >> 7 * i & 0x7fu))) return 0;
  size_t length = 0, at = 0;
  while (at < stuffed) {
    const size_t next = at + code[at];
    if (next > stuffed) return 0;
    for (at++; at < next; at++) out[length++] = code[at];
    if (next < stuffed) out[length++] = 0;
  }
  const bool whole = length >= TF_FRAME_HEADER && out[0] == TF_FRAME_VERSION &&
                     out[2] == length - TF_FRAME_HEADER;
  return whole ? length : 0;
}

// A line, and the plain decoder at its end.
typedef struct {
  uint8_t bytes[FULL_ROOM], frame[FULL_ROOM];
  size_t used, room;
  bool long_one;
  uint32_t frames;
} line_t;

// Returns: bytes of the frame that this byte completes, or 0.
static size_t line_push(line_t *line, uint8_t byte) {
  if (byte != 0) {
    if (line->used < line->room)
      line->bytes[line->used++] = byte;
    else
      line->long_one = true;
    return 0;
  }
  const size_t length =
      line->long_one ? 0 : plain_frame(line->bytes, line->used, line->frame);
  line->used = 0;
  line->long_one = false;
  line->frames += length > 0;
  return length;
}

static const char *same_frame(const tf_frame_t *frame, const uint8_t *want,
                              size_t length) {
  FUZZ_HOLD(frame->length == length - TF_FRAME_HEADER);
  FUZZ_HOLD(frame->type == want[1]);
  FUZZ_HOLD(frame->sequence == tf_wire_get(want + 3, 4));
  FUZZ_HOLD(frame->tick == tf_wire_get(want + 7, 8));
  FUZZ_HOLD(memcmp(frame->payload, want + TF_FRAME_HEADER, frame->length) == 0);
  return NULL;
}

// The decoder, byte by byte and in blocks, against the plain one.
static const char *decode(const uint8_t *data, size_t size, uint16_t room) {
  uint8_t one[FULL_ROOM], many[FULL_ROOM];
  tf_decoder_t by_byte, by_block;
  tf_frame_t frame, other;
  line_t line;
  memset(&line, 0, sizeof line);
  line.room = room;
  tf_decoder_init(&by_byte, one, room);
  tf_decoder_init(&by_block, many, room);
  size_t at = 0, taken = 0;
  for (size_t i = 0; i < size; i++) {
    const size_t want = line_push(&line, data[i]);
    FUZZ_HOLD(tf_decoder_push(&by_byte, data[i], &frame) == (want > 0));
    if (want == 0) continue;
    FUZZ_HOLD_ALL(same_frame(&frame, line.frame, want));
    FUZZ_HOLD(
        tf_decoder_block(&by_block, data + at, size - at, &taken, &other));
    at += taken;
    FUZZ_HOLD(at == i + 1);
    FUZZ_HOLD_ALL(same_frame(&other, line.frame, want));
  }
  FUZZ_HOLD(!tf_decoder_block(&by_block, data + at, size - at, &taken, &other));
  FUZZ_HOLD(taken == size - at);
  FUZZ_HOLD(by_byte.frames == line.frames && by_block.frames == line.frames);
  FUZZ_HOLD(by_byte.bad == by_block.bad && by_byte.lost == by_block.lost);
  FUZZ_HOLD(by_byte.too_long == by_block.too_long);
  FUZZ_HOLD(by_byte.bad_version == by_block.bad_version);
  FUZZ_HOLD(by_byte.restarts == by_block.restarts);
  return NULL;
}

typedef struct {
  fuzz_bytes_t in;
  const tf_scene_t *scene;
  tf_link_t link;
  tf_simulation_t simulation;
  line_t line;       // what the uplink hears
  uint32_t up, down; // sequences
  uint8_t key[TF_KEY_BYTES];
  bool wants_tag;
  uint32_t answers;
  cli_receiver_t receiver; // what a host makes of the frames
} board_t;

// All that acts, as bytes.
typedef struct {
  tf_params_t params;
  tf_simulation_t simulation;
} acting_t;

static void look(const board_t *b, acting_t *now) {
  memcpy(&now->params, &b->link.params, sizeof now->params);
  memcpy(&now->simulation, &b->simulation, sizeof now->simulation);
}

static const char *hear(board_t *b, const uint8_t *bytes, size_t length) {
  acting_t before, after;
  cli_csv_t row;
  look(b, &before);
  for (size_t i = 0; i < length; i++) {
    const size_t whole = line_push(&b->line, bytes[i]);
    if (b->wants_tag)
      tf_link_receive_tagged(&b->link, bytes[i], b->key);
    else
      tf_link_receive(&b->link, bytes[i]);
    FUZZ_HOLD(b->link.waiting <= TF_LINK_QUEUE);
    if (whole == 0) continue;
    const tf_frame_t frame = {tf_wire_get(b->line.frame + 7, 8),
                              (uint32_t)tf_wire_get(b->line.frame + 3, 4),
                              b->line.frame[1], b->line.frame[2],
                              b->line.frame + TF_FRAME_HEADER};
    (void)cli_receiver_take(&b->receiver, &frame, &row);
  }
  look(b, &after);
  FUZZ_HOLD(memcmp(&before, &after, sizeof before) == 0);
  FUZZ_HOLD(b->link.decoder.frames == b->line.frames);
  FUZZ_HOLD(b->link.waiting + b->link.has_aside + b->answers +
                b->link.ignored <=
            b->line.frames);
  return NULL;
}

// The frame of the next command stands at wire. Returns: its length.
static size_t make_command(board_t *b, uint8_t *wire) {
  const uint8_t type = fuzz_byte(&b->in);
  const uint8_t form = fuzz_byte(&b->in);
  size_t length = form & 63u;
  uint64_t due = form & 64u ? b->simulation.state.tick + fuzz_byte(&b->in) : 0;
  uint8_t *at = wire + TF_COMMAND_AT;
  if (form & 128u) due <<= 8;
  if (length > TF_COMMAND_DATA) length = TF_COMMAND_DATA;
  if (type == TF_UP_PARAMETER) {
    *at++ = (uint8_t)(length % (TF_PARAMETERS + 1));
    at = tf_wire_put_real(at, fuzz_real(&b->in));
  } else if (type == TF_UP_INPUT && length > 0) {
    for (int i = 0; i < 5; i++) at = tf_wire_put_real(at, fuzz_real(&b->in));
  } else if (type == TF_UP_RESTORE && length > 0) {
    at = tf_wire_put(at, fuzz_byte(&b->in), 8);
    for (int i = 0; i < 4; i++) at = tf_wire_put_real(at, fuzz_real(&b->in));
    at = tf_wire_put(at, fuzz_byte(&b->in), 4);
    *at++ = fuzz_byte(&b->in);
  } else {
    for (; length > 0; length--) *at++ = fuzz_byte(&b->in);
  }
  // Now and then of another simulation, an old number, or without the tag.
  const uint8_t who = (form & 192u) == 128u ? fuzz_byte(&b->in) : 0;
  if ((who & 15u) == 1) b->up = fuzz_byte(&b->in);
  return tf_command_seal(wire, type, (size_t)(at - wire) - TF_COMMAND_AT,
                         b->link.session ^ ((who & 0xf0u) == 0x10u), &b->up,
                         due,
                         b->wants_tag != ((who & 15u) == 2) ? b->key : NULL);
}

static const char *take_answers(board_t *b, unsigned most) {
  uint8_t wire[TF_FRAME_SIZE(TF_FRAME_PAYLOAD)], out[FULL_ROOM];
  for (unsigned i = 0; i < most; i++) {
    const size_t size = tf_link_answer(&b->link, wire, &b->down);
    if (size == 0) return NULL;
    b->answers++;
    FUZZ_HOLD(size <= TF_FRAME_SIZE(TF_ANSWER_BYTES));
    FUZZ_HOLD(wire[0] == 0 && wire[size - 1] == 0);
    FUZZ_HOLD(plain_frame(wire + 1, size - 2, out) >= TF_FRAME_HEADER + 8);
    FUZZ_HOLD(out[1] == TF_DOWN_ANSWER);
  }
  return NULL;
}

// A boundary, and a step where the session runs.
static const char *tick(board_t *b) {
  acting_t before, after;
  tf_machine_t machine;
  look(b, &before);
  const unsigned most = b->link.waiting + b->link.has_aside;
  const unsigned effective = tf_link_boundary(&b->link, &b->simulation);
  look(b, &after);
  FUZZ_HOLD(effective <= most && b->answers + most <= b->line.frames);
  if (effective == 0) FUZZ_HOLD(memcmp(&before, &after, sizeof before) == 0);
  // What is in effect is what tf_prepare takes, and is what it makes of it.
  FUZZ_HOLD(tf_prepare(&machine, &b->link.params, NULL) == TF_OK);
  FUZZ_HOLD(memcmp(&machine, &b->simulation.machine,
                   offsetof(tf_machine_t, segments)) == 0);
  FUZZ_HOLD(machine.contact.rule == b->simulation.machine.contact.rule);
  const tf_input_t input = tf_simulation_input(&b->simulation, b->scene);
  FUZZ_HOLD(fuzz_finite(input.omega0) && fuzz_finite(input.r0));
  FUZZ_HOLD(fuzz_finite(input.force) && fuzz_finite(input.torque));
  FUZZ_HOLD(fuzz_finite(input.alpha));
  if (!b->simulation.running) return NULL;
  const tf_status_t status =
      tf_step(&b->simulation.machine, &b->simulation.state, &input,
              &b->simulation.report);
  FUZZ_HOLD(status >= 0 || memcmp(&after.simulation.state, &b->simulation.state,
                                  sizeof after.simulation.state) == 0);
  FUZZ_HOLD(fuzz_in_reach(&b->simulation.state));
  return NULL;
}

static const char *perform(board_t *b) {
  uint8_t wire[TF_FRAME_SIZE(TF_FRAME_PAYLOAD)];
  const uint8_t what = fuzz_byte(&b->in);
  const unsigned which = what >> 3;
  size_t length = 0;
  switch (what & 7u) {
    case 0: // noise
      for (; length < which; length++) wire[length] = fuzz_byte(&b->in);
      return hear(b, wire, length);
    case 1: // a frame with one byte changed, or cut short
      length = make_command(b, wire);
      wire[(fuzz_byte(&b->in) * 256u + which) % length] ^= fuzz_byte(&b->in);
      return hear(b, wire, which == 31 ? length / 2 : length);
    case 2:
      return take_answers(b, which);
    case 3:
    case 4:
      for (unsigned i = 0; i <= which % 8; i++) FUZZ_HOLD_ALL(tick(b));
      return NULL;
    default: // a whole frame
      length = make_command(b, wire);
      return hear(b, wire, length);
  }
}

static const char *uplink(const uint8_t *data, size_t size) {
  static board_t board; // large; a run starts from nothing all the same
  board_t *b = &board;
  memset(b, 0, sizeof *b);
  b->in = (fuzz_bytes_t){data, data + size};
  b->line.room = HALF_ROOM;
  const uint8_t first = fuzz_byte(&b->in);
  b->scene = tf_scenes[first % TF_SCENES];
  FUZZ_HOLD(tf_simulation_open(&b->simulation, b->scene, &b->scene->params,
                               1) == TF_OK);
  tf_link_open(&b->link, b->scene, &b->scene->params);
  const unsigned kind = first / TF_SCENES;
  b->wants_tag = kind & 1u;
  if ((kind & 2u) == 0) b->link.session = 1; // somebody has asked already
  if (kind & 4u) b->link.next = b->up = UINT32_MAX - 8u;
  for (int i = 0; i < MAX_ITEMS && b->in.at < b->in.end; i++)
    FUZZ_HOLD_ALL(perform(b));
  return NULL;
}

const char *fuzz_frame(const uint8_t *data, size_t size) {
  FUZZ_HOLD_ALL(decode(data, size, HALF_ROOM));
  FUZZ_HOLD_ALL(decode(data, size, FULL_ROOM));
  return uplink(data, size);
}
