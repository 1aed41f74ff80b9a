// The terminal. All that is used of it are ANSI codes that every emulator of
// the last decades knows, so there is no table of terminals; where TERM says
// "dumb", or nothing, nothing is drawn. Its size is read before each drawing,
// which needs no signal.

#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#endif

#include "screen.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "../host/host.h"
#include "../text/message.h"

// Another page; no cursor; long lines end at the edge.
#define TAKE "\033[?1049h\033[?25l\033[?7l\033[2J"
#define GIVE_BACK "\033[m\033[?7h\033[?25h\033[?1049l"

// Nobody looks at a terminal that takes no more bytes. Once a signal has
// asked for a stop the terminal is no longer ours, and what is left of a
// drawing is not written.
static void put(const char *text, bool drawing) {
  size_t length = strlen(text);
  while (length > 0 && !(drawing && cli_stop_asked())) {
    const ssize_t taken = write(STDOUT_FILENO, text, length);
    if (taken > 0) {
      text += taken;
      length -= (size_t)taken;
    } else if (taken == 0 || errno != EINTR) {
      return;
    }
  }
}

// As the C library finds the character set, which this program does not ask:
// its numbers have to be those of the locale "C".
static bool takes_utf8(void) {
  static const char *const names[] = {"LC_ALL", "LC_CTYPE", "LANG"};
  for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
    const char *value = getenv(names[i]);
    if (value != NULL && value[0] != '\0') {
      const char *set = strchr(value, '.');
      return set != NULL && (strncasecmp(set, ".UTF-8", 6) == 0 ||
                             strncasecmp(set, ".utf8", 5) == 0);
    }
  }
  return false;
}

bool cli_screen_open(cli_screen_t *screen) {
  const char *term = getenv("TERM");
  const char *plain = getenv("NO_COLOR");
  if (!cli_is_terminal(STDOUT_FILENO)) {
    (void)cli_message(CLI_DONE,
                      "--live needs a terminal: standard output is none");
    return false;
  }
  if (term == NULL || term[0] == '\0' || strcmp(term, "dumb") == 0) {
    (void)cli_message(CLI_DONE,
                      "--live needs a terminal that is drawn on: TERM is '%s'",
                      term != NULL ? term : "");
    return false;
  }
  screen->pen.utf8 = takes_utf8();
  screen->pen.colour = plain == NULL || plain[0] == '\0';
  screen->columns = screen->rows = 0;
  cli_catch_signals();
  cli_restore_on_stop(GIVE_BACK);
  put(TAKE, false);
  return true;
}

void cli_screen_measure(cli_screen_t *screen) {
  int columns = 0;
  int rows = 0;
  cli_terminal_size(&columns, &rows);
  screen->resized = columns != screen->columns || rows != screen->rows;
  screen->columns = columns;
  screen->rows = rows;
}

const char *cli_screen_start(const cli_screen_t *screen) {
  return screen->resized ? "\033[2J\033[H" : "\033[H";
}

void cli_screen_show(const char *drawing) { put(drawing, true); }

void cli_screen_close(const char *lines) {
  put(GIVE_BACK, false);
  cli_restore_on_stop(NULL);
  put(lines, false);
}
