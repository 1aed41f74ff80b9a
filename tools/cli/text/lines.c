// Lines of a text file, of a length that has a bound. Apart from buffer.c: the
// page takes that, and its C library reads no characters.

#include "buffer.h"

cli_line_t cli_read_line(FILE *file, char *out, size_t room) {
  size_t used = 0;
  int byte = getc(file);
  if (byte == EOF) {
    return CLI_LINE_END;
  }
  for (; byte != EOF && byte != '\n'; byte = getc(file)) {
    if (byte == 0 || used + 1 == room) {
      return CLI_LINE_BAD;
    }
    out[used++] = (char)byte;
  }
  used -= used > 0 && out[used - 1] == '\r';
  out[used] = '\0';
  return CLI_LINE;
}

int cli_note_open(const char *name) {
  return cli_message(
      CLI_DONE, "note: %s: the last line has no newline: it may be cut off",
      name);
}
