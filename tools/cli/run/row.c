// The formats of a row. Scripts rely on the columns of the CSV, so no column is
// ever appended. The plotter format is the one that the serial plotter of the
// Arduino IDE draws: label:value pairs on one line, without a time, because the
// plotter counts rows, and without the friction, as on a slow line.

#include "row.h"

#include <inttypes.h>

#include "../text/buffer.h"

#define PLOTTED 6 // columns from the second up to this one

const cli_csv_column_t cli_csv_columns[CLI_CSV_COLUMNS] = {
    {"t", "s"},   {"r", "m"},   {"v", "m/s"}, {"omega", "rad/s"},
    {"h", "m/s"}, {"g", "m/s"}, {"F", "N"},   {"M", "N m"}};

size_t cli_header(cli_format_t format, char out[CLI_ROW_ROOM]) {
  cli_buffer_t text = {out, 0, CLI_ROW_ROOM, false};
  if (format == CLI_FORMAT_CSV) {
    cli_add(&text, "t,r,v,omega,h,g,F,M,mode,choices\n");
  }
  return text.used;
}

size_t cli_csv_row(const cli_csv_t *row, char out[CLI_ROW_ROOM]) {
  cli_buffer_t text = {out, 0, CLI_ROW_ROOM, false};
  for (size_t i = 0; i < CLI_CSV_COLUMNS; i++) {
    if (i < row->columns) {
      cli_add_number(&text, row->column[i], row->is_float);
    }
    cli_add(&text, ",");
  }
  cli_add_form(&text, "%s,%" PRIu64 "\n", tf_mode_name(row->mode),
               (uint64_t)row->choices);
  return text.used;
}

size_t cli_plotter_row(const cli_csv_t *row, char out[CLI_ROW_ROOM]) {
  cli_buffer_t text = {out, 0, CLI_ROW_ROOM, false};
  for (size_t i = 1; i < PLOTTED && i < row->columns; i++) {
    cli_add_form(&text, "%s:", cli_csv_columns[i].name);
    cli_add_number(&text, row->column[i], row->is_float);
    cli_add(&text, " ");
  }
  cli_add_form(&text, "mode:%" PRIu64 " choices:%" PRIu64 "\n",
               (uint64_t)row->mode, (uint64_t)row->choices);
  return text.used;
}

size_t cli_row(cli_format_t format, tf_real_t t, const tf_state_t *state,
               const tf_report_t *report, char out[CLI_ROW_ROOM]) {
  const cli_csv_t row = {
      {(double)t, (double)state->r, (double)state->v, (double)state->w,
       (double)report->slip.h, (double)report->slip.g, (double)report->force.F,
       (double)report->force.M},
      CLI_CSV_COLUMNS,
      sizeof(tf_real_t) == sizeof(float),
      report->mode,
      report->choices};
  return format == CLI_FORMAT_CSV ? cli_csv_row(&row, out)
                                  : cli_plotter_row(&row, out);
}
