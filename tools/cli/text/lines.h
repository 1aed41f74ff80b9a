/// @file
/// Text files line by line. fgets would hide what follows a zero, and what
/// stands behind a carriage return is easily dropped: nothing of a file is left
/// out here.
#ifndef TWOFOLD_CLI_LINES_H
#define TWOFOLD_CLI_LINES_H

#include <stddef.h>
#include <stdio.h>

typedef enum {
  CLI_LINE,     ///< a line, without its end
  CLI_LINE_END, ///< there are no more; ferror tells whether that is an error
  CLI_LINE_BAD  ///< a zero in it, or more characters than there is room for
} cli_line_t;

/// Reads the next line; \n or \r\n ends it, or the end of the file does.
/// out: room bytes, ended by a zero.
cli_line_t cli_read_line(FILE *file, char *out, size_t room);

/// The length of the mark of UTF-8 (U+FEFF) by which Windows programs begin a
/// text file, which is no part of the text; 0: it has none.
/// text: in, size bytes, the first ones of the file.
static inline size_t cli_utf8_mark(const char *text, size_t size) {
  return size >= 3 && text[0] == '\xEF' && text[1] == '\xBB' &&
                 text[2] == '\xBF'
             ? 3
             : 0;
}

#endif
