// One row: an instant as text. The columns are a contract that scripts rely
// on, so nothing is ever appended; the plotter format is what the serial
// plotter of the Arduino IDE draws, label:value pairs on one line.

#include "run.h"
#include "text.h"

static size_t append_text(char *out, size_t at, const char *text) {
  while (*text != '\0') {
    out[at++] = *text++;
  }
  return at;
}

static size_t append_real(char *out, size_t at, tf_real_t value) {
  return at + cli_write_real(out + at, value);
}

size_t cli_header(cli_format_t format, char out[CLI_ROW_ROOM]) {
  return format == CLI_FORMAT_CSV
             ? append_text(out, 0, "t,r,v,omega,h,g,F,M,mode,choices\n")
             : 0;
}

size_t cli_csv_row(const cli_csv_t *row, char out[CLI_ROW_ROOM]) {
  size_t at = 0;
  for (size_t i = 0; i < CLI_CSV_COLUMNS; i++) {
    if (i < row->columns) {
      at += cli_write_number(out + at, row->column[i], row->is_float);
    }
    out[at++] = ',';
  }
  at = append_text(out, at, tf_mode_name(row->mode));
  out[at++] = ',';
  out[at++] = (char)('0' + row->choices); // at most TF_MODES, one digit
  out[at++] = '\n';
  return at;
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
  size_t at = 0;
  for (size_t i = 0; i < 5; i++) {
    at = append_text(out, at, labels[i]);
    at = append_real(out, at, values[i]);
  }
  out[at++] = '\n';
  return at;
}

size_t cli_row(cli_format_t format, tf_real_t t, const tf_state_t *state,
               const tf_report_t *report, char out[CLI_ROW_ROOM]) {
  return format == CLI_FORMAT_CSV ? csv_row(t, state, report, out)
                                  : plotter_row(state, report, out);
}
