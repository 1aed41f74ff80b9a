/* The firmware of the host port at the end of a real line, a pseudo-terminal:
 * floods, a reader that stalls, leaves, comes back, a device that is unplugged.
 * Whatever the line does, every state that comes is that of the same step of a
 * run in this process, bit for bit, and what did not come is counted. */
#include "firmware_line.h"

static firmware_t it;

/* Until the next answer. Returns: its code, or 999. */
static int next_code(firmware_t *f) {
  const uint64_t before = f->answers;
  for (int i = 0; i < PATIENCE && f->answers == before; i++) listen(f);
  return f->answers > before ? f->code : 999;
}

/* Asks the board for its simulation. */
static int meet(firmware_t *f) {
  f->session = 0;
  send_command(f, TF_UP_DESCRIBE, 0);
  for (int i = 0; i < PATIENCE && f->session == 0; i++) listen(f);
  return f->session != 0;
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
  CHECK(answers(&it, TF_UP_DESCRIBE));
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
  const int line = open_terminal(O_NONBLOCK);
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
