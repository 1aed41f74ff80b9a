/// Rows on their way to a file or to standard output, in whole lines. Those of
/// FILE are written to FILE.part beside it, which is renamed to FILE once all
/// of them are on disk: whatever ends the program before that, FILE is what it
/// was, or is not there. FILE.part is locked while it is written, so a second
/// writer of FILE is refused. Standard output, a pipe or a device is written as
/// it comes.
#pragma once

#include "../text/text.h"

#define CLI_PATH_ROOM 4096
bool cli_is_regular(int descriptor);

/// Whether two paths name one regular file, there or not yet; NULL and "-" are
/// none, and what is no regular file (a terminal, /dev/null) may come twice.
bool cli_one_file(const char *one, const char *other);

#define CLI_OUTPUT_ROOM 65536
typedef struct {
  const char *name; ///< for messages
  int descriptor;
  bool beside; ///< rows go to `part`, which becomes `path`
  bool left;   ///< after closing: `part` has rows and was not renamed
  char path[CLI_PATH_ROOM], part[CLI_PATH_ROOM];
  size_t there;   ///< bytes that were in `part` when it was opened
  int error;      ///< errno of the first failure, 0 while there was none
  double flushed; ///< cli_now() of the last flush
  char last;      ///< byte that ends a row: newline unless set otherwise
  size_t used;
  char buffer[CLI_OUTPUT_ROOM];
} cli_output_t;

/// What becomes of rows in the part, which a program left that was stopped.
typedef enum {
  CLI_WRITE_OVER, ///< they are noted, and written over
  CLI_WRITE_ONCE, ///< nothing has them again: the file is refused
  CLI_GO_ON       ///< they stay until cli_output_go_on says how many bytes
} cli_begin_t;

/// Opens a file for writing, or standard output where path is NULL or "-".
/// keep: whether what is in its part stays for now.
/// Returns: whether it is open; otherwise error is set.
bool cli_output_open(cli_output_t *output, const char *path, bool keep);

/// Opens it for a command: from now on signals are caught as by
/// cli_catch_signals. option: the option that gave the path, for the message.
int cli_output_begin(cli_output_t *output, const char *option, const char *path,
                     cli_begin_t how);

/// Notes that the rows in its part are written over. Returns: CLI_DONE.
int cli_output_note_over(const cli_output_t *output);

/// Keeps so many bytes of the part, if there is one, removes the others, and
/// goes on behind them.
void cli_output_go_on(cli_output_t *output, size_t kept);

/// Closes it for a command that has ended with a code. Under CLI_DONE a file
/// gets its name, otherwise a message says where its rows are.
/// Returns: the code, or CLI_STOPPED in place of CLI_DONE.
int cli_output_end(cli_output_t *output, int code);

/// Begins a file, writes one text, and ends it.
int cli_output_write(cli_output_t *output, const char *option, const char *path,
                     const char *text, size_t length);

/// Reports where the rows of a file are that was closed before it was whole.
void cli_output_tell_part(const cli_output_t *output);

/// The first failure in words; output->error must not be 0.
const char *cli_output_reason(const cli_output_t *output);

/// Appends one or more whole lines, or bytes.
/// Returns: whether no failure has occurred so far; after the first failure
/// nothing more is written.
bool cli_output_lines(cli_output_t *output, const void *lines, size_t length);

/// Hands everything to the operating system. Returns: likewise.
bool cli_output_flush(cli_output_t *output);

/// Flushes, syncs to disk and closes (standard output is left open). whole: all
/// rows are there, so the file gets its name unless its output failed.
/// Returns: likewise.
bool cli_output_close(cli_output_t *output, bool whole);
