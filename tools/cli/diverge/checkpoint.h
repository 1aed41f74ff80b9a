/// @file
/// Where a shard of `diverge` stands, so that one that was stopped, even by
/// SIGKILL, goes on under --resume with the same bytes.
#ifndef TWOFOLD_CLI_CHECKPOINT_H
#define TWOFOLD_CLI_CHECKPOINT_H

#include "../setup/args.h"
#include "counts.h"
#include "files.h"

/// After a sample that has ended.
typedef struct {
  uint32_t run;    ///< as in the trailers
  uint32_t number; ///< bytes of a number of the build
  cli_shard_t shard;
  uint64_t samples; ///< of the shard, that have ended
  uint64_t cycles, outcomes[CLI_OUTCOMES];
  cli_file_place_t exits, returns;
} cli_checkpoint_t;

/// What --resume finds.
typedef enum {
  CLI_RESUME_NEW,   ///< nothing to go on with: from the first sample
  CLI_RESUME_GO_ON, ///< the checkpoint is read, and the rows are there
  CLI_RESUME_WHOLE, ///< all files are whole, of this shard
  CLI_RESUME_OTHER  ///< a file or a checkpoint is of another run; a message
} cli_resume_t;

/// Looks at the files of a shard and at its checkpoint. run: in, as in the
/// trailers. counts: out, NULL where cycles are not counted.
cli_resume_t cli_checkpoint_find(const cli_args_t *args, uint32_t run,
                                 cli_checkpoint_t *at, cli_counts_t *counts);

/// Writes it beside the first of the files; it replaces the one before at once.
/// Returns: whether it could be written.
bool cli_checkpoint_put(const cli_args_t *args, const cli_checkpoint_t *at,
                        const cli_counts_t *counts);

/// Removes it, of a shard that is whole.
void cli_checkpoint_remove(const cli_args_t *args);

#endif
