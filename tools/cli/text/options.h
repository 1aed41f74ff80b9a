/// @file
/// Reading of command lines, the same in every command: `--name value` or
/// `--name=value`, before or after the positional argument (a scene, a file).
#ifndef TWOFOLD_CLI_OPTIONS_H
#define TWOFOLD_CLI_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// An option as typed. value: "" where it takes none.
typedef struct {
  const char *name, *value;
} cli_given_t;

/// How an option may be given.
enum {
  CLI_ONCE = 0,       ///< with a value; a second time is an error
  CLI_REPEATABLE = 1, ///< with a value, any number of times
  CLI_FLAG = 2,       ///< without a value, once
  CLI_WRITES = 4,     ///< once; the value is a file that is written
  CLI_READS = 8       ///< once; the value is a file that is read
};

/// An option of a command. how: one of the above.
/// read: stores the value in args. Returns: CLI_DONE, or another code after a
/// message, which ends the reading.
typedef struct {
  const char *name;
  int (*read)(void *args, const cli_given_t *given);
  unsigned how;
} cli_option_t;

/// The options and positional arguments of a command; at most 64 options.
/// take: stores a positional argument. Returns: as read.
typedef struct {
  const char *command;
  const cli_option_t *options;
  size_t count;
  int (*take)(void *args, const char *word);
} cli_syntax_t;

/// Reads all words. "-" is a positional argument. Then no file that is written,
/// nor the `.part` or `.resume` beside it, may be one that another option or a
/// positional argument names; the name of a built-in scene is none.
/// Returns: CLI_DONE; after a message CLI_USAGE or what a reader returned.
int cli_read_words(const cli_syntax_t *syntax, void *args, int argc,
                   char *const argv[]);

/// Stores the name of a file, which must not be empty.
/// Returns: CLI_DONE, or CLI_USAGE after a message.
int cli_read_path(const cli_given_t *given, const char **out);

/// Stores whether the summary is to be JSON: `text` or `json`.
/// Returns: CLI_DONE, or CLI_USAGE after a message.
int cli_read_summary(const cli_given_t *given, bool *json);

/// Stores an integer in [low, high].
/// Returns: CLI_DONE, or CLI_USAGE after a message.
int cli_read_count(const cli_given_t *given, uint64_t low, uint64_t high,
                   uint64_t *out);

#endif
