// A grid, row by row. Rows reach the file whole.

#include "grid.h"

#include <string.h>

#include "../host/host.h"
#include "../host/progress.h"
#include "../setup/provenance.h"
#include "../text/message.h"

#define FLUSH_EVERY 0.2 // [s]

// The rows of one r, the one with number i.
static int write_line(cli_analysis_t *a, uint64_t i, cli_grid_row_t row,
                      cli_progress_t *progress) {
  const tf_real_t r = cli_range_at(&a->r, i);
  char text[CLI_GRID_ROOM];
  for (uint64_t j = 0; j < a->omega.count; j++) {
    size_t length = 0;
    if (cli_stop_asked()) {
      return cli_message(CLI_STOPPED, "interrupted at r = %g m", (double)r);
    }
    const int code = row(a, r, cli_range_at(&a->omega, j), text, &length);
    if (code != CLI_DONE) {
      return code;
    }
    if (!cli_output_lines(&a->output, text, length)) {
      return CLI_STOPPED; // the message is that of cli_output_end
    }
    const double now = cli_now();
    if (now - a->output.flushed >= FLUSH_EVERY) {
      (void)cli_output_flush(&a->output);
    }
    if (cli_progress_due(progress, now)) {
      const double done = (double)i * (double)a->omega.count + (double)(j + 1);
      const double points = (double)a->r.count * (double)a->omega.count;
      cli_progress_say(progress, now, done / points, "%.0f of %.0f points",
                       done, points);
    }
  }
  return CLI_DONE;
}

int cli_analysis_grid(cli_analysis_t *a, const char *header, const char *units,
                      cli_grid_row_t row) {
  char lines[CLI_PROVENANCE_ROOM];
  int code = cli_output_begin(&a->output, "--out", a->out);
  if (code != CLI_DONE) {
    return code;
  }
  if (a->provenance) {
    const size_t length =
        cli_provenance(&a->setup, "inputs at t = 0, no motion", units, lines);
    (void)cli_output_lines(&a->output, lines, length);
  }
  (void)cli_output_lines(&a->output, header, strlen(header));
  cli_progress_t progress =
      cli_progress_start(cli_now(), a->output.to.descriptor);
  for (uint64_t i = 0; i < a->r.count && code == CLI_DONE; i++) {
    code = write_line(a, i, row, &progress);
  }
  cli_progress_clear(&progress);
  return cli_output_end(&a->output, code);
}
