/// Exit codes and messages of the program, and the known name closest to a
/// mistyped one, with which a message ends.
///
/// In all of these folders an int that a function returns is one of the codes,
/// after a message if it is not CLI_DONE, and a size_t is the length of what
/// was written; a header says where it is something else, or more than that.
#pragma once

#include <stddef.h>

enum {
  CLI_DONE = 0,    ///< everything asked for was done
  CLI_USAGE = 2,   ///< unknown command, option or name, or unreadable number
  CLI_REFUSED = 3, ///< a value was read but lies outside its range
  CLI_STOPPED = 4, ///< interrupted, refused by a step, or not writable
  CLI_FLAGGED = 5, ///< all was done, and some steps said that they cannot be
                   ///< trusted to their bound: degraded, coarse or stalled
  CLI_DAMAGED = 6  ///< all that came was read, and frames were lost or broken,
                   ///< or are not those of one whole run, or a value is not
                   ///< finite
};

#if defined(__GNUC__)
#define CLI_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define CLI_PRINTF(text, first)
#endif

/// Writes "twofold: ", the message and a newline to standard error.
/// Returns: code, so that a failing path is a single return statement.
int cli_message(int code, const char *format, ...) CLI_PRINTF(2, 3);

/// Leaves the function with the code of a call where that is not CLI_DONE.
#define CLI_TRY(call)                            \
  do {                                           \
    const int cli_tried = (call);                \
    if (cli_tried != CLI_DONE) return cli_tried; \
  } while (0)

/// The last message of a code other than CLI_DONE, cut off where it is long;
/// empty: there was none.
const char *cli_last_message(void);

/// From now on a message is appended to the text in `out`, kept, without
/// "twofold: ", in lines; NULL: standard error again. Cut off at room.
void cli_message_divert(char *out, size_t room);

int cli_finish_stdout(void);

#define CLI_CLOSEST_LONGEST 24 ///< longer words are not compared

/// A search for the closest name. Candidates come from any table.
typedef struct {
  const char *word; ///< what was typed
  size_t distance;  ///< a candidate has to be closer than this
  char hint[CLI_CLOSEST_LONGEST + 24]; ///< see below
} cli_closest_t;

/// Starts a search. word: in, kept.
cli_closest_t cli_closest_to(const char *word);

/// Offers one candidate. The hint is the end of an error message,
/// "; did you mean 'chaos'?", or empty.
void cli_closest_offer(cli_closest_t *closest, const char *name);

/// Looks for the word in a table of `count` rows of `bytes` bytes, each of
/// which begins with a const char *, its name, and offers all names before it.
/// Returns: the number of the row, count: there is none.
size_t cli_closest_find(cli_closest_t *closest, const void *table, size_t count,
                        size_t bytes);

/// The commit of this program: its short hash, with "-dirty" behind it where
/// files had been changed, or "unknown" where it was not compiled in a git work
/// tree; then "-" and the checksum of its sources, by cksum.
extern const char *const cli_commit;

#ifdef TF_REAL_FLOAT
#define CLI_NUMBER_TYPE "float"
#else
#define CLI_NUMBER_TYPE "double"
#endif
