/* Frames on a line: what arrives, one wrong bit, and what the decoder counts.
 * Noise, and damage of any kind, are those of the fuzz target frame. */
#include "frame_in.h"
#include "link/parts.h"
#include "tap.h"
#include "twofold.h"

#define LONGEST TF_FRAME_SIZE(TF_FRAME_PAYLOAD)

/* A frame whose payload depends on its index alone; zeros are common in it. */
static uint8_t payload_byte(uint64_t index, unsigned i) {
  const uint64_t z = (index * 251 + i + 1) * 0x9E3779B97F4A7C15u >> 32;
  return z % 4 == 0 ? 0 : (uint8_t)(z >> 8);
}
static size_t make(uint8_t *wire, uint64_t index, unsigned length) {
  uint32_t sequence = (uint32_t)index;
  for (unsigned i = 0; i < length; i++)
    wire[TF_FRAME_AT + i] = payload_byte(index, i);
  return tf_frame_seal(wire, (uint8_t)(1 + index % 8), length, &sequence,
                       index);
}
static int is_as_made(const tf_frame_t *frame, unsigned length) {
  int same = frame->length == length && frame->type == 1 + frame->tick % 8 &&
             frame->sequence == (uint32_t)frame->tick;
  for (unsigned i = 0; same && i < length; i++)
    same = frame->payload[i] == payload_byte(frame->tick, i);
  return same;
}

typedef struct {
  tf_decoder_t decoder;
  uint8_t buffer[TF_DECODER_SIZE(TF_FRAME_PAYLOAD)];
} receiver_t;

static void open_receiver(receiver_t *receiver) {
  tf_decoder_init(&receiver->decoder, receiver->buffer,
                  sizeof receiver->buffer);
}

/* How many frames come out of some bytes. */
static unsigned accepted(receiver_t *receiver, const uint8_t *bytes,
                         size_t length) {
  unsigned count = 0;
  tf_frame_t frame;
  for (size_t taken; length > 0; bytes += taken, length -= taken)
    count +=
        tf_decoder_block(&receiver->decoder, bytes, length, &taken, &frame);
  return count;
}

TEST(frames_survive_the_line) {
  receiver_t receiver;
  open_receiver(&receiver);
  uint8_t wire[LONGEST + 1];
  for (unsigned n = 0; n < 3 * (TF_FRAME_PAYLOAD + 1); n++) {
    const unsigned length = n % (TF_FRAME_PAYLOAD + 1);
    wire[TF_FRAME_SIZE(length)] = 0xA5;
    const size_t size = make(wire, n, length);
    CHECK(size == TF_FRAME_SIZE(length) && wire[size] == 0xA5);
    CHECK(wire[0] == 0 && wire[size - 1] == 0);
    CHECK(memchr(wire + 1, 0, size - 2) == NULL);
    tf_frame_t frame = {0, 0, 0, 0, NULL};
    for (size_t i = 0; i < size; i++) {
      const bool complete = tf_decoder_push(&receiver.decoder, wire[i], &frame);
      CHECK(complete == (i == size - 1));
    }
    CHECK(frame.tick == n && is_as_made(&frame, length));
    /* The same chain from the line and from the decoder, and of each CRC. */
    const uint8_t *crc = wire + size - 1 - TF_FRAME_CRC;
    const uint32_t chain = tf_frame_chain(n, crc);
    CHECK(chain == tf_frame_chain(n, frame.payload + frame.length));
    CHECK(chain == tf_crc32(n, crc, 5) && chain != tf_frame_chain(n + 1, crc));
  }
  CHECK(receiver.decoder.frames == 3 * (TF_FRAME_PAYLOAD + 1));
  CHECK(receiver.decoder.bad + receiver.decoder.lost == 0);
  uint32_t sequence = 7;
  CHECK(tf_frame_seal(wire, 1, TF_FRAME_PAYLOAD + 1, &sequence, 0) == 0);
  CHECK(sequence == 7);
}

/* One frame, one bit wrong, between two whole ones. */
TEST(every_single_bit_error_is_caught) {
  static const unsigned lengths[] = {0, 1, 5, 14, 37, 52, 237, 238};
  for (unsigned n = 0; n < 8; n++) {
    const unsigned length = lengths[n];
    uint8_t wire[3 * LONGEST];
    const size_t size = make(wire, 100 + n, length);
    make(wire + size, 101 + n, length);
    make(wire + 2 * size, 102 + n, length);
    for (size_t bit = 8 * size; bit < 16 * size; bit++) {
      receiver_t receiver;
      open_receiver(&receiver);
      const uint8_t mask = (uint8_t)(1u << bit % 8);
      wire[bit / 8] ^= mask;
      /* The neighbours are there, the one in the middle is counted as lost. */
      CHECK(accepted(&receiver, wire, 3 * size) == 2);
      CHECK(receiver.decoder.lost == 1);
      CHECK(receiver.decoder.tick == 102 + n);
      CHECK(receiver.decoder.bad + receiver.decoder.too_long >= 1);
      wire[bit / 8] ^= mask;
    }
  }
}

/* Frames of some number and time in turn, and how many are lost then; whether
 * the sender seems to have started again. */
TEST(lost_frames_are_counted) {
  static const struct {
    struct {
      uint32_t number;
      uint64_t tick;
    } sent[4]; /* all zero behind the first: no more */
    uint32_t lost, restarts;
  } cases[] = {
      {{{5, 5}, {6, 6}, {9, 9}}, 2, 0},
      /* Around the end of the sequence number. */
      {{{0xfffffffeu, 0xfffffffeu}, {1, 0x100000001u}}, 2, 0},
      /* The sender starts again: time and number go back, nothing is lost. */
      {{{0xfffffffeu, 0xfffffffeu}, {1, 0x100000001u}, {0, 1}}, 2, 1},
      /* In the upper half of the numbers the gap alone does not decide. */
      {{{0xc0000000u, 0xc0000000u}, {0, 1}}, 0, 1},
      /* Half of all gaps: from 0 a loss of 2^31 - 1 at most. */
      {{{0, 1}, {0x80000000u, 0x80000000u}}, 0x7fffffffu, 0},
      {{{0, 1}, {0x80000001u, 0x80000001u}}, 0, 1},
      /* An answer that is older than the row before it, after a loss. */
      {{{500, 500}, {503, 400}}, 2, 0},
      /* Where 0 was the next number it was not gone through. */
      {{{UINT32_MAX, 500}, {3, 400}}, 3, 0},
      /* A loss of 2^16 frames, which a number of 16 bits would not show. */
      {{{7, 7}, {7 + 65537, 7 + 65537}}, 65536, 0},
      /* The same frame twice. */
      {{{0, 1}, {0, 1}}, 0, 1}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    receiver_t receiver;
    uint8_t wire[LONGEST] = {0};
    open_receiver(&receiver);
    for (int n = 0; n == 0 || (n < 4 && cases[i].sent[n].tick); n++) {
      uint32_t number = cases[i].sent[n].number;
      const size_t size =
          tf_frame_seal(wire, 8, 5, &number, cases[i].sent[n].tick);
      CHECK(accepted(&receiver, wire, size) == 1);
    }
    CHECK(receiver.decoder.lost == cases[i].lost);
    if (!CHECK(receiver.decoder.restarts == cases[i].restarts))
      printf("# case %zu\n", i);
  }
}

TEST(long_runs_stay_in_the_buffer) {
  uint8_t buffer[TF_DECODER_SIZE(8) + 8];
  memset(buffer, 0xA5, sizeof buffer);
  tf_decoder_t decoder;
  tf_decoder_init(&decoder, buffer, TF_DECODER_SIZE(8));
  tf_frame_t frame;
  for (int i = 0; i < 100000; i++) CHECK(!tf_decoder_push(&decoder, 1, &frame));
  CHECK(!tf_decoder_push(&decoder, 0, &frame));
  CHECK(decoder.too_long == 1 && decoder.bad == 0);
  uint8_t wire[LONGEST];
  size_t taken;
  size_t size = make(wire, 3, 9);
  CHECK(!tf_decoder_block(&decoder, wire, size, &taken, &frame));
  CHECK(taken == size && decoder.too_long == 2);
  size = make(wire, 4, 8); /* the longest that fits */
  CHECK(!tf_decoder_block(&decoder, wire, size - 1, &taken, &frame));
  CHECK(taken == size - 1); /* and its end in a block of its own */
  CHECK(tf_decoder_block(&decoder, wire + taken, 1, &taken, &frame));
  CHECK(taken == 1 && is_as_made(&frame, 8));
  for (size_t i = TF_DECODER_SIZE(8); i < sizeof buffer; i++)
    CHECK(buffer[i] == 0xA5);
}

/* Frames of nine bytes with one other byte, under the CRC that they then have,
 * each after those before it. */
TEST(other_versions_and_lengths_are_counted) {
  static const struct {
    unsigned at;
    uint8_t byte;
    uint32_t frames, bad, bad_version;         /* that were counted by then */
  } cases[] = {{2, TF_FRAME_VERSION, 1, 0, 0}, /* as it was */
               {2, TF_FRAME_VERSION - 1, 1, 0, 1},
               {4, 8, 1, 1, 1},     /* another length */
               {1, 0xff, 1, 2, 1}}; /* a chain of COBS that leaves the frame */
  receiver_t receiver;
  open_receiver(&receiver);
  const tf_decoder_t *decoder = &receiver.decoder;
  uint8_t wire[LONGEST];
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    const size_t size = make(wire, 3, 9);
    wire[cases[i].at] = cases[i].byte;
    reseal(wire, size);
    CHECK(accepted(&receiver, wire, size) == (i == 0));
    CHECK(decoder->frames == cases[i].frames && decoder->bad == cases[i].bad);
    CHECK(decoder->bad_version == cases[i].bad_version);
  }
  /* No more than the checksum of nothing. */
  static const uint8_t nothing[] = {0, 0x80, 0x80, 0x80, 0x80, 0x80, 0};
  CHECK(accepted(&receiver, nothing, sizeof nothing) == 0);
  CHECK(decoder->bad == 3 && decoder->bad_version == 1);
  CHECK(decoder->version == TF_FRAME_VERSION - 1);
}

/* Bytes that are too few for a header are bad, and no other version, however
 * well their CRC fits. */
TEST(frames_without_a_header_are_bad) {
  for (uint8_t length = 1; length <= TF_FRAME_HEADER; length++) {
    uint8_t wire[32] = {0, length};
    memset(wire + 2, TF_FRAME_VERSION + 1, length);
    reseal(wire, length + 8u);
    wire[length + 7] = 0;
    receiver_t receiver;
    open_receiver(&receiver);
    CHECK(accepted(&receiver, wire, length + 8u) == 0);
    CHECK(receiver.decoder.bad == 1 && receiver.decoder.bad_version == 0);
  }
}
