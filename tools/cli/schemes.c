// The schemes that a run can take, as functions of one shape. What a scheme
// does not use of a body stays as it is, so rows, events and the summary need
// not know which scheme they tell of.

#include "run.h"
#include "twofold/compensated.h"

static tf_status_t step_moreau(cli_body_t *body, const tf_input_t *input,
                               tf_report_t *report) {
  return tf_step(&body->machine.machine, &body->state, input, report);
}

static tf_status_t step_located(cli_body_t *body, const tf_input_t *input,
                                tf_report_t *report) {
  return tf_step_located(&body->machine.machine, &body->state, input, report);
}

static tf_status_t step_compensated(cli_body_t *body, const tf_input_t *input,
                                    tf_report_t *report) {
  return tf_step_compensated(&body->machine, &body->state, &body->carry, input,
                             report);
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

void cli_body_begin(cli_body_t *body, const cli_scheme_t *scheme,
                    const cli_setup_t *setup, tf_report_t *report) {
  *body = (cli_body_t){.state = setup->state};
  body->machine.machine = setup->machine;
  if (scheme->step != step_compensated) {
    return;
  }
  // The setup has prepared and begun the same machine: neither can fail.
  (void)tf_prepare_compensated(&body->machine, &setup->params, NULL);
  if (setup->placed) {
    (void)tf_speed_for_slip_compensated(&body->machine, &body->state,
                                        &body->carry, setup->input.omega0,
                                        setup->start[CLI_START_H]);
    (void)tf_begin(&body->machine.machine, &body->state, &setup->input, report);
  }
}
