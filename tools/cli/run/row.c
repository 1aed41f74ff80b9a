// The formats of a row. Scripts rely on the columns of the CSV, so no column is
// ever appended. The plotter format is the one that the serial plotter of the
// Arduino IDE draws: label:value pairs on one line.

#include "row.h"

#include "../text/buffer.h"

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
  cli_add(&text, tf_mode_name(row->mode));
  cli_add(&text, ",");
  cli_add_count(&text, row->choices);
  cli_add(&text, "\n");
  return text.used;
}

static size_t csv_row(tf_real_t t, const tf_state_t *state,
                      const tf_report_t *report, char out[CLI_ROW_ROOM]) {
  const cli_csv_t row = {
      {(double)t, (double)state->r, (double)state->v, (double)state->w,
       (double)report->slip.h, (double)report->slip.g, (double)report->force.F,
       (double)report->force.M},
      CLI_CSV_COLUMNS,
      sizeof(tf_real_t) == sizeof(float),
      report->mode,
      report->choices};
  return cli_csv_row(&row, out);
}

static size_t plotter_row(const tf_state_t *state, const tf_report_t *report,
                          char out[CLI_ROW_ROOM]) {
  static const char *const labels[5] = {"r:", " v:", " omega:", " h:", " g:"};
  const tf_real_t values[5] = {state->r, state->v, state->w, report->slip.h,
                               report->slip.g};
  cli_buffer_t text = {out, 0, CLI_ROW_ROOM, false};
  for (size_t i = 0; i < 5; i++) {
    cli_add(&text, labels[i]);
    cli_add_real(&text, values[i]);
  }
  cli_add(&text, "\n");
  return text.used;
}

size_t cli_row(cli_format_t format, tf_real_t t, const tf_state_t *state,
               const tf_report_t *report, char out[CLI_ROW_ROOM]) {
  return format == CLI_FORMAT_CSV ? csv_row(t, state, report, out)
                                  : plotter_row(state, report, out);
}
