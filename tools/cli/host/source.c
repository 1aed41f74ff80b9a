// A source of bytes that may disappear. Files and pipes have an end; a device
// that reports its end has been unplugged. Only POSIX is used. The speeds are
// those that it names, and the usual faster ones where the system has them.

#define _DEFAULT_SOURCE

#include "source.h"

#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <termios.h>
#include <unistd.h>

static const struct {
  uint64_t baud;
  speed_t speed;
} speeds[] = {
    {9600, B9600},     {19200, B19200},   {38400, B38400},
#ifdef B115200
    {57600, B57600},   {115200, B115200}, {230400, B230400},
#endif
#ifdef B1000000
    {460800, B460800}, {921600, B921600}, {1000000, B1000000},
#endif
};

// Raw mode: no echo, no line editing, no translation of bytes.
static bool make_raw(int descriptor, uint64_t baud) {
  struct termios line;
  if (tcgetattr(descriptor, &line) != 0) {
    return false;
  }
  cfmakeraw(&line);
  line.c_iflag &= ~(tcflag_t)IXOFF;
  line.c_cflag &= ~(tcflag_t)CSTOPB;
  line.c_cflag |= (tcflag_t)(CREAD | CLOCAL);
  line.c_cc[VMIN] = 1;
  line.c_cc[VTIME] = 0;
  size_t i = 0;
  while (i < sizeof speeds / sizeof speeds[0] && speeds[i].baud != baud) {
    i++;
  }
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
  if (strcmp(path, "-") == 0) {
    return true;
  }
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
  return source->error == 0;
}

cli_source_found_t cli_source_read(cli_source_t *source, uint8_t *bytes,
                                   size_t room, int milliseconds,
                                   size_t *count) {
  struct pollfd ready = {source->descriptor, POLLIN, 0};
  *count = 0;
  if (poll(&ready, 1, milliseconds) <= 0) {
    return CLI_SOURCE_QUIET; // after a signal too: the caller checks for it
  }
  const ssize_t got = read(source->descriptor, bytes, room);
  if (got > 0) {
    *count = (size_t)got;
    return CLI_SOURCE_BYTES;
  }
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) {
    return CLI_SOURCE_QUIET;
  }
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
  if (source->descriptor > STDERR_FILENO) {
    (void)close(source->descriptor);
  }
  source->descriptor = -1;
}

#define DIGITS (2 * TF_KEY_BYTES)

const char *cli_read_key(const char *path, uint8_t key[TF_KEY_BYTES]) {
  struct stat status;
  FILE *file = fopen(path, "r");
  if (file == NULL) return strerror(errno);
  const bool known = fstat(fileno(file), &status) == 0;
  unsigned digits = 0;
  int next = EOF;
  while ((next = fgetc(file)) != EOF &&
         (digits < DIGITS ? isxdigit(next) : isspace(next))) {
    if (digits == DIGITS) continue;
    const int value = isdigit(next) ? next - '0' : tolower(next) - 'a' + 10;
    const int high = digits % 2 == 0 ? 0 : key[digits / 2];
    key[digits++ / 2] = (uint8_t)(high << 4 | value);
  }
  (void)fclose(file);
  if (known && S_ISDIR(status.st_mode)) return strerror(EISDIR);
  if (!known || (status.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    return "others may read it, or change it: chmod 600";
  return digits == DIGITS && next == EOF
             ? NULL
             : "must hold 32 hexadecimal digits, then only white space";
}
