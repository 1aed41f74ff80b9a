// Looking up inputs over time. Time only goes on, so a look-up begins at the
// row of the last one.

#include "inputs.h"

#include <stdio.h>
#include <stdlib.h>

#include "../text/text.h"

const cli_quantity_t cli_input_columns[CLI_INPUTS] = {
    {"omega0", "rad/s"}, {"r0", "m"}, {"force", "N"}, {"torque", "N m"}};

bool cli_inputs_add(cli_inputs_t *inputs, const cli_input_row_t *row) {
  cli_input_row_t *rows =
      cli_grow(inputs->rows, inputs->count, &inputs->room, sizeof *rows);
  if (rows == NULL) {
    return false;
  }
  inputs->rows = rows;
  inputs->rows[inputs->count++] = *row;
  return true;
}

int cli_inputs_of_scene(cli_inputs_t *inputs, const tf_scene_t *scene) {
  *inputs = (cli_inputs_t){.name = "profile of the scene", .linear = true};
  inputs->given[CLI_INPUT_OMEGA0] = scene->knots > 0;
  for (size_t i = 0; i < scene->knots; i++) {
    const tf_knot_t *knot = &scene->profile[i];
    const cli_input_row_t row = {.t = knot->t,
                                 .value = {[CLI_INPUT_OMEGA0] = knot->omega0}};
    if (!cli_inputs_add(inputs, &row)) {
      return cli_message(CLI_STOPPED, "out of memory");
    }
  }
  return CLI_DONE;
}

uint32_t cli_inputs_hash(const cli_inputs_t *inputs) {
  char text[32 * (CLI_INPUTS + 1)];
  uint32_t sum = 0;
  for (size_t i = 0; i < inputs->count; i++) {
    const cli_input_row_t *row = &inputs->rows[i];
    int length =
        snprintf(text, sizeof text, "%d %a", inputs->linear, (double)row->t);
    for (size_t column = 0; column < CLI_INPUTS; column++) {
      if (inputs->given[column]) {
        length += snprintf(text + length, sizeof text - (size_t)length,
                           " %zu:%a", column, (double)row->value[column]);
      }
    }
    sum = cli_crc(sum, text, (size_t)length);
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
    if (!stands && t < row[1].t) {
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
  tf_real_t low = before < after ? before : after;
  tf_real_t high = before < after ? after : before;
  for (size_t k = next; k < end; k++) {
    const tf_real_t then = inputs->rows[k].value[column];
    sum += (value + then) / 2 * ((inputs->rows[k].t - from) / length);
    from = inputs->rows[k].t;
    value = then;
    low = then < low ? then : low;
    high = then > high ? then : high;
  }
  sum += (value + after) / 2 * ((span->to - from) / length);
  return sum < low ? low : sum > high ? high : sum;
}

static void set(const cli_inputs_t *inputs, const tf_real_t value[CLI_INPUTS],
                tf_input_t *input) {
  tf_real_t *const members[CLI_INPUTS] = {&input->omega0, &input->r0,
                                          &input->force, &input->torque};
  for (size_t i = 0; i < CLI_INPUTS; i++) {
    if (inputs->given[i]) {
      *members[i] = value[i];
    }
  }
  if (inputs->given[CLI_INPUT_OMEGA0]) {
    input->alpha = 0;
  }
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
  if (inputs->count == 0) {
    return;
  }
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
    mean[i] = mean_of(inputs, i, next, end, span, before[i], after[i]);
  }
  mean[CLI_INPUT_OMEGA0] = before[CLI_INPUT_OMEGA0] + jumps;
  set(inputs, mean, input);
  if (inputs->given[CLI_INPUT_OMEGA0]) {
    tf_turntable_to(input, after[CLI_INPUT_OMEGA0], span->dt);
  }
  mean[CLI_INPUT_OMEGA0] = after[CLI_INPUT_OMEGA0];
  note(inputs, mean);
}

// Sets the inputs that the table gives at the instant at which a run starts,
// with the alpha of its first step.
static void begin_at(cli_inputs_t *inputs, const cli_span_t *span,
                     tf_input_t *input) {
  tf_real_t value[CLI_INPUTS];
  if (inputs->count == 0) {
    return;
  }
  cli_inputs_over(inputs, span, input);
  const tf_real_t alpha = input->alpha;
  look_up(inputs, span->from, span->off, value);
  set(inputs, value, input);
  input->alpha = alpha;
  inputs->first = inputs->last = inputs->at;
  inputs->applied = false;
  inputs->passed = inputs->within = inputs->jumps = 0;
}

void cli_inputs_free(cli_inputs_t *inputs) {
  free(inputs->rows);
  inputs->rows = NULL;
  inputs->count = inputs->room = 0;
}

tf_input_t cli_drive_begin(cli_drive_t *drive, const tf_machine_t *machine,
                           uint64_t tick) {
  const cli_span_t span = cli_span_of(tick, machine->dt);
  tf_input_t input = tf_input_default(machine);
  begin_at(&drive->profile, &span, &input);
  begin_at(&drive->table, &span, &input);
  return input;
}

void cli_drive_notes(const cli_drive_t *drive, const cli_setup_t *setup) {
  for (size_t i = 0; i < CLI_INPUTS; i++) {
    const size_t number = cli_number_index(cli_input_columns[i].name);
    const cli_setting_t *setting =
        number < TF_PARAMETERS ? setup->set[number] : NULL;
    if (drive->table.given[i] && setting != NULL) {
      (void)cli_message(CLI_DONE, "note: %s %s has no effect: %s gives %s",
                        setting->option, setting->text, drive->table.name,
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

tf_real_t cli_drive_next(const cli_drive_t *drive, const cli_span_t *span) {
  const cli_inputs_t *const both[] = {&drive->profile, &drive->table};
  const tf_real_t off = span->off > SHORTEST ? span->off : SHORTEST;
  tf_real_t next = span->to, least = span->to - off;
  for (size_t i = 0; i < 2; i++) {
    size_t k = both[i]->at;
    while (k < both[i]->count && both[i]->rows[k].t <= span->from + off) k++;
    if (both[i]->linear && k < both[i]->count && both[i]->rows[k].t <= least) {
      next = least = both[i]->rows[k].t;
    }
  }
  return next;
}

void cli_drive_free(cli_drive_t *drive) {
  cli_inputs_free(&drive->profile);
  cli_inputs_free(&drive->table);
}
