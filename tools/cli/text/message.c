// Messages. They are read by someone who has just mistyped something, so each
// names the option, the value and the range that is allowed.

#include "message.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static char *diverted;
static size_t diverted_room;

void cli_message_divert(char *out, size_t room) {
  diverted = out;
  diverted_room = room;
}

int cli_message(int code, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  if (diverted != NULL) {
    (void)vsnprintf(diverted, diverted_room, format, arguments);
  } else {
    (void)fputs("twofold: ", stderr);
    (void)vfprintf(stderr, format, arguments);
    (void)fputc('\n', stderr);
  }
  va_end(arguments);
  return code;
}

int cli_finish_stdout(void) {
  errno = 0;
  if (fflush(stdout) == 0 && ferror(stdout) == 0) {
    return CLI_DONE;
  }
  return cli_message(CLI_STOPPED, "standard output: %s",
                     errno != 0 ? strerror(errno) : "write error");
}
