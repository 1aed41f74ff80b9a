/* Hostile frames against the running firmware of the host port, over a
 * pseudo-terminal: noise, frames with one wrong bit, whole frames of every type
 * and length with any payload and any tick, commands with raw bits for numbers,
 * frames that were sent before. Whatever comes, the firmware goes on, all that
 * it sends is whole and finite, and it still answers.
 *
 * HOSTILE_FRAMES (default 20000) of them are sent, in HOSTILE_SECONDS (default
 * 60) at most. */
#include "firmware_line.h"

#define KEPT 64  /* frames that may be sent again */
#define ROOM 512 /* for the bytes of one */

static firmware_t it;
static uint64_t sent;
static struct {
  size_t size;
  uint8_t bytes[ROOM];
} kept[KEPT];

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double setting(const char *name, double otherwise) {
  const char *text = getenv(name);
  return text && *text ? strtod(text, NULL) : otherwise;
}

/* All bytes, however long the line takes them; it is listened to meanwhile. */
static int put(firmware_t *f, const uint8_t *bytes, size_t size, double until) {
  while (size > 0 && seconds() < until) {
    const ssize_t taken = write(f->line, bytes, size);
    if (taken > 0) {
      bytes += taken;
      size -= (size_t)taken;
    } else if (errno != EAGAIN) {
      return 0;
    } else {
      listen_for(f, 10, POLLOUT);
    }
  }
  return size == 0;
}

static uint64_t any_tick(void) {
  switch (tap_bits() % 4) {
    case 0:
      return 0;
    case 1:
      return tap_bits();
    case 2:
      return UINT64_MAX - tap_bits() % 4;
    default:
      return tap_bits() % 100000;
  }
}

/* A whole frame. A command has the length that it should have, and most name
 * the session of the board and a number that it still takes. */
static size_t whole(firmware_t *f, int command, uint8_t wire[ROOM]) {
  static const uint8_t lengths[] = {5 * TF_REAL_BYTES,
                                    1 + TF_REAL_BYTES,
                                    5,
                                    0,
                                    0,
                                    0,
                                    0,
                                    TF_COMMAND_DATA,
                                    0,
                                    0,
                                    4};
  const unsigned one = (unsigned)(tap_bits() % sizeof lengths);
  const uint8_t type =
      command ? (uint8_t)(TF_UP_INPUT + one) : (uint8_t)tap_bits();
  const size_t length =
      command && tap_bits() % 8 ? lengths[one] : tap_bits() % TF_COMMAND_DATA;
  for (size_t i = 0; i < length; i++)
    wire[TF_COMMAND_AT + i] = (uint8_t)(tap_bits() % 3 ? tap_bits() : 0);
  const uint32_t session = tap_bits() % 8 ? f->session : (uint32_t)tap_bits();
  uint32_t old = (uint32_t)(tap_bits() % (f->number + (uint64_t)1));
  return tf_command_seal(wire, type, length, session,
                         tap_bits() % 8 ? &f->number : &old, any_tick(), NULL);
}

static size_t hostile(firmware_t *f, uint8_t wire[ROOM]) {
  const uint64_t kind = tap_bits() % 8;
  size_t size = 1 + tap_bits() % (kind == 0 ? 400 : 40);
  if (kind < 2) { /* noise, of which some is longer than any frame */
    for (size_t i = 0; i < size; i++) wire[i] = (uint8_t)tap_bits();
    return size;
  }
  if (kind == 2 && sent >= KEPT) {
    const size_t old = tap_bits() % KEPT;
    memcpy(wire, kept[old].bytes, kept[old].size);
    return kept[old].size;
  }
  size = whole(f, kind > 4, wire);
  if (kind == 3) wire[1 + tap_bits() % (size - 2)] ^= (uint8_t)tap_bits();
  kept[sent % KEPT].size = size;
  memcpy(kept[sent % KEPT].bytes, wire, size);
  return size;
}

TEST(hostile_frames_cost_no_firmware) {
  const double frames = setting("HOSTILE_FRAMES", 20000);
  uint8_t wire[ROOM];
  run_on_terminal(&it);
  it.commanded = true;
  CHECK(answers(&it, TF_UP_DESCRIBE));
  const double begin = seconds();
  const double until = begin + setting("HOSTILE_SECONDS", 60);
  for (; (double)sent < frames && seconds() < until; sent++) {
    const size_t size = hostile(&it, wire);
    if (!put(&it, wire, size, until)) break; /* it has ended */
    if (sent % 16 == 0) listen_for(&it, 0, 0);
  }
  printf("# %" PRIu64 " hostile frames in %.1f s; %" PRIu64
         " frames came back, %" PRIu64 " answers, %" PRIu64 " states\n",
         sent, seconds() - begin, it.frames, it.answers, it.states);
  CHECK((double)sent >= frames);
  CHECK(answers(&it, TF_UP_DESCRIBE));
  CHECK(it.wild == 0);
  CHECK(it.decoder.bad == 0 && it.decoder.too_long == 0);
  CHECK(it.states > 0);
  CHECK(end(&it, SIGTERM) == 0);
}
