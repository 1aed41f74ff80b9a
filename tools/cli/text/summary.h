/// What the summaries of the commands share: members of an object of JSON on
/// standard error; and which steps are not to be trusted.
#pragma once

#include "text.h"
#include "twofold/simulation.h"

/// Prints on standard error, as printf does.
void cli_say(const char *format, ...) CLI_PRINTF(1, 2);

/// Begins a summary: version, commit and number type of this program, and the
/// command.
void cli_put_begin(const char *command);

/// Appends JSON by a form, in which ' stands for ", %s for a text in quotes
/// (it may be one from outside: the path of a file, what a board says of
/// itself), %g for a number of the real type of this program, %f for a double,
/// %x for 32 bits as eight hexadecimal digits in quotes, %u, %zu and PRIu64 for
/// counts. NULL and what is not finite are null. There are no others.
void cli_add_json(cli_buffer_t *text, const char *form, ...) CLI_PRINTF(2, 3);

/// The same on standard error.
void cli_put(const char *form, ...) CLI_PRINTF(1, 2);

/// The member by which every summary ends, the brace and a newline.
/// code: in, the exit code.
void cli_put_exit(int code);

/// The same after the time that the work took [s], and what was done in it a
/// second.
void cli_put_end(double done, double seconds, int code);

bool cli_put_ended(void);

/// How many steps it counts that were taken with a reservation.
uint64_t cli_tally_reserved(const tf_tally_t *tally);

/// Puts its counts into a summary in JSON.
void cli_tally_put(const tf_tally_t *tally);

/// Prints the line `degraded` of a summary to standard error.
/// since: in, what is known of the first of these steps: "first", or "first
/// reported". t: in, when that was [s]; NAN: not known, and not told.
void cli_tally_print(const tf_tally_t *tally, const char *since, double t);

/// Returns: CLI_FLAGGED where some steps were degraded, coarse or stalled, else
/// CLI_DONE.
int cli_tally_code(const tf_tally_t *tally);
