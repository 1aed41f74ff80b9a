// Inputs over time from CSV. All of it is read and checked before anything is
// opened for writing, so a table of any length costs memory and never stops a
// run in its middle.

#include <stdlib.h>
#include <string.h>

#include "../text/text.h"
#include "inputs.h"
#include "setup.h"

#define LINE_ROOM 1024
#define FIELDS (CLI_INPUTS + 1) // with t

typedef struct {
  cli_inputs_t *inputs;
  cli_lines_t lines;
  size_t fields;       // of every row; 0 before the header
  size_t kind[FIELDS]; // CLI_INPUT_..., or CLI_INPUTS for t
} reader_t;

static int refuse(const reader_t *reader, int code, size_t field,
                  const char *text, const char *why) {
  return cli_message(code, "%s:%lu: column %zu: '%s' %s", reader->lines.name,
                     reader->lines.line, field + 1, text, why);
}

// Cuts the next field off a line. Returns: it, without blanks around it and
// without the quotes in which some programs put every field.
static char *next_field(char **line) {
  char *field = *line, *end = *line + strcspn(*line, ",");
  *line = *end == ',' ? end + 1 : NULL;
  *end = '\0';
  field = cli_trim(field);
  const size_t length = strlen(field);
  if (length >= 2 && field[0] == '"' && field[length - 1] == '"') {
    field[length - 1] = '\0';
    field++;
  }
  return field;
}

static int read_header(reader_t *reader, char *line) {
  while (line != NULL) {
    const char *name = next_field(&line);
    cli_closest_t closest = cli_closest_to(name);
    const size_t kind = cli_closest_find(
        &closest, cli_input_columns, CLI_INPUTS, sizeof cli_input_columns[0]);
    const bool is_t = strcmp(name, "t") == 0;
    if (kind == CLI_INPUTS && !is_t) {
      return cli_message(CLI_USAGE,
                         "%s:%lu: unknown column '%s'%s; columns are t, "
                         "omega0, r0, force, torque",
                         reader->lines.name, reader->lines.line, name,
                         closest.hint);
    }
    if (is_t != (reader->fields == 0)) {
      return refuse(reader, CLI_USAGE, reader->fields, name,
                    "is misplaced: the first column, and no other, is t");
    }
    if (!is_t && reader->inputs->given[kind]) {
      return refuse(reader, CLI_USAGE, reader->fields, name, "comes twice");
    }
    reader->kind[reader->fields++] = kind;
    if (!is_t) {
      reader->inputs->given[kind] = true;
    }
  }
  if (reader->fields < 2) {
    return refuse(reader, CLI_USAGE, 0, "t",
                  "is alone: an input has to stand beside it");
  }
  return CLI_DONE;
}

static int read_field(const reader_t *reader, size_t field, const char *text,
                      tf_real_t *value) {
  static const cli_quantity_t t = {"t", "s"};
  const size_t kind = reader->kind[field];
  const cli_quantity_t *column =
      kind < CLI_INPUTS ? &cli_input_columns[kind] : &t;
  const size_t i = cli_number_index(column->name);
  const bool ranged = i < TF_PARAMETERS;
  const tf_real_t low = ranged ? tf_parameter_ranges[i].low : -TF_STATE_LIMIT;
  const tf_real_t high = ranged ? tf_parameter_ranges[i].high : TF_STATE_LIMIT;
  const char *why = "";
  if (!cli_read_real(text, value, &why)) {
    return refuse(reader, CLI_USAGE, field, text, why);
  }
  return *value >= low && *value <= high
             ? CLI_DONE
             : cli_message(
                   CLI_REFUSED, "%s:%lu: column %zu: %s = %s %s",
                   reader->lines.name, reader->lines.line, field + 1,
                   column->name, text,
                   cli_must_lie((double)low, (double)high, column->unit));
}

static int read_row(reader_t *reader, char *line) {
  cli_inputs_t *inputs = reader->inputs;
  cli_input_row_t row = {.t = 0};
  size_t field = 0;
  for (; line != NULL && field < reader->fields; field++) {
    const size_t kind = reader->kind[field];
    CLI_TRY(read_field(reader, field, next_field(&line),
                       kind < CLI_INPUTS ? &row.value[kind] : &row.t));
  }
  if (line != NULL || field < reader->fields) {
    return cli_message(CLI_USAGE,
                       "%s:%lu: %s than the %zu columns of the header",
                       reader->lines.name, reader->lines.line,
                       line != NULL ? "more" : "fewer", reader->fields);
  }
  const cli_input_row_t *rows = inputs->rows;
  const size_t n = inputs->count;
  const bool earlier = n > 0 && row.t < rows[n - 1].t;
  if (earlier || (n > 1 && row.t <= rows[n - 2].t)) {
    char text[CLI_REAL_ROOM];
    (void)cli_write_real(text, row.t);
    return refuse(reader, CLI_REFUSED, 0, text,
                  earlier ? "is earlier than t in the row before"
                          : "is t of two rows before: a jump has two");
  }
  return cli_inputs_add(inputs, &row)
             ? CLI_DONE
             : cli_message(CLI_STOPPED, "%s:%lu: out of memory",
                           reader->lines.name, reader->lines.line);
}

static int read_line(reader_t *reader, char *line) {
  if (line[0] == '#' || line[strspn(line, " \t")] == '\0') {
    return CLI_DONE;
  }
  return reader->fields == 0 ? read_header(reader, line)
                             : read_row(reader, line);
}

int cli_inputs_parse(cli_inputs_t *inputs, const char *name, const char *text,
                     size_t size) {
  reader_t reader = {.inputs = inputs,
                     .lines = {name, text, size, 0, 0, false}};
  char line[LINE_ROOM];
  inputs->name = name;
  while (cli_next_line(&reader.lines, line, sizeof line)) {
    if (strlen(line) != reader.lines.length) {
      return cli_message(CLI_USAGE,
                         "%s:%lu: a zero, or a line of more than %d characters",
                         name, reader.lines.line, LINE_ROOM - 1);
    }
    CLI_TRY(read_line(&reader, line));
  }
  if (inputs->count == 0) {
    return cli_message(CLI_USAGE, "%s: no %s", name,
                       reader.fields == 0 ? "header" : "row");
  }
  return reader.lines.open ? cli_note_open(name) : CLI_DONE;
}

static int read_file(cli_inputs_t *inputs, const char *path) {
  char *text = NULL;
  size_t size = 0;
  CLI_TRY(cli_read_text("--inputs ", path, SIZE_MAX - 1, &text, &size));
  const int code = cli_inputs_parse(
      inputs, strcmp(path, "-") == 0 ? "standard input" : path, text, size);
  free(text);
  return code;
}

int cli_drive_read(cli_drive_t *drive, const tf_scene_t *scene,
                   const cli_drive_args_t *args) {
  memset(drive, 0, sizeof *drive);
  CLI_TRY(cli_inputs_of_scene(&drive->profile, scene));
  if (args->inputs == NULL) {
    return CLI_DONE;
  }
  if (args->between == CLI_NOT_GIVEN) {
    return cli_message(CLI_USAGE,
                       "--inputs %s: say what holds between two rows, by "
                       "--between held or --between linear",
                       args->inputs);
  }
  drive->table.linear = args->between == 1;
  const int code = read_file(&drive->table, args->inputs);
  if (drive->table.given[CLI_INPUT_OMEGA0]) {
    cli_inputs_free(&drive->profile);
  }
  return code;
}
