/// @file
/// The terminal at standard output as a screen that is drawn over and over, and
/// that is as it was when the program ends.
#ifndef TWOFOLD_CLI_SCREEN_H
#define TWOFOLD_CLI_SCREEN_H

#include <stdbool.h>

#include "../text/buffer.h"

#define CLI_CANVAS_COLUMNS 256
#define CLI_CANVAS_ROWS 128

/// How a terminal is written to.
typedef struct {
  bool utf8, colour;
} cli_pen_t;

/// What a cell shows: a dot of a mode (tf_mode_t), or one of these.
enum { CLI_INK_AXIS = 14, CLI_INK_NOW = 15 };

typedef struct {
  double low, high;
} cli_extent_t;

typedef struct {
  int columns, rows; ///< cells
  cli_extent_t x, y;
  uint8_t dots[CLI_CANVAS_ROWS][CLI_CANVAS_COLUMNS]; ///< of braille
  uint8_t ink[CLI_CANVAS_ROWS][CLI_CANVAS_COLUMNS];  ///< of the last dot, + 1
} cli_canvas_t;

/// Empties it but for the lines x = 0 and y = 0, where they are within the
/// extents. columns, rows: in, in cells, cut to the room that there is.
void cli_canvas_clear(cli_canvas_t *canvas, int columns, int rows,
                      cli_extent_t x, cli_extent_t y);

/// A dot; nothing outside of the extents.
void cli_canvas_dot(cli_canvas_t *canvas, double x, double y, unsigned ink);

/// Appends a row of cells, top row 0.
void cli_canvas_row(const cli_canvas_t *canvas, int row, const cli_pen_t *pen,
                    cli_buffer_t *text);

/// The colour of an ink from here on; ink 0: that of plain text.
void cli_pen_colour(const cli_pen_t *pen, unsigned ink, cli_buffer_t *text);

/// The mark of a mode in ASCII; from TF_MODES on that of several futures.
char cli_pen_mark(unsigned mode);

typedef struct {
  cli_pen_t pen;
  int columns, rows; ///< as of the last cli_screen_measure
  bool resized;      ///< since then
} cli_screen_t;

/// Takes the terminal over: another page, no cursor. A signal that asks for a
/// stop gives it back at once.
/// Returns: whether there is one; otherwise a message says what is missing, and
/// not one byte goes to standard output.
bool cli_screen_open(cli_screen_t *screen);

void cli_screen_measure(cli_screen_t *screen);

/// What a drawing has to begin with, to end a line with, and to end with.
const char *cli_screen_start(const cli_screen_t *screen);
#define CLI_SCREEN_LINE "\033[K\r\n"
#define CLI_SCREEN_END "\033[K\033[J"

/// Shows a drawing in place of the one before.
void cli_screen_show(const char *drawing);

/// Gives the terminal back, and leaves lines on its page.
void cli_screen_close(const char *lines);

#endif
