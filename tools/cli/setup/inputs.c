// Looking up inputs over time. Time only goes on, so a look-up begins at the
// row of the last one.

#include "inputs.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../text/message.h"
#include "../text/trailer.h"

const cli_quantity_t cli_input_columns[CLI_INPUTS] = {
    {"omega0", "rad/s"}, {"r0", "m"}, {"force", "N"}, {"torque", "N m"}};

bool cli_inputs_add(cli_inputs_t *inputs, const cli_input_row_t *row) {
  if (inputs->count == inputs->room) {
    const size_t room = inputs->room == 0 ? 64 : 2 * inputs->room;
    cli_input_row_t *rows = NULL;
    if (room <= SIZE_MAX / sizeof *rows) {
      rows = realloc(inputs->rows, room * sizeof *rows);
    }
    if (rows == NULL) {
      return false;
    }
    inputs->rows = rows;
    inputs->room = room;
  }
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
  cli_trailer_t sum = {0};
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
    cli_trailer_add(&sum, text, (size_t)length, 0);
  }
  return sum.crc;
}

// The first step that begins at a time or later. A time that is n dt but for
// the rounding of decimals is n; where that is coarser than a step, the step
// that begins next to it.
void cli_inputs_prepare(cli_inputs_t *inputs, tf_real_t dt) {
  for (size_t i = 0; i < inputs->count; i++) {
    const double n = (double)inputs->rows[i].t / (double)dt;
    const double rounding =
        fmin(1e-6 + 4 * (double)TF_REAL_EPSILON * fabs(n), 0.5);
    const double first = ceil(n - rounding);
    inputs->rows[i].tick =
        first < 1 ? 0 : (first < 1e18 ? (uint64_t)first : UINT64_MAX);
  }
  inputs->at = 0;
}

size_t cli_inputs_last(const cli_inputs_t *inputs, double t) {
  return inputs->at + (inputs->linear && inputs->at + 1 < inputs->count &&
                       (double)inputs->rows[inputs->at].t < t);
}

size_t cli_inputs_passed(const cli_inputs_t *inputs, size_t first,
                         size_t last) {
  size_t passed = 0;
  for (size_t i = first; !inputs->linear && i < last; i++) {
    passed += inputs->rows[i].tick == inputs->rows[i + 1].tick;
  }
  return passed;
}

static void go_to_tick(cli_inputs_t *inputs, uint64_t tick) {
  const cli_input_row_t *rows = inputs->rows;
  size_t i = inputs->at;
  while (i > 0 && rows[i].tick > tick) {
    i--;
  }
  while (i + 1 < inputs->count && rows[i + 1].tick <= tick) {
    i++;
  }
  inputs->at = i;
}

static void go_to_time(cli_inputs_t *inputs, tf_real_t t) {
  const cli_input_row_t *rows = inputs->rows;
  size_t i = inputs->at;
  while (i > 0 && rows[i].t > t) {
    i--;
  }
  while (i + 1 < inputs->count && rows[i + 1].t <= t) {
    i++;
  }
  inputs->at = i;
}

// The inputs at a time, between two rows of a linear table. The order of the
// operations is that of tf_scene_input.
static void look_up(cli_inputs_t *inputs, tf_real_t t,
                    tf_real_t value[CLI_INPUTS]) {
  go_to_time(inputs, t);
  const cli_input_row_t *row = &inputs->rows[inputs->at];
  const bool between = inputs->at + 1 < inputs->count && t > row->t;
  for (size_t i = 0; i < CLI_INPUTS; i++) {
    value[i] = row->value[i];
    if (between && inputs->given[i]) {
      value[i] += (row[1].value[i] - row->value[i]) *
                  ((t - row->t) / (row[1].t - row->t));
    }
  }
}

// The mean over a step from `start` to t of one input, piece by piece where
// rows lie in it: from row `next` on. A mean is never outside of its values,
// whatever the rounding.
static tf_real_t mean_of(const cli_inputs_t *inputs, size_t column, size_t next,
                         tf_real_t start, tf_real_t t, tf_real_t before,
                         tf_real_t after) {
  tf_real_t from = start, value = before, sum = 0;
  tf_real_t low = before < after ? before : after;
  tf_real_t high = before < after ? after : before;
  if (next == inputs->count || !(inputs->rows[next].t < t)) {
    return (before + after) / 2;
  }
  for (size_t k = next; k < inputs->count && inputs->rows[k].t < t; k++) {
    const tf_real_t then = inputs->rows[k].value[column];
    sum += (value + then) / 2 * ((inputs->rows[k].t - from) / (t - start));
    from = inputs->rows[k].t;
    value = then;
    low = then < low ? then : low;
    high = then > high ? then : high;
  }
  sum += (value + after) / 2 * ((t - from) / (t - start));
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

// Sets the inputs of a step, and notes between which values they have been.
static void apply(cli_inputs_t *inputs, const tf_real_t value[CLI_INPUTS],
                  tf_input_t *input) {
  for (size_t i = 0; i < CLI_INPUTS; i++) {
    if (!inputs->applied || value[i] < inputs->low[i]) {
      inputs->low[i] = value[i];
    }
    if (!inputs->applied || value[i] > inputs->high[i]) {
      inputs->high[i] = value[i];
    }
  }
  inputs->applied = true;
  set(inputs, value, input);
}

void cli_inputs_step(cli_inputs_t *inputs, uint64_t tick, tf_real_t t,
                     tf_real_t dt, tf_input_t *input) {
  tf_real_t before[CLI_INPUTS], after[CLI_INPUTS], mean[CLI_INPUTS];
  if (inputs->count == 0) {
    return;
  }
  if (!inputs->linear) {
    go_to_tick(inputs, tick);
    apply(inputs, inputs->rows[inputs->at].value, input);
    return;
  }
  look_up(inputs, t - dt, before);
  // The first row after the begin of the step.
  const size_t next = inputs->at + (inputs->rows[inputs->at].t <= t - dt);
  look_up(inputs, t, after);
  for (size_t i = 0; i < CLI_INPUTS; i++) {
    mean[i] = mean_of(inputs, i, next, t - dt, t, before[i], after[i]);
  }
  mean[CLI_INPUT_OMEGA0] = after[CLI_INPUT_OMEGA0];
  apply(inputs, mean, input);
  if (inputs->given[CLI_INPUT_OMEGA0]) {
    input->alpha = (after[CLI_INPUT_OMEGA0] - before[CLI_INPUT_OMEGA0]) / dt;
  }
}

// Sets the inputs that the table gives at the instant at which a run starts;
// alpha is 0.
static void begin_at(cli_inputs_t *inputs, uint64_t tick, tf_real_t t,
                     tf_input_t *input) {
  tf_real_t value[CLI_INPUTS];
  if (inputs->count == 0) {
    return;
  }
  if (inputs->linear) {
    look_up(inputs, t, value);
    set(inputs, value, input);
  } else {
    go_to_tick(inputs, tick);
    set(inputs, inputs->rows[inputs->at].value, input);
  }
  inputs->first = inputs->at;
}

void cli_inputs_free(cli_inputs_t *inputs) {
  free(inputs->rows);
  inputs->rows = NULL;
  inputs->count = inputs->room = 0;
}

// The profile of a scene and a table of one's own are the same kind of thing;
// the latter is applied over the former, column by column.

void cli_drive_begin(cli_drive_t *drive, cli_setup_t *setup) {
  cli_inputs_prepare(&drive->profile, setup->machine.dt);
  cli_inputs_prepare(&drive->table, setup->machine.dt);
  setup->input = tf_input_default(&setup->machine);
  begin_at(&drive->profile, 0, 0, &setup->input);
  begin_at(&drive->table, 0, 0, &setup->input);
}

void cli_drive_notes(const cli_drive_t *drive, const cli_setup_t *setup) {
  for (size_t i = 0; i < CLI_INPUTS; i++) {
    const cli_setting_t *setting =
        cli_setup_setting(setup, cli_input_columns[i].name);
    if (drive->table.given[i] && setting != NULL) {
      (void)cli_message(CLI_DONE, "note: %s %s has no effect: %s gives %s",
                        setting->option, setting->text, drive->table.name,
                        cli_input_columns[i].name);
    }
  }
}

void cli_drive_go_to(cli_drive_t *drive, uint64_t tick, tf_real_t t) {
  tf_input_t input = {0, 0, 0, 0, 0};
  begin_at(&drive->profile, tick, t, &input);
  begin_at(&drive->table, tick, t, &input);
}

tf_input_t cli_drive_step(cli_drive_t *drive, const tf_machine_t *machine,
                          uint64_t tick, tf_real_t t) {
  tf_input_t input = tf_input_default(machine);
  cli_inputs_step(&drive->profile, tick, t, machine->dt, &input);
  cli_inputs_step(&drive->table, tick, t, machine->dt, &input);
  return input;
}

void cli_drive_free(cli_drive_t *drive) {
  cli_inputs_free(&drive->profile);
  cli_inputs_free(&drive->table);
}
