// Inputs over time from CSV. All of it is read and checked before anything is
// opened for writing, so a table of any length costs memory and never stops a
// run in its middle.

#include <ctype.h>
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "../text/buffer.h"
#include "../text/message.h"
#include "../text/number.h"
#include "../text/options.h"
#include "../text/trailer.h"
#include "inputs.h"
#include "setup.h"

#define LINE_ROOM 1024
#define FIELDS (CLI_INPUTS + 1) // with t

typedef struct {
  cli_inputs_t *inputs;
  const char *name;
  unsigned long long line;
  size_t fields;       // of every row; 0 before the header
  size_t kind[FIELDS]; // CLI_INPUT_..., or CLI_INPUTS for t
  cli_trailer_t sum;   // of header and rows
  bool is_declared;    // a comment says how many rows there are
  uint64_t declared;
  char trailer[CLI_TRAILER_ROOM]; // the comment that is one, or empty
} reader_t;

static int refuse(const reader_t *reader, int code, size_t field,
                  const char *text, const char *why) {
  return cli_message(code, "%s:%llu: column %zu: '%s' %s", reader->name,
                     reader->line, field + 1, text, why);
}

// Cuts the next field off a line. Returns: it, without blanks around it and
// without the quotes in which some programs put every field.
static char *next_field(char **line) {
  char *field = *line + strspn(*line, " \t");
  char *end = *line + strcspn(*line, ",");
  *line = *end == ',' ? end + 1 : NULL;
  *end = '\0';
  for (size_t i = strlen(field); i > 0 && strchr(" \t", field[i - 1]); i--) {
    field[i - 1] = '\0';
  }
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
                         "%s:%llu: unknown column '%s'%s; columns are t, "
                         "omega0, r0, force, torque",
                         reader->name, reader->line, name, closest.hint);
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

static void range_of(size_t kind, double *low, double *high) {
  const size_t i = kind < CLI_INPUTS
                       ? cli_parameter_index(cli_input_columns[kind].name)
                       : TF_PARAMETERS;
  *low = i < TF_PARAMETERS ? (double)tf_parameter_ranges[i].low
                           : -(double)TF_STATE_LIMIT;
  *high = i < TF_PARAMETERS ? (double)tf_parameter_ranges[i].high
                            : (double)TF_STATE_LIMIT;
}

static int read_field(const reader_t *reader, size_t field, const char *text,
                      tf_real_t *value) {
  const char *why = "";
  double low = 0, high = 0;
  const size_t kind = reader->kind[field];
  if (!cli_read_real(text, value, &why)) {
    return refuse(reader, CLI_USAGE, field, text, why);
  }
  range_of(kind, &low, &high);
  if ((double)*value >= low && (double)*value <= high) {
    return CLI_DONE;
  }
  return cli_message(
      CLI_REFUSED, "%s:%llu: column %zu: %s = %s must lie in [%g, %g] %s",
      reader->name, reader->line, field + 1,
      kind < CLI_INPUTS ? cli_input_columns[kind].name : "t", text, low, high,
      kind < CLI_INPUTS ? cli_input_columns[kind].unit : "s");
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
                       "%s:%llu: %s than the %zu columns of the header",
                       reader->name, reader->line,
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
             : cli_message(CLI_STOPPED, "%s:%llu: out of memory", reader->name,
                           reader->line);
}

// The words of a comment between blanks: digits, or letters in lower case.
static void put_words(const char *line, char out[2 * LINE_ROOM]) {
  int before = ' ';
  *out++ = ' ';
  for (; *line != '\0'; line++) {
    const int byte = tolower((unsigned char)*line);
    const int now = isalnum(byte) == 0 ? ' ' : isdigit(byte) ? '0' : 'a';
    if (now != before && before != ' ') *out++ = ' ';
    if (now != ' ') *out++ = (char)byte;
    before = now;
  }
  (void)strcpy(out, " ");
}

// A number beside the word row or rows declares the length of the table, alone
// with it: what is not understood would let a table pass that was cut.
static int read_length(reader_t *reader, const char *line) {
  static const char *const names[] = {" row ", " rows ", " nrows "};
  char words[2 * LINE_ROOM], number[24] = "", name[8], more;
  uint64_t count = 0;
  bool is_like = false;
  put_words(line, words);
  for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
    for (char *at = strstr(words, names[i]); at != NULL;
         at = strstr(at + 1, names[i])) {
      is_like = is_like || isdigit(at[strlen(names[i])]) != 0 ||
                (at > words && isdigit(at[-1]) != 0);
    }
  }
  if (!is_like) return CLI_DONE;
  if ((sscanf(words, " %23[0-9] %7[a-z] %c", number, name, &more) != 2 &&
       sscanf(words, " %7[a-z] %23[0-9] %c", name, number, &more) != 2) ||
      !cli_read_whole(number, 0, UINT64_MAX, &count) ||
      (reader->is_declared && count != reader->declared)) {
    return cli_message(CLI_USAGE,
                       "%s:%llu: '%s': the length of a table is '# N rows', "
                       "once",
                       reader->name, reader->line, line);
  }
  reader->is_declared = true;
  reader->declared = count;
  return CLI_DONE;
}

// open: the last line has no newline.
static int check_length(const reader_t *reader, bool open) {
  char rows[CLI_TRAILER_ROOM], trailer[CLI_TRAILER_ROOM];
  (void)snprintf(rows, sizeof rows, "# %" PRIu64 " rows", reader->declared);
  (void)cli_trailer_line(&reader->sum, &cli_whole_shard, trailer);
  const size_t length = (size_t)(strstr(trailer, ", run") - trailer);
  const bool has_trailer = reader->trailer[0] != '\0';
  if (!has_trailer && !reader->is_declared && open) {
    return cli_note_open(reader->name);
  }
  const bool sums =
      !has_trailer || strncmp(reader->trailer, trailer, length) == 0;
  const bool counts =
      !reader->is_declared || reader->declared == reader->sum.rows;
  if (sums && counts && !open) return CLI_DONE;
  return cli_message(CLI_REFUSED, "%s: cut off or changed: it says '%s'",
                     reader->name,
                     sums && reader->is_declared ? rows : reader->trailer);
}

static int read_line(reader_t *reader, char *line) {
  if (reader->line == 1) {
    line += cli_utf8_mark(line, strlen(line));
  }
  // Behind the rows there may be the trailer of this program's files.
  if (strncmp(line, CLI_TRAILER_MARK, sizeof CLI_TRAILER_MARK - 1) == 0) {
    (void)snprintf(reader->trailer, sizeof reader->trailer, "%.*s",
                   CLI_TRAILER_ROOM - 1, line);
    return CLI_DONE;
  }
  if (line[0] == '#') {
    return read_length(reader, line);
  }
  if (line[strspn(line, " \t")] == '\0') {
    return CLI_DONE;
  }
  cli_trailer_add(&reader->sum, line, strlen(line), reader->fields > 0);
  cli_trailer_add(&reader->sum, "\n", 1, 0);
  return reader->fields == 0 ? read_header(reader, line)
                             : read_row(reader, line);
}

int cli_inputs_parse(cli_inputs_t *inputs, const char *name, FILE *file) {
  reader_t reader = {.inputs = inputs, .name = name};
  char line[LINE_ROOM];
  cli_line_t found;
  bool open = false;
  inputs->name = name;
  while ((found = cli_read_line(file, line, sizeof line)) != CLI_LINE_END) {
    reader.line++;
    open = feof(file) != 0; // what ended the line is not a newline
    if (found != CLI_LINE) {
      return cli_message(
          CLI_USAGE, "%s:%llu: a zero, or a line of more than %d characters",
          name, reader.line, LINE_ROOM - 1);
    }
    CLI_TRY(read_line(&reader, line));
  }
  if (ferror(file) != 0) {
    return cli_message(CLI_USAGE, "%s: %s", name, strerror(errno));
  }
  if (inputs->count == 0) {
    return cli_message(CLI_USAGE, "%s: no %s", name,
                       reader.fields == 0 ? "header" : "row");
  }
  return check_length(&reader, open);
}

static int read_file(cli_inputs_t *inputs, const char *path) {
  const bool standard = strcmp(path, "-") == 0;
  FILE *file = standard ? stdin : fopen(path, "r");
  if (file == NULL) {
    return cli_message(CLI_USAGE, "--inputs %s: %s", path, strerror(errno));
  }
  const int code =
      cli_inputs_parse(inputs, standard ? "standard input" : path, file);
  if (!standard) {
    (void)fclose(file);
  }
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
