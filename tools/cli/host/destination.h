/// @file
/// Where rows go: a file that gets its name when it is whole, or something that
/// is written as it comes (standard output, a pipe, a device).
///
/// The rows of FILE are written to FILE.part in the same folder, which is
/// renamed to FILE once all of them are on disk. Whatever ends the program
/// before that, FILE is what it was, or is not there. FILE.part is locked while
/// it is written, so a second writer of FILE is refused.
#ifndef TWOFOLD_CLI_DESTINATION_H
#define TWOFOLD_CLI_DESTINATION_H

#include <stdbool.h>

#define CLI_PATH_ROOM 4096
typedef struct {
  int descriptor;
  bool beside; ///< rows go to `part`, which becomes `path`
  bool left;   ///< after closing: `part` has rows and was not renamed
  char path[CLI_PATH_ROOM], part[CLI_PATH_ROOM];
} cli_destination_t;

/// Opens it; a path of NULL or "-" is standard output. keep: what is in the
/// part stays; the caller says where to go on.
/// Returns: 0 or an errno; EBUSY: another program writes this file.
int cli_destination_open(cli_destination_t *destination, const char *path,
                         bool keep);

/// Closes it, on disk; standard output stays open. whole: all rows are there,
/// so the file gets its name; otherwise its rows stay in `part`.
/// Returns: 0 or an errno; EBUSY: `part` is not the file that was opened.
int cli_destination_close(cli_destination_t *destination, bool whole);

/// Whether a descriptor is a regular file.
bool cli_is_regular(int descriptor);

/// Whether two paths name one regular file, there or not yet; NULL and "-" are
/// none, and what is no regular file (a terminal, /dev/null) may come twice.
bool cli_one_file(const char *one, const char *other);

#endif
