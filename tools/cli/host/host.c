// Clock, descriptors, signals and sources. A simulation may run for hours and
// be stopped by hand. It then finishes its step and writes its last row, so a
// signal only sets a flag. The handler resets itself: a second signal ends the
// program at once, in case it is blocked by a reader that never reads. SIGINT
// and SIGTERM are caught even where the parent ignores them, as shells do for
// background jobs, because it must be possible to stop a run that has no end of
// its own; SIGHUP is not, for to ignore it is all that nohup does.

#define _DEFAULT_SOURCE

#include "host.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <stdarg.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

static volatile sig_atomic_t stop_asked = 0;

static const char *volatile restoring = NULL;

static struct termios lines;          // how the terminal was
static volatile sig_atomic_t in_keys; // it hands over keys

static void end_keys(void) {
  if (in_keys) {
    in_keys = 0;
    (void)tcsetattr(STDIN_FILENO, TCSANOW, &lines);
  }
}

// `write` and `tcsetattr` are all that a handler may do with a terminal. Where
// that fails there is no terminal to be put in order.
static void ask_for_stop(int number) {
  const int kept = errno;
  const char *bytes = restoring;
  (void)number;
  stop_asked = 1;
  if (bytes != NULL && write(STDOUT_FILENO, bytes, strlen(bytes)) < 0)
    restoring = NULL;
  end_keys();
  errno = kept;
}

void cli_screen_begin(const char *give_back) {
  restoring = give_back;
  // A job in the background that sets the terminal of another one is stopped.
  if (tcgetpgrp(STDIN_FILENO) != getpgrp() ||
      tcgetattr(STDIN_FILENO, &lines) != 0)
    return;
  struct termios keys = lines;
  keys.c_lflag &= ~(tcflag_t)(ICANON | ECHO);
  keys.c_cc[VMIN] = keys.c_cc[VTIME] = 0; // `read` does not wait
  in_keys = 1;
  (void)tcsetattr(STDIN_FILENO, TCSANOW, &keys);
}

void cli_screen_end(void) {
  end_keys();
  restoring = NULL;
}

void cli_stop_on_key(char key) {
  char pressed[64];
  const ssize_t count = in_keys && tcgetpgrp(STDIN_FILENO) == getpgrp()
                            ? read(STDIN_FILENO, pressed, sizeof pressed)
                            : 0;
  if (count > 0 && memchr(pressed, key, (size_t)count) != NULL)
    (void)raise(SIGINT);
}

void cli_terminal_size(int *columns, int *rows) {
  struct winsize size = {0};
  const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 &&
                     size.ws_col > 0 && size.ws_row > 0;
  *columns = known ? size.ws_col : 80;
  *rows = known ? size.ws_row : 24;
}

double cli_now(void) {
  struct timespec now = {0, 0};
  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void cli_sleep(int milliseconds) { (void)poll(NULL, 0, milliseconds); }

// The wait is to an absolute time, so that waking up late once does not delay
// the waits that follow.
void cli_wait_until(double time) {
  const double whole = floor(time);
  const struct timespec until = {(time_t)whole, (long)((time - whole) * 1e9)};
  while (!cli_stop_asked() && clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME,
                                              &until, NULL) == EINTR) {
  }
}

const char *cli_take_priority(void) {
  const struct sched_param lowest = {.sched_priority =
                                         sched_get_priority_min(SCHED_FIFO)};
  const bool has_it = sched_setscheduler(0, SCHED_FIFO, &lowest) == 0 &&
                      mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
  return has_it ? NULL : strerror(errno);
}

bool cli_is_terminal(int descriptor) { return isatty(descriptor) == 1; }

void cli_guard_descriptors(void) {
  for (int i = STDIN_FILENO; i <= STDERR_FILENO; i++) {
    // The lowest free number is the closed one; writing to it fails, because
    // it is opened for reading only.
    if (fcntl(i, F_GETFD) == -1) (void)open("/dev/null", O_RDONLY);
  }
}

void cli_catch_signals(void) {
  static const int stops[] = {SIGINT, SIGTERM, SIGHUP};
  const struct sigaction stop = {.sa_handler = ask_for_stop,
                                 .sa_flags = (int)SA_RESETHAND};
  struct sigaction before;
  for (size_t i = 0; i < sizeof stops / sizeof stops[0]; i++)
    if (stops[i] != SIGHUP || sigaction(SIGHUP, NULL, &before) != 0 ||
        before.sa_handler != SIG_IGN)
      (void)sigaction(stops[i], &stop, NULL);
  (void)signal(SIGPIPE, SIG_IGN);
#ifdef SIGXFSZ
  (void)signal(SIGXFSZ, SIG_IGN);
#endif
}

bool cli_stop_asked(void) { return stop_asked != 0; }

// Progress, so that no work of more than five seconds is silent for a person.

#define PATIENCE 2.0 // [s] before the first message
#define REDRAW 0.2   // [s] between messages

cli_progress_t cli_progress_start(double now, int output) {
  return (cli_progress_t){.silent = cli_is_quiet() ||
                                    !cli_is_terminal(STDERR_FILENO) ||
                                    (output >= 0 && cli_is_terminal(output)),
                          .started = now,
                          .next = now + PATIENCE};
}

void cli_progress_say(cli_progress_t *progress, double now, double share,
                      const char *format, ...) {
  va_list arguments;
  if (progress->silent || now < progress->next) return;
  (void)fprintf(stderr, "\r%.0f %%, ", 100 * share);
  va_start(arguments, format);
  (void)vfprintf(stderr, format, arguments);
  va_end(arguments);
  if (share > 0) {
    (void)fprintf(stderr, ", %.0f s left",
                  (now - progress->started) * (1 - share) / share);
  }
  (void)fputs("\033[K", stderr);
  (void)fflush(stderr);
  progress->shown = true;
  progress->next = now + REDRAW;
}

void cli_progress_clear(cli_progress_t *progress) {
  if (progress->shown) {
    (void)fputs("\r\033[K", stderr);
    progress->shown = false;
  }
}

// Sources of bytes, which may disappear. Files and pipes have an end; a device
// that reports its end has been unplugged. The speeds are those that POSIX
// names, and the usual faster ones where the system has them.

static const struct {
  uint64_t baud;
  speed_t speed;
} speeds[] = {
    {9600, B9600},       {19200, B19200},     {38400, B38400},
#ifdef B115200
    {57600, B57600},     {115200, B115200},   {230400, B230400},
#endif
#ifdef B2000000
    {460800, B460800},   {500000, B500000},   {921600, B921600},
    {1000000, B1000000}, {1500000, B1500000}, {2000000, B2000000},
    {3000000, B3000000},
#endif
};

// Raw mode: no echo, no line editing, no translation of bytes.
static bool make_raw(int descriptor, uint64_t baud) {
  struct termios line;
  if (tcgetattr(descriptor, &line) != 0) return false;
  cfmakeraw(&line);
  line.c_iflag &= ~(tcflag_t)IXOFF;
  line.c_cflag &= ~(tcflag_t)CSTOPB;
  line.c_cflag |= (tcflag_t)(CREAD | CLOCAL);
  line.c_cc[VMIN] = 1;
  line.c_cc[VTIME] = 0;
  size_t i = 0;
  while (i < sizeof speeds / sizeof speeds[0] && speeds[i].baud != baud) i++;
  if (i < sizeof speeds / sizeof speeds[0]) {
    (void)cfsetispeed(&line, speeds[i].speed);
    (void)cfsetospeed(&line, speeds[i].speed);
  } else if (baud != 0) {
    errno = EINVAL;
    return false;
  }
  return tcsetattr(descriptor, TCSANOW, &line) == 0;
}

bool cli_source_open(cli_source_t *source, const char *path, uint64_t baud,
                     bool both_ways) {
  struct stat status;
  *source =
      (cli_source_t){.name = "standard input", .descriptor = STDIN_FILENO};
  if (strcmp(path, "-") == 0) return true;
  // Opening a serial line must not block until there is a carrier; opening a
  // named pipe has to block until there is a writer.
  const bool is_line = stat(path, &status) == 0 && S_ISCHR(status.st_mode);
  source->name = path;
  source->descriptor = open(path, (both_ways ? O_RDWR : O_RDONLY) | O_NOCTTY |
                                      (is_line ? O_NONBLOCK : 0));
  source->is_device =
      source->descriptor >= 0 && isatty(source->descriptor) == 1;
  if (source->descriptor < 0 ||
      (source->is_device && !make_raw(source->descriptor, baud))) {
    source->error = errno;
    cli_source_close(source);
  }
  if (source->is_device) {
    // Bytes from before anybody listened are half a story, and a line that was
    // full sends them first: what comes within 100 ms is dropped.
    (void)tcflush(source->descriptor, TCIFLUSH);
    cli_sleep(100);
    (void)tcflush(source->descriptor, TCIFLUSH);
  }
  return source->error == 0;
}

static void hear_fault(cli_source_t *source, const uint8_t *bytes,
                       size_t count) {
  static const char begin[] = "\r\nfault: ";
  const size_t behind = sizeof begin - 1;
  for (size_t i = 0; i < count; i++) {
    const char byte = (char)bytes[i];
    const size_t at = source->heard;
    if (at < behind ? byte == begin[at]
                    : at < sizeof source->said && byte >= ' ' && byte <= '~') {
      source->said[source->heard++] = byte;
      continue;
    }
    if (at > behind && byte == '\r') {
      source->broke = true;
      (void)cli_message(CLI_DONE, "%s: the board says: %.*s", source->name,
                        (int)at - 2, source->said + 2);
    }
    source->heard = byte == '\r';
  }
}

cli_source_found_t cli_source_read(cli_source_t *source, uint8_t *bytes,
                                   size_t room, int milliseconds,
                                   size_t *count) {
  struct pollfd ready = {source->descriptor, POLLIN, 0};
  *count = 0;
  if (poll(&ready, 1, milliseconds) <= 0)
    return CLI_SOURCE_QUIET; // after a signal too: the caller checks for it
  const ssize_t got = read(source->descriptor, bytes, room);
  if (got > 0) {
    *count = (size_t)got;
    hear_fault(source, bytes, *count);
    return CLI_SOURCE_BYTES;
  }
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) return CLI_SOURCE_QUIET;
  source->error = got < 0 ? errno : 0;
  return got == 0 && !source->is_device ? CLI_SOURCE_END : CLI_SOURCE_GONE;
}

bool cli_source_write(cli_source_t *source, const uint8_t *bytes,
                      size_t length) {
  while (length > 0) {
    struct pollfd ready = {source->descriptor, POLLOUT, 0};
    if (poll(&ready, 1, 1000) <= 0) {
      source->error = ETIMEDOUT;
      return false;
    }
    const ssize_t put = write(source->descriptor, bytes, length);
    if (put > 0) {
      bytes += put;
      length -= (size_t)put;
    } else if (put < 0 && errno != EAGAIN && errno != EINTR) {
      source->error = errno;
      return false;
    }
  }
  return true;
}

void cli_source_close(cli_source_t *source) {
  if (source->descriptor > STDERR_FILENO) (void)close(source->descriptor);
  source->descriptor = -1;
}

const char *cli_read_key(const char *path, uint8_t key[TF_KEY_BYTES]) {
  struct stat status;
  char digits[2 * TF_KEY_BYTES + 1] = "", more;
  FILE *file = fopen(path, "r");
  if (file == NULL) return strerror(errno);
  const bool known = fstat(fileno(file), &status) == 0;
  const bool whole = fscanf(file, "%32[0-9a-fA-F]", digits) == 1 &&
                     strlen(digits) == sizeof digits - 1 &&
                     fscanf(file, " %c", &more) == EOF;
  (void)fclose(file);
  for (size_t i = 0; whole && i < TF_KEY_BYTES; i++)
    (void)sscanf(digits + 2 * i, "%2hhx", &key[i]);
  if (known && S_ISDIR(status.st_mode)) return strerror(EISDIR);
  if (!known || (status.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    return "others may read it, or change it: chmod 600";
  return whole ? NULL
               : "must hold 32 hexadecimal digits, then only white space";
}

bool cli_guard_begin(cli_guard_t *guard, const uint8_t *key) {
  *guard = (cli_guard_t){.key = key, .mute = key != NULL};
  if (key == NULL) return true;
  FILE *file = fopen("/dev/urandom", "rb");
  if (file == NULL) return false;
  const bool drawn = fread(guard->nonce, sizeof guard->nonce, 1, file) == 1;
  return fclose(file) == 0 && drawn;
}

bool cli_guard_takes(cli_guard_t *guard, const tf_frame_t *frame) {
  if (guard->key == NULL) return true;
  if (!tf_is_vouched_for(frame->type)) return guard->vouched;
  const bool right = tf_frame_is_vouched(
      frame, guard->key, tf_wire_get(guard->nonce, TF_NONCE_BYTES));
  guard->forged |= guard->vouched && !right;
  guard->vouched |= right;
  if (right && frame->type == TF_DOWN_HEARTBEAT) {
    guard->silent = 0;
    guard->mute = false;
  }
  return right;
}
