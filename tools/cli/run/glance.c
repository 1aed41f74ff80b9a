#include "glance.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#define COLUMNS 6 // a terminal of 80 columns has no room for F and M

static bool put(cli_output_t *output, const char *line) {
  return cli_output_lines(output, line, strlen(line));
}

bool cli_glance_row(cli_glance_t *glance, const cli_csv_t *row,
                    cli_output_t *output) {
  char *line = glance->last[glance->rows % CLI_GLANCE];
  size_t used = 0;
  for (size_t i = 0; i < COLUMNS; i++) {
    used += (size_t)snprintf(line + used, CLI_GLANCE_ROOM - used, "%11.4g",
                             row->column[i]);
  }
  (void)snprintf(line + used, CLI_GLANCE_ROOM - used, " %-6s %u\n",
                 tf_mode_name(row->mode), row->choices);
  glance->rows++;
  return glance->rows > CLI_GLANCE || put(output, line);
}

bool cli_glance_begin(cli_output_t *output) {
  return put(output,
             "       t[s]       r[m]     v[m/s] omega[/s]     h[m/s]  "
             "   g[m/s] mode   choices\n");
}

bool cli_glance_end(cli_glance_t *glance, cli_output_t *output) {
  const uint64_t rows = glance->rows;
  const uint64_t left = rows > CLI_GLANCE ? rows - CLI_GLANCE : 0;
  const uint64_t shown = left < CLI_GLANCE ? left : CLI_GLANCE;
  bool good = left == shown || put(output, "        ...\n");
  for (uint64_t i = rows - shown; good && i < rows; i++) {
    good = put(output, glance->last[i % CLI_GLANCE]);
  }
  char line[CLI_GLANCE_ROOM];
  (void)snprintf(line, sizeof line,
                 "%" PRIu64
                 " rows; all of them, with all digits: --out FILE, "
                 "or into a pipe.\n\n",
                 rows);
  return good && put(output, line);
}
