// POSIX: the same firmware as a process. The environment variable TWOFOLD_PORT
// says where its serial line goes:
//   -                   standard output and input (the default)
//   pty                 a new pseudo-terminal; its name is printed on standard
//                       error
//   /dev/ttyACM0:115200 a serial device with its baud rate
//   anything else       a file, overwritten; refused while another one writes
//                       it
// Ticks are counted by the monotonic clock. The process sleeps to absolute
// deadlines, so that delays do not add up, and prints at the end on standard
// error how late it woke. TWOFOLD_REALTIME asks for real-time priority and
// locked memory. TWOFOLD_LATENESS names a file for the histogram of how long
// after the time that it slept to it woke, and was done: us,began,ended. It is
// written as FILE.part and gets its name when it is whole.
//
// Firmware with a key needs TWOFOLD_BOOT, a file that counts its starts; an old
// one in its place lets old sessions come again.
//
// When nothing reads the line it fills up, and the loop drops records. When the
// line is gone (device unplugged, pipe closed) the program ends with code 4.
// The reader of a pseudo-terminal may come and go. SIGINT, SIGTERM and, unless
// it is ignored, SIGHUP end the program with code 0.
#define _XOPEN_SOURCE 700

#include <errno.h>
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#include "../port.h"

#define NANOSECONDS 1000000000u

#define LATENESS_BINS 10000u // [us]; the last one counts what is later

static struct {
  int in, out;
  unsigned used, sent; // of the bytes that wait to be sent
  uint8_t waiting[4096];
  unsigned came, taken; // of the bytes received
  uint8_t received[256];
  uint64_t start;  // [ns]
  uint64_t period; // [ns]
  uint64_t due;    // the time that it last slept to [ns]
  // How late it woke for a tick [ns].
  uint64_t woke, late_sum, late_least, late_most;
  uint64_t began[LATENESS_BINS + 1], ended[LATENESS_BINS + 1];
} host = {.in = STDIN_FILENO, .out = STDOUT_FILENO};

static volatile sig_atomic_t stop_asked;

static void ask_stop(int signal) {
  (void)signal;
  stop_asked = 1;
}

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
  } speeds[] = {
      {"9600", B9600},     {"19200", B19200},     {"38400", B38400},
      {"57600", B57600},   {"115200", B115200},   {"230400", B230400},
#ifdef B2000000
      {"500000", B500000}, {"1000000", B1000000}, {"2000000", B2000000},
#endif
  };
  for (unsigned i = 0; i < sizeof speeds / sizeof *speeds; i++)
    if (!strcmp(speeds[i].name, baud)) return speeds[i].speed;
  fprintf(stderr, "host: no baud rate is %s\n", baud);
  exit(2);
}

// Bytes are passed unchanged: no echo, no lines, no signals.
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

// A file has one writer: what is in it stays until it is locked.
static void open_file(const char *name) {
  struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
  struct stat status;
  host.out = open(name, O_WRONLY | O_CREAT, 0666);
  if (host.out < 0 || fstat(host.out, &status) != 0) fail(name);
  if (!S_ISREG(status.st_mode)) return;
  if (fcntl(host.out, F_SETLK, &whole) != 0) {
    if (errno == EACCES || errno == EAGAIN) errno = EBUSY;
    fail(name);
  }
  if (ftruncate(host.out, 0) != 0) fail(name);
}

static void catch_signals(void) {
  struct sigaction action = {.sa_handler = ask_stop};
  (void)sigaction(SIGINT, &action, NULL);
  (void)sigaction(SIGTERM, &action, NULL);
  struct sigaction before;
  (void)sigaction(SIGHUP, NULL, &before);
  if (before.sa_handler != SIG_IGN) (void)sigaction(SIGHUP, &action, NULL);
  // Writing to a closed pipe, or beyond a limit, is an error instead.
  action.sa_handler = SIG_IGN;
  (void)sigaction(SIGPIPE, &action, NULL);
  (void)sigaction(SIGXFSZ, &action, NULL);
}

// The number of a descriptor that is closed would be given to the line, and
// messages would go there. Writing to what takes its place fails.
static void guard_descriptors(void) {
  for (int i = STDIN_FILENO; i <= STDERR_FILENO; i++)
    if (fcntl(i, F_GETFD) == -1) (void)open("/dev/null", O_RDONLY);
}

void port_init(void) {
  const char *port = getenv("TWOFOLD_PORT");
  guard_descriptors();
  catch_signals();
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

// Writes the bytes that wait. Returns: whether the line still exists.
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

static void count(uint64_t *bins, uint64_t late) {
  const uint64_t us = late / 1000u;
  bins[us < LATENESS_BINS ? us : LATENESS_BINS]++;
}

static void measure_late(uint64_t late) {
  count(host.began, late);
  if (host.woke == 0 || late < host.late_least) host.late_least = late;
  if (late > host.late_most) host.late_most = late;
  host.late_sum += late;
  host.woke++;
}

static void sleep_to_next_tick(void) {
  // All bits of the count of ticks, of which the caller has 32.
  const uint64_t tick = (now() - host.start) / host.period + 1;
  const uint64_t at = host.start + tick * host.period;
  host.due = at;
  const struct timespec deadline = {(time_t)(at / NANOSECONDS),
                                    (long)(at % NANOSECONDS)};
  if (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, NULL) == 0)
    measure_late(now() - at);
}

unsigned port_room(void) {
  if (host.used == sizeof host.waiting) {
    if (stop_asked) port_halt(0);
    if (!flush()) port_halt(4);
    // Nothing reads the line: sleep, or the caller would call again and again.
    if (host.used > 0 && host.period > 0) sleep_to_next_tick();
  }
  return (unsigned)sizeof host.waiting - host.used;
}

void port_put(uint8_t byte) { host.waiting[host.used++] = byte; }

int port_get(void) {
  if (host.taken == host.came) {
    const ssize_t n = read(host.in, host.received, sizeof host.received);
    host.taken = 0;
    host.came = n > 0 ? (unsigned)n : 0;
    if (n <= 0) return -1;
  }
  return host.received[host.taken++];
}

void port_idle(uint32_t seen) {
  if (stop_asked) port_halt(0);
  if (!flush()) port_halt(4);
  const uint64_t time = now();
  if ((uint32_t)((time - host.start) / host.period) != seen) return;
  if (host.due != 0) count(host.ended, time - host.due);
  sleep_to_next_tick();
}

static void write_lateness(const char *path) {
  static char part[4096]; // not on the stack of the loop
  struct stat before;
  // What is no regular file, as /dev/stdout, has no name to get.
  const bool beside = stat(path, &before) != 0 || S_ISREG(before.st_mode);
  const int length =
      snprintf(part, sizeof part, "%s%s", path, beside ? ".part" : "");
  errno = ENAMETOOLONG;
  if (length < 0 || (size_t)length >= sizeof part) fail(path);
  FILE *file = fopen(part, "w");
  if (file == NULL) fail(part);
  fputs("us,began,ended\n", file);
  for (unsigned us = 0; us <= LATENESS_BINS; us++)
    if (host.began[us] + host.ended[us] > 0)
      fprintf(file, "%u,%llu,%llu\n", us, (unsigned long long)host.began[us],
              (unsigned long long)host.ended[us]);
  const bool broken = ferror(file) != 0;
  if (fclose(file) != 0 || broken) fail(part);
  if (beside && rename(part, path) != 0) fail(path);
}

// The number that a file of ten digits and a newline holds, an empty one 0.
static bool read_count(int file, uint64_t *count) {
  char text[16], *end = text;
  const ssize_t length = pread(file, text, sizeof text - 1, 0);
  text[length > 0 ? length : 0] = 0;
  *count = strtoull(text, &end, 10);
  return length == 0 || (length == 11 && end == text + 10 && *end == '\n');
}

// Boards that share a file, and so a key, have one count. Where the number
// might be forgotten there is none.
uint32_t port_boot(void) {
  struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
  const char *name = getenv("TWOFOLD_BOOT");
  char text[16];
  uint64_t count = 0;
  errno = EINVAL;
  if (name == NULL) fail("TWOFOLD_BOOT, which names a file that counts starts");
  const int file = open(name, O_RDWR | O_CREAT | O_NOCTTY, 0600);
  if (file < 0 || fcntl(file, F_SETLKW, &whole) != 0) fail(name);
  errno = EINVAL;
  if (!read_count(file, &count) || count >= UINT32_MAX) fail(name);
  const int length =
      snprintf(text, sizeof text, "%010llu\n", (unsigned long long)count + 1);
  if (pwrite(file, text, (size_t)length, 0) != length || fsync(file) != 0)
    fail(name);
  if (count == 0) sync(); // its name, too
  (void)close(file);
  return (uint32_t)count + 1;
}

void port_halt(int code) {
  const struct timespec moment = {0, 1000000};
  for (int i = 0; i < 1000 && flush() && host.used > 0; i++)
    (void)nanosleep(&moment, NULL);
  if (host.woke > 0)
    fprintf(stderr,
            "host: woke for %llu ticks of %llu us; late by %.1f us at least, "
            "%.1f in the mean, %.1f at most\n",
            (unsigned long long)host.woke,
            (unsigned long long)(host.period / 1000u),
            (double)host.late_least * 1e-3,
            (double)host.late_sum / (double)host.woke * 1e-3,
            (double)host.late_most * 1e-3);
  const char *path = getenv("TWOFOLD_LATENESS");
  if (path != NULL) write_lateness(path);
  exit(code);
}
