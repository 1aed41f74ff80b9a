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
#include "twofold.h"

// A cell of braille has two columns of four dots, so a terminal of 80 columns
// shows a plane of 160 dots. Where the terminal is not known to take UTF-8 a
// cell is one mark, that of the mode of its last dot.

// Dot of a value among n, -1 outside.
static int place(const cli_extent_t *extent, double value, int n) {
  const double at = (value - extent->low) / (extent->high - extent->low) * n;
  return at >= 0 && at < n ? (int)at : -1;
}

static void set_dot(cli_canvas_t *canvas, int column, int row, unsigned ink) {
  static const uint8_t bits[4][2] = {
      {0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
  uint8_t *there = &canvas->ink[row / 4][column / 2];
  if (ink == CLI_INK_AXIS && *there != 0 && *there != CLI_INK_AXIS + 1) {
    return; // what moves hides the axes
  }
  canvas->dots[row / 4][column / 2] |= bits[row % 4][column % 2];
  *there = (uint8_t)(ink + 1);
}

void cli_canvas_clear(cli_canvas_t *canvas, int columns, int rows,
                      cli_extent_t x, cli_extent_t y) {
  memset(canvas, 0, sizeof *canvas);
  canvas->columns = columns < CLI_CANVAS_COLUMNS ? columns : CLI_CANVAS_COLUMNS;
  canvas->rows = rows < CLI_CANVAS_ROWS ? rows : CLI_CANVAS_ROWS;
  canvas->x = x;
  canvas->y = y;
  const int column = place(&canvas->x, 0, 2 * canvas->columns);
  const int row = place(&canvas->y, 0, 4 * canvas->rows);
  for (int i = 0; row >= 0 && i < 2 * canvas->columns; i += 2) {
    set_dot(canvas, i, 4 * canvas->rows - 1 - row, CLI_INK_AXIS);
  }
  for (int i = 0; column >= 0 && i < 4 * canvas->rows; i += 2) {
    set_dot(canvas, column, i, CLI_INK_AXIS);
  }
}

void cli_canvas_dot(cli_canvas_t *canvas, double x, double y, unsigned ink) {
  const int column = place(&canvas->x, x, 2 * canvas->columns);
  const int row = place(&canvas->y, y, 4 * canvas->rows);
  if (column >= 0 && row >= 0) {
    set_dot(canvas, column, 4 * canvas->rows - 1 - row, ink);
  }
}

char cli_pen_mark(unsigned mode) {
  static const char marks[TF_MODES + 2] = "+-PMo?";
  return marks[mode < TF_MODES ? mode : TF_MODES];
}

// Colours of every terminal; those of the modes differ in brightness, too.
void cli_pen_colour(const cli_pen_t *pen, unsigned ink, cli_buffer_t *text) {
  static const char *const codes[TF_MODES] = {
      "\033[33m", "\033[94m", "\033[32m", "\033[95m", "\033[31m"};
  if (!pen->colour) {
    return;
  }
  if (ink > 0 && ink <= TF_MODES) {
    cli_add(text, codes[ink - 1]);
  } else if (ink == CLI_INK_AXIS + 1) {
    cli_add(text, "\033[90m");
  } else if (ink == CLI_INK_NOW + 1) {
    cli_add(text, "\033[1m");
  } else {
    cli_add(text, "\033[m");
  }
}

static void add_cell(const cli_canvas_t *canvas, int row, int column,
                     const cli_pen_t *pen, cli_buffer_t *text) {
  const unsigned dots = canvas->dots[row][column];
  const unsigned ink = canvas->ink[row][column];
  char cell[4] = " ";
  if (ink == CLI_INK_NOW + 1) {
    cli_add(text, pen->utf8 ? "\xe2\x97\x8f" : "@"); // a black circle
    return;
  }
  if (ink != 0 && pen->utf8) {
    cell[0] = (char)0xe2; // U+2800 and the dots
    cell[1] = (char)(0xa0 + (dots >> 6));
    cell[2] = (char)(0x80 + (dots & 63u));
  } else if (ink == CLI_INK_AXIS + 1) {
    cell[0] = '.';
  } else if (ink != 0) {
    cell[0] = cli_pen_mark(ink - 1);
  }
  cli_add(text, cell);
}

void cli_canvas_row(const cli_canvas_t *canvas, int row, const cli_pen_t *pen,
                    cli_buffer_t *text) {
  unsigned before = 0;
  for (int column = 0; column < canvas->columns; column++) {
    const unsigned ink = canvas->ink[row][column];
    if (ink != before) {
      cli_pen_colour(pen, 0, text);
      cli_pen_colour(pen, ink, text);
      before = ink;
    }
    add_cell(canvas, row, column, pen, text);
  }
  if (before != 0) {
    cli_pen_colour(pen, 0, text);
  }
}

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
