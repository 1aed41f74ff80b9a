// The command `merge`: files of `diverge --counts` become one. What is missing
// of the run is told, and not an error: a merged file can be merged again.

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../text/message.h"
#include "counts.h"
#include "diverge.h"

typedef struct {
  cli_counts_t sum, next;
  cli_output_t output;
} merge_t;

static int read_all(const cli_args_t *args, merge_t *merge) {
  int code = cli_counts_read(&merge->sum, args->files[0]);
  for (size_t i = 1; i < args->count && code == CLI_DONE; i++) {
    memset(&merge->next, 0, sizeof merge->next);
    code = cli_counts_read(&merge->next, args->files[i]);
    if (code == CLI_DONE) {
      code = cli_counts_add(&merge->sum, &merge->next, args->files[i]);
    }
  }
  return code;
}

int cli_merge(const cli_args_t *args) {
  merge_t *merge = calloc(1, sizeof *merge);
  if (merge == NULL) {
    return cli_message(CLI_STOPPED, "out of memory");
  }
  int code = read_all(args, merge);
  if (code == CLI_DONE) {
    code = cli_output_begin(&merge->output, "--out", args->out);
  }
  if (code == CLI_DONE) {
    (void)cli_counts_put(&merge->sum, &merge->output);
    code = cli_output_end(&merge->output, code);
  }
  if (code == CLI_DONE) {
    (void)fprintf(stderr, "shards     %" PRIu64 " of %" PRIu64 "\n",
                  cli_counts_shards(&merge->sum), merge->sum.of);
  }
  free(merge);
  return code;
}

int cli_merge_check(cli_args_t *args) {
  return args->count > 0
             ? CLI_DONE
             : cli_message(CLI_USAGE,
                           "merge: which files? ('twofold diverge --counts' "
                           "writes them)");
}
