/// @file
/// Cycles counted in integers: what is left of them where their rows would be
/// too many. Counts of shards add up to those of the whole, in any order.
#ifndef TWOFOLD_CLI_COUNTS_H
#define TWOFOLD_CLI_COUNTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "../host/output.h"
#include "../setup/args.h"
#include "../text/trailer.h"
#include "tracker.h"

#define CLI_COUNT_CYCLES 65536 ///< a sample may have, at most
#define CLI_COUNT_SHARDS 65536 ///< of a run, at most
#define CLI_COUNT_TIMES 4096   ///< bins of the patience
#define CLI_COUNT_PHASES 100   ///< bins of a winding
#define CLI_COUNT_PLACES 20000 ///< bins on each side of r = 0
#define CLI_COUNT_PLACE 1e-4   ///< their width [m]

/// Where the counts of each kind begin, in the order of a file.
enum {
  CLI_COUNT_OUTCOME = 0,
  CLI_COUNT_BEGUN = CLI_COUNT_OUTCOME + CLI_OUTCOMES,
  CLI_COUNT_RETURNED = CLI_COUNT_BEGUN + CLI_COUNT_CYCLES,
  CLI_COUNT_SIDE = CLI_COUNT_RETURNED + CLI_COUNT_CYCLES,
  CLI_COUNT_PHASE = CLI_COUNT_SIDE + 2,
  CLI_COUNT_TIME = CLI_COUNT_PHASE + CLI_COUNT_PHASES,
  CLI_COUNT_LANDING = CLI_COUNT_TIME + CLI_COUNT_TIMES,
  CLI_COUNT_CELLS = CLI_COUNT_LANDING + 2 * CLI_COUNT_PLACES + 1
};

#define CLI_COUNT_ABOUT 2048 ///< room for the comments before the header
typedef struct {
  char about[CLI_COUNT_ABOUT];       ///< lines with #: what the counts are of
  uint32_t run;                      ///< the same in all shards of a run
  uint64_t of;                       ///< shards of the run
  uint8_t has[CLI_COUNT_SHARDS / 8]; ///< bit I - 1: shard I is counted
  uint64_t cell[CLI_COUNT_CELLS];
} cli_counts_t;

/// Names a shard as one of those that are counted. Returns: whether it was not
/// there before.
bool cli_counts_shard(cli_counts_t *counts, uint64_t index);

/// How many shards are counted.
uint64_t cli_counts_shards(const cli_counts_t *counts);

/// Counts a cycle. cycle: in, its number in its sample, from 1. patience: in,
/// of the run [s].
void cli_counts_cycle(cli_counts_t *counts, uint64_t cycle,
                      const cli_cycle_t *what, double patience);

/// Writes the whole file: comments, the shards, `what,key,count` and a row for
/// each count that is not 0, and the number and checksum of these lines.
/// Returns: whether it could be written.
bool cli_counts_put(const cli_counts_t *counts, cli_output_t *output);

/// Reads such a file; counts is all 0 before. name: in, for messages.
int cli_counts_read(cli_counts_t *counts, const char *name);

/// Adds the counts of other shards of the same run. name: in, of the file that
/// `more` was read from.
int cli_counts_add(cli_counts_t *counts, const cli_counts_t *more,
                   const char *name);

#endif
