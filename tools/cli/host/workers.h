/// Processes that share a work whose pieces are taken in turn: piece k is done
/// by process k modulo their number, and comes through its pipe. They end with
/// the program, whatever ends it.
#pragma once

#include "host.h"

#define CLI_JOBS 1024 ///< processes, at most

typedef struct {
  unsigned count;
  int process[CLI_JOBS], from[CLI_JOBS]; ///< and the pipe that it fills
} cli_workers_t;

/// Processors that this program may use.
unsigned cli_processors(void);

/// Starts `count` processes, in which `work` is called and then nothing else.
/// It gets what it is given, the number of the process and a pipe.
int cli_workers_start(cli_workers_t *workers, unsigned count,
                      void (*work)(void *with, unsigned worker, int to),
                      void *with);

/// Writes to a pipe. Returns: whether there is still a reader.
bool cli_pipe_write(int to, const void *bytes, size_t length);

/// Waits for bytes of a process. Returns: whether all came; not where a stop is
/// asked for.
bool cli_workers_read(const cli_workers_t *workers, unsigned worker, void *to,
                      size_t length);

/// Ends all of them.
void cli_workers_end(cli_workers_t *workers);
