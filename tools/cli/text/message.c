// Messages. They are read by someone who has just mistyped something, so each
// names the option, the value and the range that is allowed.

#include "message.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static char *diverted;
static size_t diverted_room;
static char last[512];

void cli_message_divert(char *out, size_t room) {
  diverted = out;
  diverted_room = room;
}

const char *cli_last_message(void) { return last; }

int cli_message(int code, const char *format, ...) {
  va_list arguments;
  if (code != CLI_DONE) {
    va_start(arguments, format);
    (void)vsnprintf(last, sizeof last, format, arguments);
    va_end(arguments);
  }
  va_start(arguments, format);
  if (diverted != NULL) {
    size_t used = strlen(diverted);
    if (used > 0 && used + 1 < diverted_room) {
      memcpy(diverted + used, "\n", 2);
      used++;
    }
    (void)vsnprintf(diverted + used, diverted_room - used, format, arguments);
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
