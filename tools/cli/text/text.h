/// Text in and out: exit codes and messages, the known name closest to a
/// mistyped one, numbers, buffers, and files line by line.
///
/// In all of these folders an int that a function returns is one of the codes,
/// after a message if it is not CLI_DONE, and a size_t is the length of what
/// was written; a header says where it is something else, or more than that.
#pragma once

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../decimal.h"
#include "twofold/real.h"

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
#define cli_usage(...) cli_message(CLI_USAGE, __VA_ARGS__)
#define cli_refuse(...) cli_message(CLI_REFUSED, __VA_ARGS__)
#define cli_stop(...) cli_message(CLI_STOPPED, __VA_ARGS__)
#define cli_note(...) (void)cli_message(CLI_DONE, "note: " __VA_ARGS__)

/// What was given, as typed: an option and its value, "" where it takes none;
/// or the place of a line ("PATH:LINE:") and its key.
typedef struct {
  const char *name, *value;
} cli_given_t;

/// A message about what was given, with both of it before the text.
int cli_blame(int code, const cli_given_t *given, const char *format, ...)
    CLI_PRINTF(3, 4);

/// From now on there are no messages of CLI_DONE, nor summaries but as JSON.
void cli_be_quiet(bool from_now);
bool cli_is_quiet(void);

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

/// The commit of this program: its short hash, with "-dirty" behind it where
/// files had been changed, or "unknown" where it was not compiled in a git work
/// tree; then "-" and the checksum of its sources, by cksum.
extern const char *const cli_commit;

#ifdef TF_REAL_FLOAT
#define CLI_NUMBER_TYPE "float"
#else
#define CLI_NUMBER_TYPE "double"
#endif

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

/// Reads the whole text as one number, rounded once to tf_real_t: decimal, C's
/// hexadecimal, nan or inf. Whether it lies in its range is checked later.
/// why: out on failure, what is wrong with the text ("is not a number").
/// Returns: whether value was set.
bool cli_read_real(const char *text, tf_real_t *value, const char **why);

/// Reads the whole text as a decimal integer in [low, high].
/// Returns: whether value was set.
bool cli_read_whole(const char *text, uint64_t low, uint64_t high,
                    uint64_t *value);

/// Room for any tf_real_t in decimal, with its terminating zero.
#define CLI_REAL_ROOM DECIMAL_ROOM

/// Writes it as decimal_write does.
size_t cli_write_real(char out[CLI_REAL_ROOM], tf_real_t value);

/// Reads a number that stands in what was given.
int cli_read_number(const cli_given_t *given, const char *text,
                    tf_real_t *value);

#define CLI_NOT_GIVEN UINT32_MAX ///< usual value of a choice without one

/// A value, or N of them from A to B, both included.
typedef struct {
  const char *text; ///< as typed, NULL: not given
  double from, to;  ///< of tf_real_t, or exact
  uint64_t count;
} cli_range_t;

/// Reads A:B:N, N in [1, most], from text, which stands in what was given.
/// exact: in, of whole numbers that a float may not have.
int cli_read_range(const cli_given_t *given, const char *text, uint64_t most,
                   bool exact, cli_range_t *range);

/// Value i of a range, i in [0, count - 1]: A and B themselves at its ends.
double cli_range_at(const cli_range_t *range, uint64_t i);

/// A part of the work, index from 1 to of. All of it is shard 1 of 1.
typedef struct {
  uint64_t index, of;
} cli_shard_t;

/// The CRC-32 of zlib. before: in, that of the bytes before these, 0: none.
uint32_t cli_crc(uint32_t before, const void *bytes, size_t length);

/// A buffer of the caller, to which text is appended. It always ends with a
/// zero. What does not fit is left out, and truncated is set.
typedef struct {
  char *text;
  size_t used, room;
  bool truncated;
} cli_buffer_t;

void cli_add(cli_buffer_t *buffer, const char *text);

/// Appends a form, in which %s stands for a text, %g for a number of the real
/// type of this program, PRIu64 and %u for counts, %08x for 32
/// bits. There are no others.
void cli_add_form(cli_buffer_t *buffer, const char *form, ...) CLI_PRINTF(2, 3);

void cli_add_real(cli_buffer_t *buffer, tf_real_t value);
void cli_add_count(cli_buffer_t *buffer, uint64_t value);

/// A float (is_float) or a double, whichever type this program was built for.
void cli_add_number(cli_buffer_t *buffer, double value, bool is_float);

/// Makes room for one more in a list from the heap, of `used` members of `size`
/// bytes each. room: in/out, members that it has room for.
/// Returns: the list, which may have moved; NULL: no memory, it is as it was.
void *cli_grow(void *list, size_t used, size_t *room, size_t size);

/// Reads a file, or standard input where path is "-".
/// option: in, for the message: that of the path with a blank, or "".
/// most: bytes; a longer file may be cut off, but not to fewer.
/// text: out, from the heap, with a zero behind it; NULL after a message.
/// Returns: CLI_DONE, CLI_USAGE, or CLI_STOPPED: no memory.
int cli_read_text(const char *option, const char *path, size_t most,
                  char **text, size_t *size);

/// A text that is read line by line, and where. Nothing of it is left out:
/// fgets would hide what follows a zero.
typedef struct {
  const char *name;   ///< of the file, kept, for messages
  const char *text;   ///< what is still to be read
  size_t size;        ///< of that
  unsigned long line; ///< number of the present line, from 1
  size_t length;      ///< of that, without its end: \n or \r\n
  bool open;          ///< it has no \n: a number there may be cut off
} cli_lines_t;

/// Reads the next line, the first without the mark of UTF-8 (U+FEFF) by which
/// Windows programs begin a text file.
/// out: out, room bytes, zero-terminated: as much of the line as fits.
/// Returns: whether there is one.
bool cli_next_line(cli_lines_t *lines, char *out, size_t room);

/// Warns that the last line has no newline. Returns: CLI_DONE.
int cli_note_open(const char *name);

/// Takes blanks from both ends of a text.
char *cli_trim(char *text);
