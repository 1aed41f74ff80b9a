// POSIX: the same firmware as a process. Where its serial line goes is said by
// the environment variable TWOFOLD_PORT:
//   -                   standard output and input (also where it is not set)
//   pty                 a new pseudo-terminal; its name is told on standard
//                       error
//   /dev/ttyACM0:115200 a serial device with its baud rate
//   anything else       a file, written anew
// Ticks are counted by the monotonic clock and slept for to absolute deadlines,
// so that nothing adds up. Real-time priority and locked memory are taken where
// the system allows them.
#define _XOPEN_SOURCE 700

#include <errno.h>
#include <fcntl.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#include "../port.h"

#define NANOSECONDS 1000000000u

static struct {
  int in, out;
  unsigned used, sent; // of the bytes that wait
  uint8_t waiting[4096];
  uint64_t start;  // [ns]
  uint64_t period; // [ns]
} host = {.in = STDIN_FILENO, .out = STDOUT_FILENO};

static void fail(const char *what) {
  fprintf(stderr, "host: %s: %s\n", what, strerror(errno));
  exit(4);
}

static uint64_t now(void) {
  struct timespec time;
  (void)clock_gettime(CLOCK_MONOTONIC, &time);
  return (uint64_t)time.tv_sec * NANOSECONDS + (uint64_t)time.tv_nsec;
}

static speed_t speed_of(const char *baud) {
  static const struct {
    const char *name;
    speed_t speed;
  } speeds[] = {{"9600", B9600},   {"19200", B19200},   {"38400", B38400},
                {"57600", B57600}, {"115200", B115200}, {"230400", B230400}};
  for (unsigned i = 0; i < sizeof speeds / sizeof *speeds; i++)
    if (!strcmp(speeds[i].name, baud)) return speeds[i].speed;
  fprintf(stderr, "host: no baud rate is %s\n", baud);
  exit(2);
}

// Bytes as they are: no echo, no lines, no signals.
static void make_raw(int line, speed_t speed) {
  struct termios how;
  if (tcgetattr(line, &how) != 0) fail("tcgetattr");
  how.c_iflag = 0;
  how.c_oflag = 0;
  how.c_lflag = 0;
  how.c_cflag = CS8 | CREAD | CLOCAL;
  how.c_cc[VMIN] = 0;
  how.c_cc[VTIME] = 0;
  if (speed != B0) {
    (void)cfsetispeed(&how, speed);
    (void)cfsetospeed(&how, speed);
  }
  if (tcsetattr(line, TCSANOW, &how) != 0) fail("tcsetattr");
}

static void open_terminal(void) {
  const int line = posix_openpt(O_RDWR | O_NOCTTY);
  if (line < 0 || grantpt(line) != 0 || unlockpt(line) != 0) fail("pty");
  const char *name = ptsname(line);
  // Held open, so that a reader may come and go.
  const int other = open(name, O_RDWR | O_NOCTTY);
  if (other < 0) fail(name);
  make_raw(other, B0);
  fprintf(stderr, "%s\n", name);
  host.in = host.out = line;
}

static void open_device(const char *port) {
  char name[256];
  const char *colon = strrchr(port, ':');
  const size_t length = (size_t)(colon - port);
  if (length >= sizeof name) fail(port);
  memcpy(name, port, length);
  name[length] = 0;
  host.in = host.out = open(name, O_RDWR | O_NOCTTY | O_NONBLOCK);
  if (host.in < 0) fail(name);
  make_raw(host.in, speed_of(colon + 1));
}

static void open_file(const char *name) {
  host.out = open(name, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (host.out < 0) fail(name);
}

void port_init(void) {
  const char *port = getenv("TWOFOLD_PORT");
  if (port != NULL && !strcmp(port, "pty"))
    open_terminal();
  else if (port != NULL && !strncmp(port, "/dev/", 5) && strrchr(port, ':'))
    open_device(port);
  else if (port != NULL && strcmp(port, "-") != 0)
    open_file(port);
  (void)fcntl(host.in, F_SETFL, fcntl(host.in, F_GETFL) | O_NONBLOCK);
  (void)fcntl(host.out, F_SETFL, fcntl(host.out, F_GETFL) | O_NONBLOCK);
  const struct sched_param first = {.sched_priority =
                                        sched_get_priority_min(SCHED_FIFO)};
  if (getenv("TWOFOLD_REALTIME") != NULL &&
      (sched_setscheduler(0, SCHED_FIFO, &first) != 0 ||
       mlockall(MCL_CURRENT | MCL_FUTURE) != 0))
    fprintf(stderr, "host: no real-time priority: %s\n", strerror(errno));
}

bool port_tick_start(uint32_t rate) {
  host.period = NANOSECONDS / rate;
  host.start = now();
  return host.period >= 10000u;
}

uint32_t port_ticks(void) {
  return (uint32_t)((now() - host.start) / host.period);
}

uint32_t port_clock(void) { return (uint32_t)(now() - host.start); }

uint32_t port_clock_rate(void) { return NANOSECONDS; }

// Hands over what waits. Returns: whether there is somebody to take it.
static bool flush(void) {
  while (host.sent < host.used) {
    const ssize_t n =
        write(host.out, host.waiting + host.sent, host.used - host.sent);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno == EAGAIN || errno == EWOULDBLOCK;
    host.sent += (unsigned)n;
  }
  host.sent = host.used = 0;
  return true;
}

unsigned port_room(void) {
  if (host.used == sizeof host.waiting && !flush()) port_halt(4);
  return (unsigned)sizeof host.waiting - host.used;
}

void port_put(uint8_t byte) { host.waiting[host.used++] = byte; }

int port_get(void) {
  uint8_t byte;
  return read(host.in, &byte, 1) == 1 ? byte : -1;
}

void port_idle(uint32_t seen) {
  if (!flush()) port_halt(4);
  const uint32_t gone = port_ticks();
  if (gone != seen) return;
  // The count of ticks in full, from the 32 bits that the caller has.
  const uint64_t tick = (now() - host.start) / host.period + 1;
  const uint64_t at = host.start + tick * host.period;
  const struct timespec deadline = {(time_t)(at / NANOSECONDS),
                                    (long)(at % NANOSECONDS)};
  (void)clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, NULL);
}

void port_halt(int code) {
  const struct timespec moment = {0, 1000000};
  for (int i = 0; i < 1000 && flush() && host.used > 0; i++)
    (void)nanosleep(&moment, NULL);
  exit(code);
}
