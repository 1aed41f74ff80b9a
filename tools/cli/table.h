/// @file
/// The tables of the options (table.c) and of the commands (commands.c), from
/// which come the reading of command lines, the help and the completions.
#ifndef TWOFOLD_CLI_TABLE_H
#define TWOFOLD_CLI_TABLE_H

#include "setup/args.h"
#include "text/options.h"

/// Commands that take options.
enum {
  CLI_SCENE = 1,
  CLI_RUN = 2,
  CLI_MONITOR = 4,
  CLI_SINGULARITIES = 8,
  CLI_REGIONS = 16,
  CLI_DESIGN = 32,
  CLI_ATLAS = 64,
  CLI_DIVERGE = 128,
  CLI_MERGE = 256,
  CLI_SWEEP = 512
};

extern const cli_option_t cli_options[];
extern const size_t cli_option_count;

/// A command. Either it takes options (bit, take, check, perform), or it reads
/// its words itself (raw).
typedef struct {
  const char *name;
  const char *words;  ///< behind the name, as the help shows them
  const char *what;   ///< a line of the overview
  const char *about;  ///< the help before the options
  const char *notes;  ///< and behind them
  void (*tail)(void); ///< prints what follows those, NULL: nothing
  unsigned bit;       ///< in the table of the options
  /// Takes a positional argument. Returns: CLI_DONE, or another code after a
  /// message, as the functions that follow.
  int (*take)(void *args, const char *word);
  /// Options that need or exclude each other. NULL: all go together.
  int (*check)(cli_args_t *args);
  int (*perform)(const cli_args_t *args);
  int (*raw)(int argc, char *const argv[]);
} cli_command_t;

extern const cli_command_t cli_commands[];
extern const size_t cli_command_count;

#endif
