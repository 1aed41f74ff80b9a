/* firmware_line.h - the firmware of the host port as a process, and what comes
 * over its line, which is a pseudo-terminal or a pipe. FIRMWARE in the
 * environment is where `make test` put the program. */
#ifndef TESTS_SUPPORT_FIRMWARE_LINE_H
#define TESTS_SUPPORT_FIRMWARE_LINE_H

#include "terminal.h"

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
  bool commanded;               /* by what the twin does not get */
  uint64_t states, last, wrong; /* that came; the last one's tick */
  uint64_t frames, wild;        /* all; states that are no state */
  uint64_t answers;
  int code;       /* of the last answer */
  uint8_t source; /* of inputs, in the last report */
  uint64_t beats, beat_tick, states_at_beat;
  uint32_t dropped, bad, expired; /* of the last heartbeat */
} firmware_t;

static inline void hear(firmware_t *f) {
  const ssize_t got = read(f->said, f->heard + f->heard_used,
                           sizeof f->heard - 1 - f->heard_used);
  if (got > 0) f->heard_used += (size_t)got;
  f->heard[f->heard_used] = '\0';
}

/* Runs the firmware with TWOFOLD_PORT; out: its standard output, or -1. */
static inline void run(firmware_t *f, const char *port, int out) {
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

static inline int open_line(const firmware_t *f) {
  char name[64];
  snprintf(name, sizeof name, "%.*s", (int)strcspn(f->heard, "\n"), f->heard);
  const int line = open(name, O_RDWR | O_NOCTTY | O_NONBLOCK);
  CHECK(line >= 0);
  return line;
}

/* On a pseudo-terminal of its own making, whose name it prints. */
static inline void run_on_terminal(firmware_t *f) {
  run(f, "pty", -1);
  while (!strchr(f->heard, '\n') && f->heard_used < 64) {
    const size_t before = f->heard_used;
    hear(f);
    if (!CHECK(f->heard_used > before)) return;
  }
  f->line = open_line(f);
}

static inline void compare(firmware_t *f, const tf_state_t *x) {
  tf_simulation_t *twin = &f->twin;
  while (twin->state.tick < x->tick) {
    const tf_input_t input = tf_simulation_input(twin, tf_scenes[0]);
    if (tf_step(&twin->machine, &twin->state, &input, &twin->report) < 0) break;
  }
  f->wrong += x->tick != twin->state.tick || x->mode != twin->state.mode ||
              memcmp(&x->r, &twin->state.r, sizeof x->r) != 0 ||
              memcmp(&x->v, &twin->state.v, sizeof x->v) != 0 ||
              memcmp(&x->w, &twin->state.w, sizeof x->w) != 0;
}

static inline void take_state(firmware_t *f, const tf_frame_t *frame) {
  tf_state_t x;
  tf_read_state(frame->payload, frame->tick, &x);
  if (!f->commanded) compare(f, &x);
  f->wild += !isfinite(x.r) || !isfinite(x.v) || !isfinite(x.w) ||
             !isfinite(x.phi) || x.mode > TF_NO_MODE;
  f->states++;
  f->last = frame->tick;
}

static inline void take(firmware_t *f, const tf_frame_t *frame) {
  f->frames++;
  if (frame->type == TF_DOWN_STATE) take_state(f, frame);
  if (frame->type == TF_DOWN_REPORT)
    f->source = frame->payload[TF_REPORT_BYTES - 1];
  if (frame->type == TF_DOWN_SCHEMA) {
    const uint32_t least = (uint32_t)tf_wire_get(frame->payload + 17, 4);
    f->session = (uint32_t)tf_wire_get(frame->payload + 13, 4);
    if (f->number < least) f->number = least;
  }
  if (frame->type == TF_DOWN_ANSWER) {
    f->answers++;
    f->code = code_in(frame);
  }
  if (frame->type != TF_DOWN_HEARTBEAT) return;
  f->beats++;
  f->beat_tick = frame->tick;
  f->states_at_beat = f->states;
  f->dropped = (uint32_t)tf_wire_get(frame->payload + 12, 4);
  f->bad = (uint32_t)tf_wire_get(frame->payload + 16, 4);
  f->expired = (uint32_t)tf_wire_get(frame->payload + 52, 4);
}

/* Takes what has come, or waits for it or for `events` at most so long. */
static inline void listen_for(firmware_t *f, int milliseconds, short events) {
  struct pollfd line = {f->line, (short)(POLLIN | events), 0};
  uint8_t bytes[4096];
  if (poll(&line, 1, milliseconds) <= 0 || !(line.revents & ~POLLOUT)) return;
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

/* A millisecond of the line. */
static inline void listen(firmware_t *f) { listen_for(f, 1, 0); }

/* Until so many steps later. */
static inline int comes_to(firmware_t *f, uint64_t tick) {
  for (int i = 0; i < PATIENCE && f->last < tick; i++) listen(f);
  return f->last >= tick;
}

static inline void put_on_line(firmware_t *f, const uint8_t *wire,
                               size_t size) {
  if (write(f->line, wire, size) < 0) CHECK(errno == EAGAIN);
}

static inline void send_command(firmware_t *f, uint8_t type, int broken) {
  uint8_t wire[TF_FRAME_SIZE(TF_SESSION_BYTES)];
  const size_t size =
      tf_command_seal(wire, type, 0, f->session, &f->number, 0, NULL);
  if (broken) wire[1 + tap_bits() % (size - 2)] ^= 0x10;
  put_on_line(f, wire, size);
}

/* Sends a command until one more is answered. */
static inline int answers(firmware_t *f, uint8_t type) {
  const uint64_t before = f->answers;
  for (int i = 0; i < PATIENCE && f->answers == before; i++) {
    if (i % 100 == 0) send_command(f, type, 0);
    listen(f);
  }
  return f->answers > before;
}

/* Its exit code. What it said last is heard. */
static inline int end(firmware_t *f, int signal) {
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

int main(int argc, char **argv) {
  signal(SIGPIPE, SIG_IGN);
  return tap_main(argc, argv);
}

#endif
