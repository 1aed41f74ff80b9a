// The two files are opened together, after everything that could be refused has
// been checked. If the second cannot be opened, the first one is removed again
// if it is empty.

#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#endif

#include "files.h"

#include <sys/stat.h>
#include <unistd.h>

#include "../text/message.h"
#include "rows.h"

static void remove_if_empty(const char *path) {
  struct stat status;
  if (stat(path, &status) == 0 && S_ISREG(status.st_mode) &&
      status.st_size == 0) {
    (void)unlink(path);
  }
}

int cli_files_open(cli_files_t *files, const cli_diverge_args_t *args) {
  char text[CLI_DIVERGE_ROW];
  const bool header = args->header || args->shard == 1;
  files->has_exits = args->exits != NULL;
  files->has_returns = args->returns != NULL;
  int code = CLI_DONE;
  if (args->exits != NULL) {
    code = cli_output_begin(&files->exits, "--exits", args->exits);
  }
  if (code != CLI_DONE) {
    return code;
  }
  if (args->returns != NULL) {
    code = cli_output_begin(&files->returns, "--returns", args->returns);
  }
  if (code != CLI_DONE) {
    if (args->exits != NULL) {
      (void)cli_output_close(&files->exits);
      remove_if_empty(args->exits);
    }
    return code;
  }
  if (header && files->has_exits) {
    (void)cli_output_lines(&files->exits, text, cli_exit_header(text));
  }
  if (header && files->has_returns) {
    (void)cli_output_lines(&files->returns, text, cli_return_header(text));
  }
  return CLI_DONE;
}

bool cli_files_put(cli_files_t *files, uint64_t sample, uint64_t cycle,
                   const cli_cycle_t *what) {
  char text[CLI_DIVERGE_ROW];
  bool written = true;
  if (files->has_exits) {
    const size_t length = cli_exit_row(text, sample, cycle, what);
    written = cli_output_lines(&files->exits, text, length) && written;
  }
  if (files->has_returns) {
    const size_t length = cli_return_row(text, sample, cycle, what);
    written = cli_output_lines(&files->returns, text, length) && written;
  }
  return written;
}

bool cli_files_flush(cli_files_t *files) {
  const bool exits = !files->has_exits || cli_output_flush(&files->exits);
  const bool returns = !files->has_returns || cli_output_flush(&files->returns);
  return exits && returns;
}

int cli_files_close(cli_files_t *files) {
  const int exits = files->has_exits ? cli_output_end(&files->exits) : CLI_DONE;
  const int returns =
      files->has_returns ? cli_output_end(&files->returns) : CLI_DONE;
  return exits != CLI_DONE ? exits : returns;
}
