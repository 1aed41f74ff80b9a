/* terminal.h - what tests share that start a program at a pseudo-terminal. It
 * is included first, for it asks for more of the system than tap.h. */
#ifndef TESTS_SUPPORT_TERMINAL_H
#define TESTS_SUPPORT_TERMINAL_H

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
#include "frame_in.h"
#include "tap.h"
#include "twofold.h"

#define PATIENCE 20000 /* [ms], for what has to happen */

static inline void make_raw(int line) {
  struct termios raw;
  if (!CHECK(tcgetattr(line, &raw) == 0)) return;
  raw.c_lflag = raw.c_oflag = raw.c_iflag = 0;
  CHECK(tcsetattr(line, TCSANOW, &raw) == 0);
}

/* The end that a board has of a new pseudo-terminal, or -1. */
static inline int open_terminal(int flags) {
  const int line = posix_openpt(O_RDWR | O_NOCTTY | flags);
  if (!CHECK(line >= 0 && grantpt(line) == 0 && unlockpt(line) == 0)) return -1;
  CHECK(fcntl(line, F_SETFD, FD_CLOEXEC) == 0);
  make_raw(line);
  return line;
}

#endif
