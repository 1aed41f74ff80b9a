// The step on any machine, any state and any inputs, bits of every kind: no
// undefined behaviour, whatever tf_prepare and the caller did. Every pointer is
// to one object of its type, as the headers ask.
#include "any.h"
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

ENTRY(step_any) {
  const tf_machine_t machine = any_machine();
  tf_state_t state = state_by_mode();
  const tf_input_t input = any_input();
  tf_report_t report;
  tf_step(&machine, &state, &input, &report);
  //@ check reached: \false;
}
