/// Text appended to a buffer of the caller; and text files line by line, of
/// which nothing is left out: fgets would hide what follows a zero.
#pragma once

#include <stdio.h>

#include "message.h"
#include "twofold/real.h"

/// The text always ends with a zero. What does not fit is left out, and
/// truncated is set.
typedef struct {
  char *text;
  size_t used, room;
  bool truncated;
} cli_buffer_t;

void cli_add(cli_buffer_t *buffer, const char *text);

/// Appends a form, in which %s stands for a text, %g for a number of the real
/// type of this program, PRIu64 for a count. There are no other conversions.
void cli_add_form(cli_buffer_t *buffer, const char *form, ...) CLI_PRINTF(2, 3);

void cli_add_real(cli_buffer_t *buffer, tf_real_t value);
void cli_add_count(cli_buffer_t *buffer, uint64_t value);

/// 32 bits as eight hexadecimal digits.
void cli_add_hash(cli_buffer_t *buffer, uint32_t value);

/// A float (is_float) or a double, whichever type this program was built for.
void cli_add_number(cli_buffer_t *buffer, double value, bool is_float);

/// Makes room for one more in a list from the heap, of `used` members of `size`
/// bytes each. room: in/out, members that it has room for.
/// Returns: the list, which may have moved; NULL: no memory, it is as it was.
void *cli_grow(void *list, size_t used, size_t *room, size_t size);

typedef enum {
  CLI_LINE,     ///< a line, without its end
  CLI_LINE_END, ///< there are no more; ferror tells whether that is an error
  CLI_LINE_BAD  ///< a zero in it, or more characters than there is room for
} cli_line_t;

/// Reads the next line; \n or \r\n ends it, or the end of the file does.
/// out: room bytes, ended by a zero.
cli_line_t cli_read_line(FILE *file, char *out, size_t room);

/// Tells that the last line of a file has no newline: one that was cut in a
/// number reads as another number. Returns: CLI_DONE.
int cli_note_open(const char *name);

/// The length of the mark of UTF-8 (U+FEFF) by which Windows programs begin a
/// text file, which is no part of the text; 0: it has none.
/// text: in, size bytes, the first ones of the file.
static inline size_t cli_utf8_mark(const char *text, size_t size) {
  return size >= 3 && text[0] == '\xEF' && text[1] == '\xBB' &&
                 text[2] == '\xBF'
             ? 3
             : 0;
}
