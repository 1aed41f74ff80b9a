/// Options as rows of a table, from which come the reading of command lines
/// (here), the help and the completions. The same in every command: `--name
/// value` or `--name=value`, before or after the positional arguments.
#pragma once

#include "message.h"
#include "number.h"

/// An option as typed. value: "" where it takes none.
typedef struct {
  const char *name, *value;
} cli_given_t;

/// What the value of an option is, and so the type of the member it goes to.
typedef enum {
  CLI_FLAG,   ///< none: bool
  CLI_TEXT,   ///< any text: const char *
  CLI_PATH,   ///< the name of a file, not empty: const char *
  CLI_WHOLE,  ///< a whole number in [low, high]: uint64_t
  CLI_REAL,   ///< a number in [low, high]: double
  CLI_NUMBER, ///< one number, [low, high] where low < high: cli_range_t
  CLI_RANGE,  ///< A:B:N, both in [low, high]: cli_range_t
  CLI_CHOICE, ///< one of `choices`: unsigned, its place among them
  CLI_OTHER   ///< what `read` makes of it
} cli_kind_t;

/// How an option may be given, as bits. Without any: once.
enum {
  CLI_REPEATABLE = 1, ///< any number of times
  CLI_WRITES = 2,     ///< the value is a file that is written
  CLI_READS = 4,      ///< the value is a file that is read
  CLI_OPEN = 8        ///< low itself is out of range
};

/// A word that a value may be, and what it means, "": told elsewhere. A list
/// ends with a name of NULL.
typedef struct {
  const char *name, *what;
} cli_choice_t;

/// A row of the table; without a name: the heading of the rows after it.
typedef struct {
  const char *name;  ///< with its dashes
  const char *value; ///< what stands for the value in the help
  unsigned commands; ///< bits: the commands that take it
  cli_kind_t kind;   ///< of the value ...
  size_t member;     ///< ... and where it goes, an offset in the arguments
  const char *what;  ///< for the help
  double low, high, usual; ///< usual: the value where it is not given
  const char *unit;        ///< of the range, NULL: none
  const char *noun;        ///< of choices, for messages; NULL: "must be"
  const char *needs;       ///< name of an option without which it is refused
  /// Of CLI_TEXT: it begins with one of them, up to its end or a colon.
  const cli_choice_t *choices;
  int (*read)(void *args, const cli_given_t *given); ///< of CLI_OTHER
  unsigned how;                                      ///< of the bits above
} cli_option_t;

#define CLI_ROWS 128             ///< of a table, at most
#define CLI_NOT_GIVEN UINT32_MAX ///< usual place of a choice without one

/// A table and a command. take: stores a positional argument.
typedef struct {
  const cli_option_t *options;
  size_t count;
  const char *command; ///< its name
  unsigned bit;        ///< its bit
  int (*take)(void *args, const char *word);
} cli_syntax_t;

/// Sets the usual values of all numbers and choices.
void cli_usual_values(const cli_syntax_t *syntax, void *args);

/// A file that a command line names. how: CLI_WRITES, CLI_READS, or 0: none;
/// the name of a built-in scene is none.
typedef struct {
  cli_given_t given;
  unsigned how;
} cli_file_t;

/// Reads all words. "-" is a positional argument. files: out, argc at most, all
/// 0 before: those that are named.
int cli_read_words(const cli_syntax_t *syntax, void *args, int argc,
                   char *const argv[], cli_file_t *files);
