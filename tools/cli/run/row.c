// The formats of a row. The plotter format is the one that the serial plotter
// of the Arduino IDE draws: label:value pairs on one line, without a time,
// because the plotter counts rows, and without the friction, as on a slow line.
// JSON, an object a line with its seconds in "timestamp", is for PlotJuggler
// over UDP.

#include "row.h"

#define PLOTTED 6 // columns from the second up to this one

#define COLUMN(name, unit, value) {#name, unit},
const cli_quantity_t cli_csv_columns[CLI_CSV_COLUMNS] = {
    CLI_CSV_NUMBERS(COLUMN, COLUMN)};

static void add(cli_buffer_t *text, const cli_csv_t *row, size_t i) {
  cli_add_number(text, row->column[i], row->is_float);
}

static void csv(const cli_csv_t *row, cli_buffer_t *text) {
  char set[CLI_SET_ROOM];
  for (size_t i = 0; i < CLI_CSV_COLUMNS; i++) {
    add(text, row, i);
    cli_add(text, ",");
  }
  cli_add_form(text, "%s,%u,%s\n", tf_mode_name(row->mode), row->choices,
               cli_write_set(set, row->set));
}

static void plotter(const cli_csv_t *row, cli_buffer_t *text) {
  for (size_t i = 1; i < PLOTTED; i++) {
    cli_add_form(text, "%s:", cli_csv_columns[i].name);
    add(text, row, i);
    cli_add(text, " ");
  }
  cli_add_form(text, "mode:%u choices:%u set:%u\n", row->mode, row->choices,
               row->set);
}

static void teleplot(const cli_csv_t *row, cli_buffer_t *text) {
  char room[CLI_REAL_ROOM];
  const double ms = row->column[0] * 1000;
  (void)decimal_write(room, row->is_float ? (double)(float)ms : ms,
                      row->is_float);
  for (size_t i = 1; i < CLI_CSV_COLUMNS; i++) {
    cli_add_form(text, "%s:%s:", cli_csv_columns[i].name, room);
    add(text, row, i);
    // The section sign stands before the unit.
    cli_add_form(text, "\xC2\xA7%s|g\n", cli_csv_columns[i].unit);
  }
  cli_add_form(text, "mode:%s:%s|t\nchoices:%s:%u|g\nset:%s:%u|g\n", room,
               tf_mode_name(row->mode), room, row->choices, room, row->set);
}

static void json(const cli_csv_t *row, cli_buffer_t *text) {
  for (size_t i = 0; i < CLI_CSV_COLUMNS; i++) {
    cli_add_form(text, "%s\"%s\":", i == 0 ? "{" : ",",
                 i == 0 ? "timestamp" : cli_csv_columns[i].name);
    if (isfinite(row->column[i]))
      add(text, row, i);
    else
      cli_add(text, "null"); // JSON has no other word for it
  }
  cli_add_form(text, ",\"mode\":%u,\"choices\":%u,\"set\":%u}\n", row->mode,
               row->choices, row->set);
}

const cli_stream_t cli_streams[CLI_FORMATS] = {
    [CLI_FORMAT_CSV] = {COLUMN_HEADER "\n", csv},
    [CLI_FORMAT_FRAMES] = {"", NULL},
    [CLI_FORMAT_JSON] = {"", json},
    [CLI_FORMAT_PLOTTER] = {"", plotter},
    [CLI_FORMAT_TELEPLOT] = {"", teleplot}};

#define NUMBER(name, unit, value) (double)(value),
cli_csv_t cli_row(tf_real_t t, const tf_state_t *state,
                  const tf_report_t *report) {
  return (cli_csv_t){{CLI_CSV_NUMBERS(NUMBER, NUMBER)},
                     sizeof(tf_real_t) == sizeof(float),
                     report->mode,
                     report->choices,
                     report->set};
}
