/* The firmware of the host port at the end of a real line, a pseudo-terminal:
 * floods, a reader that stalls, leaves, comes back, a device that is unplugged.
 * Whatever the line does, every state that comes is that of the same step of a
 * run in this process, bit for bit, and what did not come is counted.
 * FIRMWARE in the environment is where `make test` put the program. */
#ifndef _XOPEN_SOURCE
#define _XOPEN_SOURCE 700
#endif

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#define TAP_OWN_MAIN
#include "tap.h"
#include "twofold.h"

#define PATIENCE 20000 /* [ms], for what has to happen */

typedef struct {
  pid_t child;
  int line; /* our end */
  int said; /* what it says on standard error */
  char heard[4096];
  size_t heard_used;
  uint32_t session, number; /* of our next command, as the schema has them */
  tf_decoder_t decoder;
  uint8_t buffer[TF_DECODER_SIZE(TF_FRAME_PAYLOAD)];
  tf_simulation_t twin;
  uint64_t states, last, wrong; /* that came; the last one's tick */
  uint64_t answers;
  int code;       /* of the last answer */
  uint8_t source; /* of inputs, in the last report */
  uint64_t beats, beat_tick, states_at_beat;
  uint32_t dropped, bad, expired; /* of the last heartbeat */
} firmware_t;

static firmware_t it;

static void hear(firmware_t *f) {
  const ssize_t got = read(f->said, f->heard + f->heard_used,
                           sizeof f->heard - 1 - f->heard_used);
  if (got > 0) f->heard_used += (size_t)got;
  f->heard[f->heard_used] = '\0';
}

/* Runs the firmware with TWOFOLD_PORT; out: its standard output, or -1. */
static void run(firmware_t *f, const char *port, int out) {
  const char *firmware = getenv("FIRMWARE");
  static char program[512];
  int said[2] = {-1, -1};
  snprintf(program, sizeof program, "%s-%s/firmware-line.elf",
           firmware ? firmware : "build/boards/host/chaos",
           TF_REAL_BYTES == 4 ? "float" : "double");
  memset(f, 0, sizeof *f);
  f->line = -1;
  tf_decoder_init(&f->decoder, f->buffer, sizeof f->buffer);
  tf_params_t params = tf_scenes[0]->params;
  params.dt = TF_R(1.0) / 1000; /* its RATE */
  CHECK(tf_simulation_open(&f->twin, tf_scenes[0], &params, 1) == TF_OK);
  CHECK(pipe(said) == 0 && fcntl(said[0], F_SETFD, FD_CLOEXEC) == 0);
  fflush(stdout);
  f->child = fork();
  if (f->child == 0) {
    dup2(said[1], 2);
    if (out >= 0) dup2(out, 1);
    setenv("TWOFOLD_PORT", port, 1);
    execl(program, program, (char *)NULL);
    _exit(127);
  }
  close(said[1]);
  f->said = said[0];
}

static void make_raw(int line) {
  struct termios raw;
  if (!CHECK(tcgetattr(line, &raw) == 0)) return;
  raw.c_lflag = raw.c_oflag = raw.c_iflag = 0;
  CHECK(tcsetattr(line, TCSANOW, &raw) == 0);
}

static int open_line(const firmware_t *f) {
  char name[64];
  snprintf(name, sizeof name, "%.*s", (int)strcspn(f->heard, "\n"), f->heard);
  const int line = open(name, O_RDWR | O_NOCTTY | O_NONBLOCK);
  CHECK(line >= 0);
  return line;
}

/* On a pseudo-terminal of its own making, whose name it prints. */
static void run_on_terminal(firmware_t *f) {
  run(f, "pty", -1);
  while (!strchr(f->heard, '\n') && f->heard_used < 64) {
    const size_t before = f->heard_used;
    hear(f);
    if (!CHECK(f->heard_used > before)) return;
  }
  f->line = open_line(f);
}

static void take_state(firmware_t *f, const tf_frame_t *frame) {
  tf_state_t x;
  tf_simulation_t *twin = &f->twin;
  tf_read_state(frame->payload, frame->tick, &x);
  while (twin->state.tick < frame->tick) {
    const tf_input_t input = tf_simulation_input(twin, tf_scenes[0]);
    if (tf_step(&twin->machine, &twin->state, &input, &twin->report) < 0) break;
  }
  f->wrong += x.tick != twin->state.tick || x.mode != twin->state.mode ||
              memcmp(&x.r, &twin->state.r, sizeof x.r) != 0 ||
              memcmp(&x.v, &twin->state.v, sizeof x.v) != 0 ||
              memcmp(&x.w, &twin->state.w, sizeof x.w) != 0;
  f->states++;
  f->last = frame->tick;
}

static void take(firmware_t *f, const tf_frame_t *frame) {
  if (frame->type == TF_DOWN_STATE) take_state(f, frame);
  if (frame->type == TF_DOWN_REPORT)
    f->source = frame->payload[TF_REPORT_BYTES - 1];
  if (frame->type == TF_DOWN_SCHEMA) {
    f->session = (uint32_t)tf_wire_get(frame->payload + 13, 4);
    f->number = (uint32_t)tf_wire_get(frame->payload + 17, 4);
  }
  if (frame->type == TF_DOWN_ANSWER) {
    f->answers++;
    const uint8_t code = frame->payload[5];
    f->code = code < 128 ? code : code - 256;
  }
  if (frame->type != TF_DOWN_HEARTBEAT) return;
  f->beats++;
  f->beat_tick = frame->tick;
  f->states_at_beat = f->states;
  f->dropped = (uint32_t)tf_wire_get(frame->payload + 12, 4);
  f->bad = (uint32_t)tf_wire_get(frame->payload + 16, 4);
  f->expired = (uint32_t)tf_wire_get(frame->payload + 52, 4);
}

/* A millisecond of the line. */
static void listen(firmware_t *f) {
  struct pollfd line = {f->line, POLLIN, 0};
  uint8_t bytes[4096];
  if (poll(&line, 1, 1) <= 0) return;
  const ssize_t got = read(f->line, bytes, sizeof bytes);
  tf_frame_t frame;
  size_t taken = 0, length = got > 0 ? (size_t)got : 0;
  for (const uint8_t *at = bytes;
       tf_decoder_block(&f->decoder, at, length, &taken, &frame);) {
    take(f, &frame);
    at += taken;
    length -= taken;
  }
}

/* Until so many steps later. */
static int comes_to(firmware_t *f, uint64_t tick) {
  for (int i = 0; i < PATIENCE && f->last < tick; i++) listen(f);
  return f->last >= tick;
}

static void put_on_line(firmware_t *f, const uint8_t *wire, size_t size) {
  if (write(f->line, wire, size) < 0) CHECK(errno == EAGAIN);
}

static void send_command(firmware_t *f, uint8_t type, int broken) {
  uint8_t wire[TF_FRAME_SIZE(TF_SESSION_BYTES)];
  const size_t size =
      tf_command_seal(wire, type, 0, f->session, &f->number, 0, NULL);
  if (broken) wire[1 + tap_bits() % (size - 2)] ^= 0x10;
  put_on_line(f, wire, size);
}

/* Until the next answer. Returns: its code, or 999. */
static int next_code(firmware_t *f) {
  const uint64_t answers = f->answers;
  for (int i = 0; i < PATIENCE && f->answers == answers; i++) listen(f);
  return f->answers > answers ? f->code : 999;
}

/* Asks the board for its simulation. */
static int meet(firmware_t *f) {
  f->session = 0;
  send_command(f, TF_UP_DESCRIBE, 0);
  for (int i = 0; i < PATIENCE && f->session == 0; i++) listen(f);
  return f->session != 0;
}

/* Its exit code. What it said last is heard. */
static int end(firmware_t *f, int signal) {
  int status = 0;
  if (signal) kill(f->child, signal);
  for (int i = 0; i < PATIENCE; i++) {
    if (waitpid(f->child, &status, WNOHANG) == f->child) {
      hear(f);
      close(f->said);
      if (f->line >= 0) close(f->line);
      return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    if (f->line >= 0)
      listen(f);
    else
      poll(NULL, 0, 1);
  }
  kill(f->child, SIGKILL);
  waitpid(f->child, &status, 0);
  return -1;
}

TEST(uplink_flood_costs_no_step) {
  run_on_terminal(&it);
  CHECK(comes_to(&it, 100) && meet(&it));
  for (int i = 0; i < 2000; i++) {
    uint8_t noise[64];
    for (size_t k = 0; k < sizeof noise; k++) noise[k] = (uint8_t)tap_bits();
    if (write(it.line, noise, sizeof noise) < 0) CHECK(errno == EAGAIN);
    send_command(&it, TF_UP_STOP, 1);
    listen(&it);
  }
  /* Zeros end what the noise left open, then it listens again. */
  for (int i = 0; i < PATIENCE && it.answers == 0; i++) {
    if (i % 100 == 0) send_command(&it, TF_UP_DESCRIBE, 0);
    listen(&it);
  }
  CHECK(it.answers > 0);
  const uint64_t beats = it.beats;
  for (int i = 0; i < PATIENCE && it.beats == beats; i++) listen(&it);
  CHECK(it.bad > 100);
  CHECK(comes_to(&it, it.last + 100)); /* no `stop` got through */
  CHECK(it.wrong == 0 && it.decoder.bad == 0 && it.decoder.lost == 0);
  CHECK(end(&it, SIGTERM) == 0);
}

/* What a recorder of the line has acts once, and not on the next start. */
TEST(recorded_reset_acts_once) {
  uint8_t wire[TF_FRAME_SIZE(TF_SESSION_BYTES)];
  run_on_terminal(&it);
  CHECK(comes_to(&it, 100) && meet(&it));
  const size_t size =
      tf_command_seal(wire, TF_UP_RESET, 0, it.session, &it.number, 0, NULL);
  put_on_line(&it, wire, size);
  CHECK(next_code(&it) == TF_ANSWER_DONE);
  it.last = 0;
  CHECK(comes_to(&it, 50));
  for (int i = 0; i < 5; i++) {
    const uint64_t before = it.last;
    put_on_line(&it, wire, size);
    CHECK(next_code(&it) == TF_ANSWER_OLD);
    CHECK(comes_to(&it, before + 20) && it.last > before);
  }
  CHECK(end(&it, SIGTERM) == 0);
  run_on_terminal(&it);
  CHECK(comes_to(&it, 100) && meet(&it));
  put_on_line(&it, wire, size);
  CHECK(next_code(&it) == TF_ANSWER_FOREIGN);
  CHECK(comes_to(&it, 200));
  CHECK(it.wrong == 0); /* the motion of a board without commands */
  CHECK(end(&it, SIGTERM) == 0);
}

/* A controller that is killed leaves its torque for half a second, then the
 * machine coasts; reports, heartbeat and the next answer show it. */
TEST(silent_controller_is_told) {
  uint8_t wire[TF_FRAME_SIZE(TF_COMMAND_BYTES)];
  run_on_terminal(&it);
  CHECK(comes_to(&it, 10) && meet(&it));
  uint8_t *at = wire + TF_COMMAND_AT;
  for (int i = 0; i < 5; i++)
    at = tf_wire_put_real(at, i == 0 ? -1 : i == 3 ? TF_R(0.125) : 0);
  const size_t size = tf_command_seal(wire, TF_UP_INPUT, 5 * TF_REAL_BYTES,
                                      it.session, &it.number, 0, NULL);
  put_on_line(&it, wire, size);
  CHECK(next_code(&it) == TF_ANSWER_DONE);
  const uint64_t from = it.last;
  for (int i = 0; i < PATIENCE && it.source != TF_INPUT_SET; i++) listen(&it);
  for (int i = 0; i < PATIENCE && it.source != TF_INPUT_SAFE; i++) listen(&it);
  CHECK(it.source == TF_INPUT_SAFE);
  /* Records may be lost on a computer with other work, never come early. */
  CHECK(it.last >= from + 450);
  for (int i = 0; i < PATIENCE && it.expired == 0; i++) listen(&it);
  CHECK(it.expired == 1);
  CHECK(end(&it, SIGTERM) == 0);
}

TEST(stalled_reader_costs_records_and_no_step) {
  const struct timespec stall = {1, 500000000};
  run_on_terminal(&it);
  CHECK(comes_to(&it, 100));
  nanosleep(&stall, NULL); /* more than a pseudo-terminal holds */
  for (int i = 0; i < PATIENCE && it.dropped == 0; i++) listen(&it);
  CHECK(it.dropped > 0);
  const uint64_t beats = it.beats;
  for (int i = 0; i < PATIENCE && it.beats == beats; i++) listen(&it);
  /* Of every step there was a record, sent or counted; a heartbeat comes
   * before that of its own step, and may have been dropped itself. */
  const uint64_t records = it.states_at_beat + it.dropped;
  CHECK(records >= it.beat_tick &&
        records <= it.beat_tick + 1 + it.beat_tick / 500);
  CHECK(it.wrong == 0 && it.decoder.bad == 0 && it.decoder.lost == 0);
  CHECK(end(&it, SIGTERM) == 0);
}

TEST(reader_leaves_and_comes_back) {
  run_on_terminal(&it);
  CHECK(comes_to(&it, 100));
  close(it.line);
  poll(NULL, 0, 50);
  it.line = open_line(&it);
  const uint64_t before = it.last;
  CHECK(comes_to(&it, before + 100));
  CHECK(it.wrong == 0);
  CHECK(end(&it, SIGINT) == 0);
}

TEST(device_that_is_unplugged_ends_it) {
  char port[128];
  struct termios how;
  const int line = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
  CHECK(line >= 0 && grantpt(line) == 0 && unlockpt(line) == 0);
  CHECK(fcntl(line, F_SETFD, FD_CLOEXEC) == 0);
  make_raw(line);
  snprintf(port, sizeof port, "%s:57600", ptsname(line));
  run(&it, port, -1);
  it.line = line;
  CHECK(comes_to(&it, 100));
  CHECK(it.wrong == 0 && it.decoder.bad == 0);
  CHECK(tcgetattr(line, &how) == 0 && cfgetospeed(&how) == B57600);
  send_command(&it, TF_UP_DESCRIBE, 0);
  for (int i = 0; i < PATIENCE && it.answers == 0; i++) listen(&it);
  CHECK(it.answers == 1);
  close(line);
  it.line = -1;
  CHECK(end(&it, 0) == 4);
}

TEST(closed_pipe_ends_it) {
  int out[2] = {-1, -1};
  CHECK(pipe(out) == 0 && fcntl(out[0], F_SETFD, FD_CLOEXEC) == 0);
  run(&it, "-", out[1]);
  close(out[1]);
  it.line = out[0];
  CHECK(comes_to(&it, 10));
  close(out[0]);
  it.line = -1;
  CHECK(end(&it, 0) == 4);
}

TEST(wrong_ports_are_told) {
  run(&it, "/dev/null:12345", -1);
  CHECK(end(&it, 0) == 2 && strstr(it.heard, "12345") != NULL);
  run(&it, "/dev/null:9600", -1);
  CHECK(end(&it, 0) == 4); /* no terminal */
  run(&it, "/dev/there/is/none:9600", -1);
  CHECK(end(&it, 0) == 4);
  CHECK(strstr(it.heard, "/dev/there/is/none") != NULL);
}

TEST(jitter_is_measured_and_told) {
  unsigned long long ticks = 0, period = 0;
  double least = -1, mean = -1, most = -1;
  run_on_terminal(&it);
  CHECK(comes_to(&it, 200));
  CHECK(end(&it, SIGTERM) == 0);
  const char *report = strstr(it.heard, "host: woke");
  if (!CHECK(report != NULL)) return;
  CHECK(sscanf(report,
               "host: woke for %llu ticks of %llu us; late by %lf us at "
               "least, %lf in the mean, %lf at most",
               &ticks, &period, &least, &mean, &most) == 5);
  CHECK(ticks > 0 && period == 1000);
  CHECK(least >= 0 && least <= mean && mean <= most);
}

int main(int argc, char **argv) {
  signal(SIGPIPE, SIG_IGN);
  return tap_main(argc, argv);
}
