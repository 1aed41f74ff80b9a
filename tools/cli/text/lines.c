// Text files, all in memory before the first line is looked at. Apart from
// buffer.c: the page takes that, and opens no files.

#include "lines.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "message.h"

static int read_all(FILE *file, size_t most, char **text, size_t *size) {
  for (size_t room = 4096; feof(file) == 0 && ferror(file) == 0; room *= 2) {
    char *more = *size <= most ? realloc(*text, room + 1) : NULL;
    if (more == NULL) {
      return *size <= most ? ENOMEM : 0;
    }
    *text = more;
    *size += fread(more + *size, 1, room - *size, file);
    more[*size] = '\0';
  }
  return ferror(file) != 0 ? errno : 0;
}

int cli_read_text(const char *option, const char *path, size_t most,
                  char **text, size_t *size) {
  const bool standard = strcmp(path, "-") == 0;
  FILE *file = standard ? stdin : fopen(path, "r");
  *text = NULL;
  *size = 0;
  const int error = file != NULL ? read_all(file, most, text, size) : errno;
  if (file != NULL && !standard) {
    (void)fclose(file);
  }
  if (error == 0) {
    return CLI_DONE;
  }
  free(*text);
  *text = NULL;
  return cli_message(error == ENOMEM ? CLI_STOPPED : CLI_USAGE, "%s%s: %s",
                     option, path, strerror(error));
}

int cli_note_open(const char *name) {
  return cli_message(
      CLI_DONE, "note: %s: the last line has no newline: it may be cut off",
      name);
}
