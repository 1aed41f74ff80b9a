/// @file
/// What every command of the host program shares: exit codes, complaints,
/// numbers in and out of text, and the closest name to a mistyped one.
///
/// The exit codes are part of the command line's contract, so they have one
/// home here and every failing path returns one of them by name.
#ifndef TWOFOLD_CLI_TEXT_H
#define TWOFOLD_CLI_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "twofold/real.h"

/// Exit codes of the program.
enum {
  CLI_DONE = 0,    ///< all that was asked for was done
  CLI_USAGE = 2,   ///< unknown command, option or name, or unreadable number
  CLI_REFUSED = 3, ///< a value was read but lies outside its range
  CLI_STOPPED = 4  ///< interrupted, refused by a step, or not writable
};

#if defined(__GNUC__)
#define CLI_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define CLI_PRINTF(text, first)
#endif

/// Writes "twofold: ", the message and a newline to standard error.
/// Returns: code, so that a failing path is one return statement.
int cli_complain(int code, const char *format, ...) CLI_PRINTF(2, 3);

/// Flushes standard output and says so when that fails.
/// Returns: CLI_DONE or CLI_STOPPED.
int cli_finish_stdout(void);

/// Reads the whole text as one number, rounded once to tf_real_t: decimal, C's
/// hexadecimal, nan or inf. That it is finite is left to its range.
/// why: out on failure, what is wrong with the text ("is not a number").
/// Returns: whether value was set.
bool cli_read_real(const char *text, tf_real_t *value, const char **why);

/// Reads the whole text as a decimal whole number in [low, high].
/// Returns: whether value was set.
bool cli_read_whole(const char *text, uint64_t low, uint64_t high,
                    uint64_t *value);

/// Room for any tf_real_t in decimal, with its terminating zero.
#define CLI_REAL_ROOM 40

/// Writes the shortest decimal that reads back to the same bits.
/// out: out, zero-terminated. value: in, finite.
/// Returns: the length without the zero.
size_t cli_write_real(char out[CLI_REAL_ROOM], tf_real_t value);

/// The same for a number of the type that is_float says, whatever the program
/// was built for.
size_t cli_write_number(char out[CLI_REAL_ROOM], double value, bool is_float);

/// Looks for the name closest to a mistyped word, one candidate at a time, so
/// that names may come from any table.
typedef struct {
  const char *word; ///< what was typed
  const char *name; ///< closest so far, NULL where none is close enough
  size_t distance;  ///< of name; candidates at or beyond it are left out
} cli_closest_t;

/// Starts a search. word: in, kept.
cli_closest_t cli_closest_to(const char *word);

/// Offers one candidate. name: in, kept if it is the closest.
void cli_closest_offer(cli_closest_t *closest, const char *name);

/// The end of a complaint: "; did you mean 'chaos'?" or nothing. The result is
/// two strings and a name between them, ready for "%s%s%s".
typedef struct {
  const char *before, *name, *after;
} cli_hint_t;
cli_hint_t cli_closest_hint(const cli_closest_t *closest);

#endif
