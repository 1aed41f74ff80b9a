/* Hostile frames against the running firmware of the host port, over a
 * pseudo-terminal: noise, frames with one wrong bit, whole frames of every type
 * and length with any payload and any tick, commands with raw bits for numbers,
 * frames that were sent before. Whatever comes, the firmware goes on, all that
 * it sends is whole and finite, and it still answers.
 *
 * HOSTILE_FRAMES (default 20000) of them are sent, in HOSTILE_SECONDS (default
 * 60) at most. FIRMWARE in the environment is where `make test` put the
 * program. */
#ifndef _XOPEN_SOURCE
#define _XOPEN_SOURCE 700
#endif

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define TAP_OWN_MAIN
#include "tap.h"
#include "twofold.h"

#define PATIENCE 20.0 /* [s], for what has to happen */
#define KEPT 64       /* frames that may be sent again */
#define ROOM 512      /* for the bytes of one */

typedef struct {
  pid_t child;
  int line, said;
  uint32_t sequence, session; /* of the next command; as the schema has it */
  tf_decoder_t decoder;
  uint8_t buffer[TF_DECODER_SIZE(TF_FRAME_PAYLOAD)];
  uint64_t sent, frames, answers, beats, states, wild;
  struct {
    size_t size;
    uint8_t bytes[ROOM];
  } kept[KEPT];
} target_t;

static target_t it;

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double setting(const char *name, double otherwise) {
  const char *text = getenv(name);
  return text && *text ? strtod(text, NULL) : otherwise;
}

/* Starts the firmware on a pseudo-terminal of its own making. */
static void start(target_t *t) {
  const char *firmware = getenv("FIRMWARE");
  char program[512], name[128] = "";
  int said[2] = {-1, -1};
  snprintf(program, sizeof program, "%s-%s/firmware-line.elf",
           firmware ? firmware : "build/boards/host/chaos",
           TF_REAL_BYTES == 4 ? "float" : "double");
  memset(t, 0, sizeof *t);
  tf_decoder_init(&t->decoder, t->buffer, sizeof t->buffer);
  CHECK(pipe(said) == 0 && fcntl(said[0], F_SETFD, FD_CLOEXEC) == 0);
  fflush(stdout);
  t->child = fork();
  if (t->child == 0) {
    dup2(said[1], 2);
    setenv("TWOFOLD_PORT", "pty", 1);
    execl(program, program, (char *)NULL);
    _exit(127);
  }
  close(said[1]);
  t->said = said[0];
  for (size_t used = 0; used + 1 < sizeof name && !strchr(name, '\n');) {
    const ssize_t got = read(t->said, name + used, sizeof name - 1 - used);
    if (!CHECK(got > 0)) break;
    used += (size_t)got;
  }
  name[strcspn(name, "\n")] = '\0';
  t->line = open(name, O_RDWR | O_NOCTTY | O_NONBLOCK);
  CHECK(t->line >= 0);
}

static void take(target_t *t, const tf_frame_t *frame) {
  t->frames++;
  t->answers += frame->type == TF_DOWN_ANSWER;
  t->beats += frame->type == TF_DOWN_HEARTBEAT;
  if (frame->type == TF_DOWN_SCHEMA && frame->length > 20) {
    const uint32_t least = (uint32_t)tf_wire_get(frame->payload + 17, 4);
    t->session = (uint32_t)tf_wire_get(frame->payload + 13, 4);
    if (t->sequence < least) t->sequence = least;
  }
  if (frame->type != TF_DOWN_STATE) return;
  tf_state_t x;
  tf_read_state(frame->payload, frame->tick, &x);
  t->states++;
  t->wild += !isfinite(x.r) || !isfinite(x.v) || !isfinite(x.w) ||
             !isfinite(x.phi) || x.mode > TF_NO_MODE;
}

static void listen(target_t *t, int milliseconds, short events) {
  struct pollfd line = {t->line, (short)(POLLIN | events), 0};
  uint8_t bytes[4096];
  if (poll(&line, 1, milliseconds) <= 0 || !(line.revents & POLLIN)) return;
  const ssize_t got = read(t->line, bytes, sizeof bytes);
  tf_frame_t frame;
  size_t taken = 0, length = got > 0 ? (size_t)got : 0;
  for (const uint8_t *at = bytes;
       tf_decoder_block(&t->decoder, at, length, &taken, &frame);) {
    take(t, &frame);
    at += taken;
    length -= taken;
  }
}

/* All bytes, however long the line takes them; it is listened to meanwhile. */
static int put(target_t *t, const uint8_t *bytes, size_t size, double until) {
  while (size > 0 && seconds() < until) {
    const ssize_t taken = write(t->line, bytes, size);
    if (taken > 0) {
      bytes += taken;
      size -= (size_t)taken;
    } else if (errno != EAGAIN) {
      return 0;
    } else {
      listen(t, 10, POLLOUT);
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
static size_t whole(target_t *t, int command, uint8_t wire[ROOM]) {
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
  const uint32_t session = tap_bits() % 8 ? t->session : (uint32_t)tap_bits();
  uint32_t old = (uint32_t)(tap_bits() % (t->sequence + (uint64_t)1));
  return tf_command_seal(wire, type, length, session,
                         tap_bits() % 8 ? &t->sequence : &old, any_tick(),
                         NULL);
}

static size_t hostile(target_t *t, uint8_t wire[ROOM]) {
  const uint64_t kind = tap_bits() % 8;
  size_t size = 1 + tap_bits() % (kind == 0 ? 400 : 40);
  if (kind < 2) { /* noise, of which some is longer than any frame */
    for (size_t i = 0; i < size; i++) wire[i] = (uint8_t)tap_bits();
    return size;
  }
  if (kind == 2 && t->sent >= KEPT) {
    const size_t old = tap_bits() % KEPT;
    memcpy(wire, t->kept[old].bytes, t->kept[old].size);
    return t->kept[old].size;
  }
  size = whole(t, kind > 4, wire);
  if (kind == 3) wire[1 + tap_bits() % (size - 2)] ^= (uint8_t)tap_bits();
  t->kept[t->sent % KEPT].size = size;
  memcpy(t->kept[t->sent % KEPT].bytes, wire, size);
  return size;
}

/* Sends a command until one more is answered. */
static int answers(target_t *t, uint8_t type) {
  uint8_t wire[TF_FRAME_SIZE(TF_SESSION_BYTES + TF_TAG_BYTES)];
  const uint64_t before = t->answers;
  const double until = seconds() + PATIENCE;
  for (double next = 0; t->answers == before && seconds() < until;) {
    if (seconds() > next) {
      const size_t size =
          tf_command_seal(wire, type, 0, t->session, &t->sequence, 0, NULL);
      if (!put(t, wire, size, until)) return 0;
      next = seconds() + 0.2;
    }
    listen(t, 10, 0);
  }
  return t->answers > before;
}

TEST(hostile_frames_cost_no_firmware) {
  const double frames = setting("HOSTILE_FRAMES", 20000);
  uint8_t wire[ROOM];
  int status = 0;
  start(&it);
  CHECK(answers(&it, TF_UP_DESCRIBE));
  const double begin = seconds();
  const double until = begin + setting("HOSTILE_SECONDS", 60);
  while ((double)it.sent < frames && seconds() < until) {
    const size_t size = hostile(&it, wire);
    if (!put(&it, wire, size, until)) break;
    it.sent++;
    if (it.sent % 16 == 0) listen(&it, 0, 0);
    if (it.sent % 4096 == 0 && waitpid(it.child, &status, WNOHANG) != 0) break;
  }
  printf("# %" PRIu64 " hostile frames in %.1f s; %" PRIu64
         " frames came back, %" PRIu64 " answers, %" PRIu64 " states\n",
         it.sent, seconds() - begin, it.frames, it.answers, it.states);
  CHECK((double)it.sent >= frames);
  CHECK(answers(&it, TF_UP_DESCRIBE));
  CHECK(it.wild == 0);
  CHECK(it.decoder.bad == 0 && it.decoder.too_long == 0);
  CHECK(it.states > 0);
  kill(it.child, SIGTERM);
  const double patience = seconds() + PATIENCE;
  pid_t ended = 0;
  while (ended == 0 && seconds() < patience) {
    listen(&it, 10, 0);
    ended = waitpid(it.child, &status, WNOHANG);
  }
  CHECK(ended == it.child && WIFEXITED(status) && WEXITSTATUS(status) == 0);
  if (ended == 0) kill(it.child, SIGKILL);
}

int main(int argc, char **argv) {
  signal(SIGPIPE, SIG_IGN);
  return tap_main(argc, argv);
}
