/// Commands and their options as rows of tables, from which come the reading of
/// command lines, help, manual and completions. Options are the same in every
/// command: `--name value` or `--name=value`, before or after the positional
/// arguments.
#pragma once

#include "setup/args.h"

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
  CLI_SWEEP = 256,
  CLI_TYRE = 512
};

/// What the value of an option is, and so the type of the member it goes to.
typedef enum {
  CLI_FLAG,     ///< none: bool
  CLI_WORD,     ///< one of `choices`, to its end or a colon: const char *
  CLI_READS,    ///< the name of a file that is read: const char *
  CLI_WRITES,   ///< the name of a file that is written: const char *
  CLI_WHOLE,    ///< a whole number in [low, high]: uint64_t
  CLI_REAL,     ///< a number in [low, high]: double
  CLI_POSITIVE, ///< a number in (0, high]: double
  CLI_NUMBER,   ///< one number, [low, high] where low < high: cli_range_t
  CLI_RANGE,    ///< A:B:N, both in [low, high]: cli_range_t
  CLI_CHOICE,   ///< one of `choices`: unsigned, its place among them
  CLI_OTHER     ///< what `read` makes of it
} cli_kind_t;

/// A word that a value may be, and what it means, or "". A list
/// ends with a name of NULL.
typedef struct {
  const char *name, *what;
} cli_choice_t;

/// A row of the table.
typedef struct {
  const char *name;  ///< with its dashes
  const char *value; ///< what stands for the value in the help
  unsigned commands; ///< bits: the commands that take it
  cli_kind_t kind;   ///< of the value ...
  size_t member;     ///< ... and where it goes, an offset in the arguments
  int (*read)(cli_args_t *args, const cli_given_t *given); ///< of CLI_OTHER
  double low, high, usual; ///< usual: the value where it is not given
  const char *what;        ///< for the help
  const char *unit;        ///< of the range, NULL: none
  const cli_choice_t *choices;
  const char *noun;   ///< of choices, for messages; NULL: "must be"
  const char *needs;  ///< name of an option without which it is refused
  bool is_repeatable; ///< may be given more than once
  char letter;        ///< of its short name: -o FILE, -oFILE; 0: it has none
} cli_option_t;

/// The table of all options: table.c.
extern const cli_option_t cli_options[];
extern const size_t cli_option_count;

/// A command; its page is in help.txt. Either it takes options (bit, of_source,
/// check, perform), or it reads its words itself (raw).
typedef struct {
  const char *name;
  const char *words; ///< behind the name, as the help shows them
  const char *what;  ///< a line of the overview
  unsigned bit;      ///< in the table of the options
  bool of_source;    ///< its positional argument is a source, else a scene
  /// Options that need or exclude each other. NULL: all go together.
  int (*check)(cli_args_t *args);
  int (*perform)(const cli_args_t *args);
  int (*raw)(int argc, char *const argv[]);
} cli_command_t;

/// The table of all commands: command.c.
extern const cli_command_t cli_commands[];
extern const size_t cli_command_count;

/// The command of a name, NULL: there is none.
const cli_command_t *cli_find_command(cli_closest_t *closest);

static inline bool cli_takes(const cli_command_t *command,
                             const cli_option_t *option) {
  return (option->commands & command->bit) != 0;
}

/// Reads the words of a command that takes options, "-" as a positional
/// argument. What was not given gets its usual value.
int cli_read_words(const cli_command_t *command, cli_args_t *args, int argc,
                   char *const argv[]);

int cli_help(int argc, char *const argv[]);
int cli_completions(int argc, char *const argv[]);

/// Prints what may stand behind words, for the scripts of the completions.
int cli_complete(int argc, char *const argv[]);
