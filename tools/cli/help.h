/// @file
/// The help that the tables of commands and options make.
#ifndef TWOFOLD_CLI_HELP_H
#define TWOFOLD_CLI_HELP_H

#include <stdbool.h>

#include "table.h"
#include "text/closest.h"

/// What the codes of all commands mean.
#define CLI_EXIT_CODES                                                         \
  "Exit codes: 0 done, 2 usage, 3 parameter refused, 4 stopped, 5 done, but "  \
  "some steps were degraded or missed their tolerance, 6 done, but frames of " \
  "a stream were lost or broken, or a value in it is not finite."

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
