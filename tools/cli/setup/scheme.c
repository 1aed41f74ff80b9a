// The schemes as functions of one signature. A scheme leaves the parts of the
// system that it does not use as they are, so rows, events and the summary do
// not depend on the scheme.

#include "scheme.h"

#include "twofold/compensated.h"

static tf_status_t step_moreau(cli_system_t *system, const tf_input_t *input,
                               tf_report_t *report) {
  return tf_step(&system->machine.machine, &system->state, input, report);
}

static tf_status_t step_located(cli_system_t *system, const tf_input_t *input,
                                tf_report_t *report) {
  return tf_step_located(&system->machine.machine, &system->state, input,
                         report);
}

static tf_status_t step_compensated(cli_system_t *system,
                                    const tf_input_t *input,
                                    tf_report_t *report) {
  return tf_step_compensated(&system->machine, &system->state,
                             &system->compensation, input, report);
}

#define LAW(name) (1u << TF_TYRE_##name)
#define ALL_LAWS ((1u << TF_TYRE_LAWS) - 1)
const cli_scheme_t cli_schemes[CLI_SCHEMES] = {
    {"moreau", 0, step_moreau, ALL_LAWS, "tolerance",
     "under --scheme moreau: it belongs to --scheme located"},
    {"located", 1, step_located, LAW(JUMP) | LAW(COULOMB) | LAW(NONE), "theta",
     "under --scheme located but where a step falls back on moreau"},
    {"compensated", 2, step_compensated, ALL_LAWS, "tolerance",
     "under --scheme compensated: it belongs to --scheme located"},
};

void cli_system_begin(cli_system_t *system, const cli_scheme_t *scheme,
                      const cli_setup_t *setup, tf_report_t *report) {
  *system = (cli_system_t){.state = setup->state};
  system->machine.machine = setup->machine;
  if (scheme->step != step_compensated) {
    return;
  }
  // The setup has prepared and begun the same machine, so neither can fail.
  (void)tf_prepare_compensated(&system->machine, &setup->params, NULL);
  if (setup->v_from_h) {
    (void)tf_speed_for_slip_compensated(
        &system->machine, &system->state, &system->compensation,
        setup->input.omega0, setup->start[CLI_START_H]);
    (void)tf_begin(&system->machine.machine, &system->state, &setup->input,
                   report);
  }
}
