/// @file
/// A command line: which command it is, reading it, performing it; and the help
/// that the tables of commands and options make.
#ifndef TWOFOLD_CLI_COMMAND_H
#define TWOFOLD_CLI_COMMAND_H

#include <stdbool.h>

#include "setup/args.h"
#include "text/message.h"
#include "text/options.h"

// The tables of the options (table.c) and of the commands (commands.c), from
// which come the reading of command lines, the help and the completions.

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

/// Performs a command line: argv[0] is the first word after the program's name.
int cli_command(int argc, char *const argv[]);

/// The command of a name, NULL: there is none.
const cli_command_t *cli_find_command(const char *name);

/// Reads and checks the words behind a command that takes options. No file that
/// is written, nor the `.part` or `.resume` beside it, may be one that another
/// option or a positional argument names.
/// args: out; its files are from the heap, whatever is returned.
int cli_read_args(const cli_command_t *command, cli_args_t *args, int argc,
                  char *const argv[]);

/// `twofold help [COMMAND|WORD]`.
int cli_help(int argc, char *const argv[]);

/// `twofold completions bash|zsh|fish`: prints the script of a shell.
int cli_completions(int argc, char *const argv[]);

/// `twofold scenes`: one line per scene.
int cli_scenes(int argc, char *const argv[]);

/// What the codes of all commands mean.
#define CLI_EXIT_CODES                                                        \
  "Exit codes: 0 done, 2 usage, 3 parameter refused, 4 stopped, 5 done, but " \
  "some steps were degraded, coarse or stalled, 6 done, but frames of a "     \
  "stream were lost or broken, or a value in it is not finite."

/// Prints text in lines of at most 79 columns. A line that begins with a blank
/// is printed as it is. first: in, columns of the first line that are in use.
/// margin: in, columns before each other one.
void cli_print_filled(const char *text, size_t first, size_t margin);

/// Prints one line per command.
void cli_print_overview(void);

/// Prints the help of a command.
void cli_print_page(const cli_command_t *command);

/// Prints what an option (its name without the dashes) or a word of its values
/// is. Returns: whether there is any.
bool cli_print_option(const char *word);

/// `twofold --version`.
int cli_print_version(void);

// Help on single words: parameters, columns, modes, laws, rules, schemes,
// formats, options, scenes, files.

/// Prints what there is to say about a word.
/// Returns: whether there is something.
bool cli_topic(const char *word);

/// Offers all words to a search for the closest one.
void cli_topics_offer(cli_closest_t *closest);

#endif
