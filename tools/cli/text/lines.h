/// Text files as a whole and line by line, of which nothing is left out: fgets
/// would hide what follows a zero.
#pragma once

#include <stddef.h>

#include "twofold/real.h"

/// Reads a file, or standard input where path is "-".
/// option: in, for the message: that of the path with a blank, or "".
/// most: bytes; a longer file may be cut off, but not to fewer.
/// text: out, from the heap, with a zero behind it; NULL after a message.
/// Returns: CLI_DONE, CLI_USAGE, or CLI_STOPPED: no memory.
int cli_read_text(const char *option, const char *path, size_t most,
                  char **text, size_t *size);

/// A text that is read, and where.
typedef struct {
  const char *name;   ///< of the file, kept, for messages
  const char *text;   ///< what is still to be read
  size_t size;        ///< of that
  unsigned long line; ///< number of the present line, from 1
  size_t length;      ///< of that, without its end: \n or \r\n
  bool open;          ///< it has no \n: a number there may be cut off
} cli_lines_t;

/// Reads the next line, the first without the mark of UTF-8 (U+FEFF) by which
/// Windows programs begin a text file.
/// out: out, room bytes, zero-terminated: as much of the line as fits.
/// Returns: whether there is one.
bool cli_next_line(cli_lines_t *lines, char *out, size_t room);

/// Tells that the last line has no newline. Returns: CLI_DONE.
int cli_note_open(const char *name);

/// Takes blanks from both ends of a text.
char *cli_trim(char *text);
