// Each form has one writer; they share the names and units of the columns. What
// a frame does not carry is left out, or left empty in CSV.

#include "stream.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "../setup/args.h"
#include "../text/buffer.h"
#include "../text/message.h"

static void teleplot_name(cli_buffer_t *text, const cli_csv_t *row,
                          const char *name) {
  const double ms = row->column[0] * 1000;
  cli_add_form(text, "%s:", name);
  cli_add_number(text, row->is_float ? (double)(float)ms : ms, row->is_float);
  cli_add(text, ":");
}

static size_t teleplot(const cli_csv_t *row, char out[CLI_STREAM_ROOM]) {
  cli_buffer_t text = {out, 0, CLI_STREAM_ROOM, false};
  for (size_t i = 1; i < row->columns; i++) {
    teleplot_name(&text, row, cli_csv_columns[i].name);
    cli_add_number(&text, row->column[i], row->is_float);
    // The section sign stands before the unit.
    cli_add_form(&text, "\xC2\xA7%s|g\n", cli_csv_columns[i].unit);
  }
  teleplot_name(&text, row, "mode");
  cli_add_form(&text, "%s|t\n", tf_mode_name(row->mode));
  teleplot_name(&text, row, "choices");
  cli_add_form(&text, "%" PRIu64 "|g\n", (uint64_t)row->choices);
  return text.used;
}

static void json_number(cli_buffer_t *text, const cli_csv_t *row, size_t i) {
  if (isfinite(row->column[i])) {
    cli_add_number(text, row->column[i], row->is_float);
  } else {
    cli_add(text, "null"); // JSON has no other word for it
  }
}

static size_t json(const cli_csv_t *row, char out[CLI_STREAM_ROOM]) {
  cli_buffer_t text = {out, 0, CLI_STREAM_ROOM, false};
  cli_add(&text, "{\"timestamp\":");
  json_number(&text, row, 0);
  for (size_t i = 1; i < row->columns; i++) {
    cli_add_form(&text, ",\"%s\":", cli_csv_columns[i].name);
    json_number(&text, row, i);
  }
  cli_add_form(&text, ",\"mode\":%" PRIu64 ",\"choices\":%" PRIu64 "}\n",
               (uint64_t)row->mode, (uint64_t)row->choices);
  return text.used;
}

const cli_stream_t cli_streams[CLI_STREAMS] = {
    {"csv", CLI_CSV_HEADER, cli_csv_row},
    {"plotter", "", cli_plotter_row},
    {"teleplot", "", teleplot},
    {"json", "", json}};

static int choose(cli_args_t *args, const char *name) {
  unsigned i = 0;
  while (i < CLI_STREAMS && strcmp(name, cli_streams[i].name) != 0) {
    i++;
  }
  if (i == CLI_STREAMS) {
    return cli_message(CLI_USAGE,
                       "--as %s: unknown form; forms are csv, plotter, "
                       "teleplot and json",
                       name);
  }
  if (args->as != 0 && args->as != i + 1) {
    return cli_message(CLI_USAGE, "--as %s: one form at a time (%s was given)",
                       name, cli_streams[args->as - 1].name);
  }
  args->as = i + 1;
  return CLI_DONE;
}

int cli_read_as(void *args, const cli_given_t *given) {
  return choose(args, given->value);
}

int cli_read_csv(void *args, const cli_given_t *given) {
  (void)given;
  return choose(args, "csv");
}
