// Messages. They are read by someone who has just mistyped something, so each
// names the option, the value and the range that is allowed.

#include <errno.h>
#include <stdarg.h>

#include "text.h"

static char *diverted;
static size_t diverted_room;
static char last[512];
static bool quiet;

void cli_be_quiet(bool from_now) { quiet = from_now; }

bool cli_is_quiet(void) { return quiet; }

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
  } else if (code != CLI_DONE || !quiet) {
    (void)fputs("twofold: ", stderr);
    (void)vfprintf(stderr, format, arguments);
    (void)fputc('\n', stderr);
  }
  va_end(arguments);
  return code;
}

int cli_finish_stdout(void) {
  errno = 0;
  if (fflush(stdout) == 0 && ferror(stdout) == 0) return CLI_DONE;
  return cli_stop("standard output: %s",
                  errno != 0 ? strerror(errno) : "write error");
}

// Text files are in memory as a whole before the first line is looked at.

static int read_all(FILE *file, size_t most, char **text, size_t *size) {
  for (size_t room = 4096; feof(file) == 0 && ferror(file) == 0; room *= 2) {
    char *more = *size <= most ? realloc(*text, room + 1) : NULL;
    if (more == NULL) return *size <= most ? ENOMEM : 0;
    *text = more;
    *size += fread(more + *size, 1, room - *size, file);
    more[*size] = '\0';
  }
  return ferror(file) != 0 ? errno : 0;
}

static bool has_lone_cr(const char *text) {
  while (text != NULL && (text = strchr(text, '\r')) != NULL)
    if (*++text != '\n' && *text != '\0') return true;
  return false;
}

int cli_read_text(const char *option, const char *path, size_t most,
                  char **text, size_t *size) {
  const bool standard = strcmp(path, "-") == 0;
  FILE *file = standard ? stdin : fopen(path, "r");
  *text = NULL;
  *size = 0;
  const int error = file != NULL ? read_all(file, most, text, size) : errno;
  if (file != NULL && !standard) (void)fclose(file);
  if (error == 0 && !has_lone_cr(*text)) return CLI_DONE;
  free(*text);
  *text = NULL;
  return cli_message(
      error == ENOMEM ? CLI_STOPPED : CLI_USAGE, "%s%s: %s", option, path,
      error != 0 ? strerror(error)
                 : "a line ends with CR alone, expected LF or CR LF");
}

int cli_note_open(const char *name) {
  return cli_message(
      CLI_DONE, "note: %s: the last line has no newline: it may be cut off",
      name);
}
