// Values of every kind, for the entries of the analysis.
#ifndef TF_EVA_ANY_H
#define TF_EVA_ANY_H

#include <__fc_builtin.h>

#include "twofold/machine.h"
#include "twofold/simulation.h"

// A function that the analyser begins with.
#define ENTRY(name) \
  void name(void);  \
  void name(void)

// Every pattern of bits, NaN and infinities among the numbers.
#define ANY_BITS(object) Frama_C_make_unknown((char *)&(object), sizeof(object))

// Every number from low to high, both included.
#ifdef TF_REAL_FLOAT
#define REAL_BETWEEN Frama_C_float_interval
#else
#define REAL_BETWEEN Frama_C_double_interval
#endif

// Every number, infinities and NaN.
static inline tf_real_t any_real(void) {
  tf_real_t number;
  ANY_BITS(number);
  return number;
}

// A bool has two values; other bits are none, and no promise covers them.
static inline bool any_bool(void) { return Frama_C_interval(0, 1) != 0; }

static inline tf_real_t *member_of(tf_params_t *params, int i) {
  return (tf_real_t *)(void *)((char *)params + tf_parameter_ranges[i].offset);
}

// Every set of parameters in its ranges; its law is the caller's.
static inline tf_params_t params_in_range(void) {
  tf_params_t params;
  //@ loop unroll TF_PARAMETERS;
  for (int i = 0; i < TF_PARAMETERS; i++)
    *member_of(&params, i) =
        REAL_BETWEEN(tf_parameter_ranges[i].low, tf_parameter_ranges[i].high);
  params.rule = (tf_rule_t)Frama_C_interval(0, TF_RULES - 1);
  params.rest = (tf_rest_law_t)Frama_C_interval(0, TF_REST_LAWS - 1);
  params.with_angle = any_bool();
  return params;
}

// Every machine that tf_prepare could have made, and many more: any numbers,
// but a law and a rule that exist.
static inline tf_machine_t any_machine(void) {
  tf_machine_t machine;
  ANY_BITS(machine);
  machine.contact.tyre.law =
      (tf_tyre_law_t)Frama_C_interval(0, TF_TYRE_LAWS - 1);
  machine.contact.rule = (tf_rule_t)Frama_C_interval(0, TF_RULES - 1);
  machine.contact.rest = (tf_rest_law_t)Frama_C_interval(0, TF_REST_LAWS - 1);
  machine.with_angle = any_bool();
  return machine;
}

// Every state, in range or not. Its numbers are written one by one, as numbers:
// of mere bits the analyser cannot keep the result of a comparison.
static inline tf_state_t any_state(void) {
  tf_state_t state;
  ANY_BITS(state);
  state.r = any_real();
  state.v = any_real();
  state.w = any_real();
  return state;
}

static inline tf_input_t any_input(void) {
  return (tf_input_t){.omega0 = any_real(),
                      .r0 = any_real(),
                      .force = any_real(),
                      .torque = any_real(),
                      .alpha = any_real()};
}

#endif
