/// @file
/// The two files of `diverge`: --exits and --returns.
#ifndef TWOFOLD_CLI_FILES_H
#define TWOFOLD_CLI_FILES_H

#include "../host/output.h"
#include "../text/buffer.h"
#include "../text/trailer.h"
#include "job.h"
#include "tracker.h"

/// How far a file of rows is written.
typedef struct {
  uint64_t bytes, rows;
  uint32_t crc; ///< as in the trailer
} cli_file_place_t;

typedef struct {
  cli_output_t output;
  cli_trailer_t trailer;
  uint64_t bytes;
  bool is_open;
} cli_diverge_file_t;

typedef struct {
  cli_diverge_file_t exits, returns;
  cli_shard_t shard; ///< for the trailers
} cli_files_t;

/// Opens both, and goes on behind these places; behind bytes = 0 with the
/// header. run: in, a text that all shards of the run share.
/// Returns: CLI_DONE; after a message CLI_STOPPED, and no new file is left.
int cli_files_open(cli_files_t *files, const cli_job_t *job,
                   const cli_buffer_t *run, const cli_file_place_t *exits,
                   const cli_file_place_t *returns);

/// How far a file is.
cli_file_place_t cli_file_place(const cli_diverge_file_t *file);

/// Writes the rows of a cycle.
/// Returns: whether everything so far could be written.
bool cli_files_put(cli_files_t *files, uint64_t sample, uint64_t cycle,
                   const cli_cycle_t *what);

/// Hands everything to the operating system. Returns: as cli_files_put.
bool cli_files_flush(cli_files_t *files);

/// Closes both after a run that ended with a code; under CLI_DONE both get
/// their trailer and their name.
/// Returns: the code; CLI_STOPPED after a message if it was CLI_DONE.
int cli_files_close(cli_files_t *files, int code);

#endif
