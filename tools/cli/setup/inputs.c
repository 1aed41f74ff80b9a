// Inputs over time: read from CSV or from the scene, all of it before anything
// is opened for writing, so a table of any length costs memory and never stops
// a run in its middle; looked up; and the steps that they drive. Time only goes
// on, so a look-up begins at the row of the last one.

#include "inputs.h"

#define REACH 0, 0, -TF_STATE_LIMIT, TF_STATE_LIMIT
const tf_parameter_range_t cli_input_columns[CLI_INPUTS + 1] = {
    {"omega0", "rad/s", REACH},
    {"r0", "m", REACH},
    {"force", "N", REACH},
    {"torque", "N m", REACH},
    {"t", "s", REACH}};

static int add_row(cli_inputs_t *inputs, const cli_input_row_t *row) {
  cli_input_row_t *rows =
      cli_grow(inputs->rows, inputs->count, &inputs->room, sizeof *rows);
  if (rows == NULL) return cli_stop("%s: out of memory", inputs->name);
  inputs->rows = rows;
  inputs->rows[inputs->count++] = *row;
  return CLI_DONE;
}

#define LINE_ROOM 1024

typedef struct {
  cli_inputs_t *inputs;
  cli_lines_t lines;
  size_t fields;               // of every row; 0 before the header
  size_t kind[CLI_INPUTS + 1]; // index of the column
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
  bool *given = reader->inputs->given;
  const char *mark = strchr(line, ',') == NULL ? strpbrk(line, ";\t") : NULL;
  if (mark != NULL) {
    return cli_usage("%s:%lu: separator is %s, expected ','",
                     reader->lines.name, reader->lines.line,
                     *mark == ';' ? "';'" : "a tab");
  }
  while (line != NULL) {
    const char *name = next_field(&line);
    cli_closest_t closest = cli_closest_to(name);
    const size_t kind =
        cli_closest_find(&closest, cli_input_columns, CLI_INPUTS + 1,
                         sizeof cli_input_columns[0]);
    if (kind > CLI_INPUTS) {
      return cli_usage(
          "%s:%lu: unknown column '%s'%s; columns are t, omega0, r0, force, "
          "torque",
          reader->lines.name, reader->lines.line, name, closest.hint);
    }
    if ((kind == CLI_INPUTS) != (reader->fields == 0)) {
      return refuse(reader, CLI_USAGE, reader->fields, name,
                    "is misplaced: the first column, and no other, is t");
    }
    if (given[kind])
      return refuse(reader, CLI_USAGE, reader->fields, name, "comes twice");
    given[kind] = true;
    reader->kind[reader->fields++] = kind;
  }
  return reader->fields > 1 ? CLI_DONE
                            : refuse(reader, CLI_USAGE, 0, "t",
                                     "is alone: it needs an input column");
}

static int read_field(const reader_t *reader, size_t field, const char *text,
                      tf_real_t *value) {
  const tf_parameter_range_t *range = &cli_input_columns[reader->kind[field]];
  const size_t parameter = cli_number_index(range->name);
  const char *why = "";
  if (parameter < TF_PARAMETERS) range = cli_number(parameter);
  if (!cli_read_real(text, value, &why))
    return refuse(reader, CLI_USAGE, field, text, why);
  if (cli_is_in(range, *value)) return CLI_DONE;
  return cli_refuse("%s:%lu: column %zu: %s = %s %s", reader->lines.name,
                    reader->lines.line, field + 1, range->name, text,
                    cli_must(range));
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
    return cli_usage("%s:%lu: %s than the %zu columns of the header",
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
                          : "is in two rows already: a jump has two");
  }
  return add_row(inputs, &row);
}

int cli_inputs_parse(cli_inputs_t *inputs, const char *name, const char *text,
                     size_t size) {
  reader_t reader = {.inputs = inputs,
                     .lines = {name, text, size, 0, 0, false}};
  char line[LINE_ROOM];
  inputs->name = name;
  while (cli_next_line(&reader.lines, line, sizeof line)) {
    if (strlen(line) != reader.lines.length) {
      return cli_usage("%s:%lu: a zero, or a line of more than %d characters",
                       name, reader.lines.line, LINE_ROOM - 1);
    }
    if (line[0] == '#' || line[strspn(line, " \t")] == '\0') continue;
    CLI_TRY(reader.fields == 0 ? read_header(&reader, line)
                               : read_row(&reader, line));
  }
  if (inputs->count == 0)
    return cli_usage("%s: no %s", name, reader.fields == 0 ? "header" : "row");
  return reader.lines.open ? cli_note_open(name) : CLI_DONE;
}

void cli_inputs_free(cli_inputs_t *inputs) {
  free(inputs->rows);
  inputs->rows = NULL;
  inputs->count = inputs->room = 0;
}

int cli_drive_read(cli_drive_t *drive, const tf_scene_t *scene,
                   const char *inputs, unsigned between) {
  memset(drive, 0, sizeof *drive);
  cli_inputs_t *profile = &drive->profile;
  *profile = (cli_inputs_t){.name = "profile of the scene", .linear = true};
  profile->given[CLI_INPUT_OMEGA0] = scene->knots > 0;
  for (size_t i = 0; i < scene->knots; i++) {
    const tf_knot_t *knot = &scene->profile[i];
    const cli_input_row_t row = {.t = knot->t,
                                 .value = {[CLI_INPUT_OMEGA0] = knot->omega0}};
    CLI_TRY(add_row(profile, &row));
  }
  if (inputs == NULL) return CLI_DONE;
  if (between == CLI_NOT_GIVEN) {
    return cli_usage(
        "--inputs %s: say what holds between two rows, by --between held or "
        "--between linear",
        inputs);
  }
  drive->table.linear = between == 1;
  char *text = NULL;
  size_t size = 0;
  CLI_TRY(cli_read_text("--inputs ", inputs, SIZE_MAX - 1, &text, &size));
  const bool standard = strcmp(inputs, "-") == 0;
  const int code = cli_inputs_parse(
      &drive->table, standard ? "standard input" : inputs, text, size);
  free(text);
  if (drive->table.given[CLI_INPUT_OMEGA0]) cli_inputs_free(&drive->profile);
  return code;
}

uint32_t cli_inputs_hash(const cli_inputs_t *inputs) {
  uint32_t sum = 0;
  for (size_t i = 0; i < inputs->count; i++) {
    const cli_input_row_t *row = &inputs->rows[i];
    sum = cli_crc_of(sum, "%d %a", inputs->linear, (double)row->t);
    for (size_t column = 0; column < CLI_INPUTS; column++)
      if (inputs->given[column])
        sum = cli_crc_of(sum, " %zu:%a", column, (double)row->value[column]);
  }
  return sum;
}

// A span that cannot be a step of its own is not cut off: dt is >= 1e-9 s.
#define SHORTEST TF_R(2e-9)

// As tf_scene_input does it, operation by operation: a row that is tick dt but
// for rounding belongs to that boundary, and not to a step.
cli_span_t cli_span_of(uint64_t tick, tf_real_t dt) {
  cli_span_t span = {(tf_real_t)tick * dt, (tf_real_t)(tick + 1) * dt, dt, 0};
  const tf_real_t rounding = dt * TF_R(0x1p-20) + 4 * TF_REAL_EPSILON * span.to;
  span.off = rounding < dt / 2 ? rounding : dt / 2;
  return span;
}

// The inputs at a time t, between two rows of a linear table. Rows up to
// t + off belong to it.
static void look_up(cli_inputs_t *inputs, tf_real_t t, tf_real_t off,
                    tf_real_t value[CLI_INPUTS]) {
  const cli_input_row_t *row = &inputs->rows[inputs->at];
  const cli_input_row_t *end = inputs->rows + inputs->count - 1;
  while (row > inputs->rows && row->t > t + off) row--;
  while (row < end && row[1].t <= t + off) row++;
  inputs->at = (size_t)(row - inputs->rows);
  const bool stands = !inputs->linear || row == end || t <= row->t;
  for (size_t i = 0; i < CLI_INPUTS; i++) {
    value[i] = stands || t < row[1].t ? row->value[i] : row[1].value[i];
    if (inputs->given[i] && !stands && t < row[1].t) {
      value[i] += (row[1].value[i] - row->value[i]) *
                  ((t - row->t) / (row[1].t - row->t));
    }
  }
}

// The rows from `next` up to `end` lie within a span. The mean of one input,
// piece by piece, is never outside of its values, whatever the rounding.
static tf_real_t mean_of(const cli_inputs_t *inputs, size_t column, size_t next,
                         size_t end, const cli_span_t *span, tf_real_t before,
                         tf_real_t after) {
  const tf_real_t length = span->to - span->from;
  tf_real_t from = span->from, value = before, sum = 0;
  tf_real_t low = before, high = before;
  for (size_t k = next; k <= end; k++) {
    const cli_input_row_t *row = &inputs->rows[k];
    const tf_real_t to = k < end ? row->t : span->to;
    const tf_real_t then = k < end ? row->value[column] : after;
    sum += (value + then) / 2 * ((to - from) / length);
    from = to;
    value = then;
    low = then < low ? then : low;
    high = then > high ? then : high;
  }
  return sum < low ? low : sum > high ? high : sum;
}

static void set(const cli_inputs_t *inputs, const tf_real_t value[CLI_INPUTS],
                tf_input_t *input) {
  tf_real_t *const members[CLI_INPUTS] = {&input->omega0, &input->r0,
                                          &input->force, &input->torque};
  for (size_t i = 0; i < CLI_INPUTS; i++)
    if (inputs->given[i]) *members[i] = value[i];
  if (inputs->given[CLI_INPUT_OMEGA0]) input->alpha = 0;
}

static void note(cli_inputs_t *inputs, const tf_real_t value[CLI_INPUTS]) {
  for (size_t i = 0; i < CLI_INPUTS; i++) {
    tf_real_t *low = &inputs->low[i], *high = &inputs->high[i];
    *low = inputs->applied && *low < value[i] ? *low : value[i];
    *high = inputs->applied && *high > value[i] ? *high : value[i];
  }
  inputs->applied = true;
}

void cli_inputs_over(cli_inputs_t *inputs, const cli_span_t *span,
                     tf_input_t *input) {
  tf_real_t before[CLI_INPUTS], after[CLI_INPUTS], mean[CLI_INPUTS];
  tf_real_t jumps = 0;
  if (inputs->count == 0) return;
  const size_t was = inputs->at;
  look_up(inputs, span->from, span->off, before);
  if (!inputs->linear) {
    inputs->passed += inputs->at > was ? inputs->at - was - 1 : 0;
    inputs->last = inputs->at;
    set(inputs, before, input);
    note(inputs, before);
    return;
  }
  const cli_input_row_t *rows = inputs->rows;
  const size_t next =
      inputs->at + (rows[inputs->at].t <= span->from + span->off);
  look_up(inputs, span->to, -span->off, after);
  // Behind the last row of this span; before the first row it has none.
  const size_t end = inputs->at + (rows[inputs->at].t <= span->to - span->off);
  inputs->last = inputs->at + (inputs->at + 1 < inputs->count &&
                               rows[inputs->at].t < span->to);
  for (size_t k = next; k < end; k++) {
    if (k > next && rows[k].t == rows[k - 1].t) {
      jumps +=
          rows[k].value[CLI_INPUT_OMEGA0] - rows[k - 1].value[CLI_INPUT_OMEGA0];
      inputs->jumps++;
    } else {
      inputs->within++;
    }
  }
  for (size_t i = 0; i < CLI_INPUTS; i++) {
    mean[i] = 0;
    if (inputs->given[i] && i != CLI_INPUT_OMEGA0)
      mean[i] = mean_of(inputs, i, next, end, span, before[i], after[i]);
  }
  mean[CLI_INPUT_OMEGA0] = before[CLI_INPUT_OMEGA0] + jumps;
  set(inputs, mean, input);
  if (inputs->given[CLI_INPUT_OMEGA0])
    tf_turntable_to(input, after[CLI_INPUT_OMEGA0], span->dt);
  mean[CLI_INPUT_OMEGA0] = after[CLI_INPUT_OMEGA0];
  note(inputs, mean);
}

// Sets the inputs that the table gives at the instant at which a run starts,
// with the alpha of its first step.
static void begin_at(cli_inputs_t *inputs, const cli_span_t *span,
                     tf_input_t *input) {
  tf_real_t value[CLI_INPUTS];
  if (inputs->count == 0) return;
  cli_inputs_over(inputs, span, input);
  const tf_real_t alpha = input->alpha;
  look_up(inputs, span->from, span->off, value);
  set(inputs, value, input);
  input->alpha = alpha;
  inputs->first = inputs->last = inputs->at;
  inputs->applied = false;
  inputs->passed = inputs->within = inputs->jumps = 0;
}

tf_input_t cli_drive_begin(cli_drive_t *drive, const tf_machine_t *machine,
                           uint64_t tick) {
  const cli_span_t span = cli_span_of(tick, machine->dt);
  tf_input_t input = tf_input_default(machine);
  begin_at(&drive->profile, &span, &input);
  begin_at(&drive->table, &span, &input);
  return input;
}

void cli_drive_notes(const cli_drive_t *drive, const cli_setup_t *setup,
                     double begin, double end) {
  const cli_inputs_t *table = &drive->table;
  const size_t rows = table->count;
  const double first = rows > 0 ? (double)table->rows[0].t : begin;
  const double last = rows > 0 ? (double)table->rows[rows - 1].t : begin;
  const char *what = first > end                ? "all rows lie after the run"
                     : rows > 1 && last < begin ? "all rows lie before the run"
                     : end > 0 && last > 100 * end ? "is t in seconds?"
                                                   : NULL;
  if (what != NULL) {
    cli_note("%s: %s (rows: t = %g to %g s, run: %g to %g s)", table->name,
             what, first, last, begin, end);
  }
  for (size_t i = 0; i < CLI_INPUTS; i++) {
    const size_t number = cli_number_index(cli_input_columns[i].name);
    const cli_setting_t *setting =
        number < TF_PARAMETERS ? setup->set[number] : NULL;
    if (drive->table.given[i] && setting != NULL) {
      cli_note("%s %s has no effect: %s gives %s", setting->given.name,
               setting->given.value, drive->table.name,
               cli_input_columns[i].name);
    }
  }
}

tf_input_t cli_drive_over(cli_drive_t *drive, const tf_machine_t *machine,
                          const cli_span_t *span) {
  tf_input_t input = tf_input_default(machine);
  cli_inputs_over(&drive->profile, span, &input);
  cli_inputs_over(&drive->table, span, &input);
  return input;
}

// The time of the first row of a linear table within a span, or its end.
static tf_real_t next_row(const cli_drive_t *drive, const cli_span_t *span) {
  const cli_inputs_t *const both[] = {&drive->profile, &drive->table};
  const tf_real_t off = span->off > SHORTEST ? span->off : SHORTEST;
  tf_real_t next = span->to, least = span->to - off;
  for (size_t i = 0; i < 2; i++) {
    size_t k = both[i]->at;
    while (k < both[i]->count && both[i]->rows[k].t <= span->from + off) k++;
    if (both[i]->linear && k < both[i]->count && both[i]->rows[k].t <= least)
      next = least = both[i]->rows[k].t;
  }
  return next;
}

tf_status_t cli_step_in_halves(cli_drive_t *drive, motion_t *motion,
                               const tf_input_t *input) {
  tf_real_t error;
  const tf_status_t status =
      tf_step_estimated(&motion->machine.machine, &motion->state, input,
                        drive->accuracy, &motion->report, &error);
  drive->error = error > drive->error ? error : drive->error;
  return status;
}

// The tick is the counter of the random generator, and each part draws for
// itself. Multiples of sqrt(2) 2^64 stay apart: modulo 2^64 those of two parts
// among n are at least 2^62 / n from each other, so that no step less than so
// many ticks away has the same draw.
#define PART_OF_TICK UINT64_C(0x6A09E667F3BCC909)

static tf_status_t take_parts(cli_drive_t *drive, const cli_setup_t *setup,
                              cli_span_t whole, motion_t *motion,
                              tf_input_t *input) {
  cli_span_t rest = whole;
  const motion_scheme_t scheme = setup->scheme;
  const tf_state_t before = motion->state;
  tf_report_t *report = &motion->report;
  tf_report_t met = {.status = TF_OK};
  for (uint64_t part = 0, last = 0; !last && met.status >= 0; part++) {
    cli_span_t span = rest;
    span.to = next_row(drive, &rest);
    last = !(span.to < rest.to);
    span.dt = last ? rest.dt : span.to - span.from;
    *input = cli_drive_over(drive, &setup->machine, &span);
    tf_params_t params = setup->params;
    params.dt = span.dt;
    (void)motion_prepare(motion, scheme, &params, NULL);
    motion->state.tick = before.tick + part * PART_OF_TICK;
    const size_t known = drive->changes.count;
    if (cli_step(drive, scheme, motion, input) >= 0 && met.status > TF_OK)
      report->status = met.status;
    for (size_t i = known; i < drive->changes.count; i++)
      drive->changes.list[i].time += span.from - whole.from;
    if (met.choices > report->choices) {
      report->choices = met.choices;
      report->set = met.set;
    }
    met = *report;
    rest.from = span.to;
    rest.dt -= span.dt;
  }
  motion->machine.machine = setup->machine;
  if (met.status < 0) {
    motion->state = before;
    drive->changes.count = 0;
  } else {
    motion->state.tick = before.tick + 1;
  }
  return met.status;
}

tf_status_t cli_drive_by_rows(cli_drive_t *drive, const cli_setup_t *setup,
                              motion_t *motion, tf_input_t *input) {
  const cli_span_t span = cli_span_of(motion->state.tick, setup->machine.dt);
  if (setup->scheme == MOTION_LOCATED && next_row(drive, &span) < span.to)
    return take_parts(drive, setup, span, motion, input);
  *input = cli_drive_over(drive, &setup->machine, &span);
  return cli_step(drive, setup->scheme, motion, input);
}

void cli_drive_free(cli_drive_t *drive) {
  cli_inputs_free(&drive->profile);
  cli_inputs_free(&drive->table);
}
