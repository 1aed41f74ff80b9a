/// @file
/// Reading of command lines, the same in every command: `--name value` or
/// `--name=value`, on either side of what stands alone (a scene, a file).
#ifndef TWOFOLD_CLI_OPTIONS_H
#define TWOFOLD_CLI_OPTIONS_H

#include <stddef.h>
#include <stdint.h>

/// An option as typed. value: "" where it takes none.
typedef struct {
  const char *name, *value;
} cli_given_t;

/// How often, and with what.
enum {
  CLI_ONCE = 0,  ///< a second time is a mistake
  CLI_AGAIN = 1, ///< may be given again; read decides what that means
  CLI_FLAG = 2   ///< takes no value
};

/// An option of a command. how: a sum of the above.
/// read: stores the value in args. Returns: CLI_DONE or another code
/// (complained), which ends the reading.
typedef struct {
  const char *name;
  int (*read)(void *args, const cli_given_t *given);
  unsigned how;
} cli_option_t;

/// What a command understands; no more than 64 options.
/// take: stores a word that stands alone. Returns: as read.
typedef struct {
  const char *command;
  const cli_option_t *options;
  size_t count;
  int (*take)(void *args, const char *word);
} cli_syntax_t;

/// Reads all words. "-" stands alone.
/// Returns: CLI_DONE, CLI_USAGE or what a reader returned (complained).
int cli_read_words(const cli_syntax_t *syntax, void *args, int argc,
                   char *const argv[]);

/// Stores the name of a file, which must not be empty.
/// Returns: CLI_DONE or CLI_USAGE (complained).
int cli_read_path(const cli_given_t *given, const char **out);

/// Stores a whole number in [low, high].
/// Returns: CLI_DONE or CLI_USAGE (complained).
int cli_read_count(const cli_given_t *given, uint64_t low, uint64_t high,
                   uint64_t *out);

#endif
