/// What `diverge` writes: the files --exits and --returns, and where they
/// stand; and cycles counted in integers, which is what is left of them where
/// their rows would be too many. Counts of shards add up to those of the whole,
/// in any order.
#pragma once

#include "../host/output.h"
#include "motion.h"

#define CLI_COUNT_CYCLES 65536 ///< a sample may have, at most
#define CLI_COUNT_SHARDS 65536 ///< of a run, at most
#define CLI_COUNT_TIMES 4096   ///< bins of the patience
#define CLI_COUNT_PHASES 100   ///< bins of a winding
#define CLI_COUNT_PLACES 20000 ///< bins on each side of r = 0
#define CLI_COUNT_PLACE 1e-4   ///< their width [m]

#define CLI_COUNT_CELLS                                         \
  (CLI_OUTCOMES + 2 * CLI_COUNT_CYCLES + 2 + CLI_COUNT_PHASES + \
   CLI_COUNT_TIMES + 2 * CLI_COUNT_PLACES + 1)

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

/// How far a file of rows is written.
typedef struct {
  uint64_t bytes, rows;
  uint32_t crc;   ///< as in the trailer
  uint32_t about; ///< the same over what the trailer leaves out, comments
} cli_file_place_t;

typedef struct {
  cli_output_t output;
  cli_trailer_t trailer;
  uint32_t about; ///< as in the place
  uint64_t bytes;
  bool is_open, is_whole; ///< is_whole: FILE is there, and stays
} cli_diverge_file_t;

enum { CLI_EXITS, CLI_RETURNS, CLI_FILES };
typedef struct {
  const cli_job_t *job;
  uint32_t run; ///< for the trailers
  cli_diverge_file_t file[CLI_FILES];
  cli_counts_t counts; ///< of --counts
  cli_output_t counted;
  bool counts_are_open;
} cli_files_t;

/// Opens all that were asked for, and goes on behind these places; behind
/// bytes = 0 with the header.
/// Returns: CLI_DONE; after a message CLI_STOPPED, and no new file is left.
int cli_files_open(cli_files_t *files, const cli_file_place_t at[CLI_FILES]);

/// Returns: whether everything so far could be written.
bool cli_files_put(cli_files_t *files, uint64_t sample, uint64_t cycle,
                   const cli_cycle_t *what);

bool cli_files_flush(cli_files_t *files);

/// Closes all after a run that ended with a code; under CLI_DONE they get their
/// trailer and their name.
/// Returns: the code; CLI_STOPPED after a message if it was CLI_DONE.
int cli_files_close(cli_files_t *files, int code);

// Where a shard of `diverge` stands, so that one that was stopped, even by
// SIGKILL, goes on under --resume with the same bytes.

/// After a sample that has ended.
typedef struct {
  uint32_t run;   ///< as in the trailers
  uint32_t build; ///< checksum of cli_commit
  cli_shard_t shard;
  uint64_t samples; ///< of the shard, that have ended
  uint64_t cycles, outcomes[CLI_OUTCOMES];
  cli_file_place_t at[CLI_FILES];
} cli_checkpoint_t;

typedef enum {
  CLI_RESUME_NEW,   ///< nothing to go on with: from the first sample
  CLI_RESUME_GO_ON, ///< the checkpoint is read, and the rows are there
  CLI_RESUME_WHOLE, ///< all files are whole, of this shard
  CLI_RESUME_OTHER  ///< a file or a checkpoint is of another run; a message
} cli_resume_t;

/// Looks at the files of a shard and at its checkpoint, which gives the counts,
/// too. at: in, run, number and shard; out, those of the checkpoint.
cli_resume_t cli_checkpoint_find(cli_files_t *files, cli_checkpoint_t *at);

/// Writes it beside the first of the files, with the places of the rows; it
/// replaces the one before at once. Returns: whether it could be written.
bool cli_checkpoint_put(const cli_files_t *files, cli_checkpoint_t *at);

void cli_checkpoint_remove(const cli_files_t *files);
