// Text to the reader of inputs over time. The first byte says what holds
// between two rows, the rest is the table. What is accepted has times that
// grow, values in their ranges, and inputs in their ranges at every step.
#include "cli/setup/inputs.h"
#include "cli/text/text.h"
#include "verify/fuzz/fuzz.h"

#define STEPS 64

static int in_ranges(const tf_real_t *value) {
  return fuzz_magnitude(value[CLI_INPUT_OMEGA0]) <= TF_R(1e6) &&
         fuzz_magnitude(value[CLI_INPUT_R0]) <= TF_R(1e6) &&
         fuzz_magnitude(value[CLI_INPUT_FORCE]) <= TF_STATE_LIMIT &&
         fuzz_magnitude(value[CLI_INPUT_TORQUE]) <= TF_STATE_LIMIT;
}

static const char *rows_hold(const cli_inputs_t *inputs) {
  FUZZ_HOLD(inputs->count >= 1);
  for (size_t i = 0; i < inputs->count; i++) {
    const cli_input_row_t *row = &inputs->rows[i];
    FUZZ_HOLD(fuzz_magnitude(row->t) <= TF_STATE_LIMIT);
    FUZZ_HOLD(i == 0 || row->t >= row[-1].t);
    FUZZ_HOLD(i < 2 || row->t > row[-2].t);
    FUZZ_HOLD(in_ranges(row->value));
    for (int k = 0; k < CLI_INPUTS; k++)
      FUZZ_HOLD(inputs->given[k] || fuzz_same(row->value[k], 0));
  }
  return NULL;
}

// From the tick at which some row begins to hold, and back to the start: the
// inputs are those of the table, and what it does not give stays.
static const char *look_up(cli_inputs_t *inputs, uint64_t tick, tf_real_t dt) {
  for (int i = 0; i < STEPS; i++, tick++) {
    tf_input_t input = {TF_R(7.0), TF_R(8.0), TF_R(9.0), TF_R(10.0),
                        TF_R(11.0)};
    const cli_span_t span = cli_span_of(tick, dt);
    cli_inputs_over(inputs, &span, &input);
    const tf_real_t value[CLI_INPUTS] = {input.omega0, input.r0, input.force,
                                         input.torque};
    FUZZ_HOLD(in_ranges(value) && fuzz_finite(input.alpha));
    for (int k = 0; k < CLI_INPUTS; k++)
      FUZZ_HOLD(inputs->given[k] || fuzz_same(value[k], (tf_real_t)(7 + k)));
  }
  return NULL;
}

static const char *judge(cli_inputs_t *inputs) {
  const tf_real_t dt = TF_R(1e-3);
  FUZZ_HOLD_ALL(rows_hold(inputs));
  const tf_real_t n = inputs->rows[inputs->count / 2].t / dt;
  const uint64_t middle = n < 1 ? 0 : n < TF_R(1e6) ? (uint64_t)n : 1000000;
  FUZZ_HOLD_ALL(look_up(inputs, middle, dt));
  return look_up(inputs, 0, dt);
}

const char *fuzz_table(const uint8_t *data, size_t size) {
  if (size < 2) return NULL;
  cli_inputs_t inputs = {.linear = (data[0] & 1u) != 0};
  const int code =
      cli_inputs_parse(&inputs, "fuzz.csv", (const char *)data + 1, size - 1);
  const char *broken = NULL;
  if (code == CLI_DONE) broken = judge(&inputs);
  cli_inputs_free(&inputs);
  FUZZ_HOLD(code == CLI_DONE || code == CLI_USAGE || code == CLI_REFUSED);
  // A zero hides from most readers what follows it.
  FUZZ_HOLD(code != CLI_DONE || memchr(data + 1, 0, size - 1) == NULL);
  return broken;
}
