// The steps on any machine, any state and any inputs, bits of every kind: no
// undefined behaviour, whatever tf_prepare and the caller did. Every pointer is
// to one object of its type, as the headers ask.
#include "any.h"
#include "twofold/compensated.h"
#include "twofold/ensemble.h"
#include "twofold/step.h"

// Every state; modes that exist are looked at one by one.
static tf_state_t state_by_mode(void) {
  tf_state_t state = any_state();
  const int mode = Frama_C_interval(0, TF_MODES);
  //@ split mode;
  state.mode =
      (uint8_t)(mode < TF_MODES ? mode : Frama_C_interval(TF_MODES, 255));
  return state;
}

void step_any(void);
void step_any(void) {
  const tf_machine_t machine = any_machine();
  tf_state_t state = state_by_mode();
  const tf_input_t input = any_input();
  tf_report_t report;
  tf_step(&machine, &state, &input, &report);
  //@ check reached: \false;
}

void begin_any(void);
void begin_any(void) {
  const tf_machine_t machine = any_machine();
  tf_state_t state = any_state();
  const tf_input_t input = any_input();
  tf_report_t report;
  tf_begin(&machine, &state, &input, &report);
  //@ check reached: \false;
}

void compensated_any(void);
void compensated_any(void) {
  tf_compensated_t machine;
  ANY_BITS(machine);
  machine.machine = any_machine();
  tf_state_t state = state_by_mode();
  tf_compensation_t compensation;
  ANY_BITS(compensation);
  const tf_input_t input = any_input();
  tf_report_t report;
  tf_speed_for_slip_compensated(&machine, &state, &compensation, any_real(),
                                any_real());
  tf_step_compensated(&machine, &state, &compensation, &input, &report);
  //@ check reached: \false;
}

// Of any number of states up to two blocks and a bit.
#define STATES (2 * TF_LANES + 3)

void ensemble_any(void);
void ensemble_any(void) {
  const tf_machine_t machine = any_machine();
  tf_state_block_t states[TF_BLOCKS(STATES)];
  tf_report_block_t reports[TF_BLOCKS(STATES)];
  const size_t n = Frama_C_size_t_interval(0, STATES);
  const tf_input_t input = any_input();
  ANY_BITS(states);
  ANY_BITS(reports);
  tf_ensemble_step(&machine, states, n, &input, reports);
  //@ check reached: \false;
}
