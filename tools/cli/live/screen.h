/// @file
/// The terminal at standard output as a screen that is drawn over and over, and
/// that is as it was when the program ends.
#ifndef TWOFOLD_CLI_SCREEN_H
#define TWOFOLD_CLI_SCREEN_H

#include "canvas.h"

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

/// Reads the size.
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
