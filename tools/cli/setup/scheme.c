// The schemes as functions of one signature. A scheme leaves the parts of the
// system that it does not use as they are, so rows, events and the summary do
// not depend on the scheme.

#include <math.h>

#include "../text/message.h"
#include "args.h"
#include "setup.h"
#include "twofold/compensated.h"
#include "twofold/estimated.h"

static tf_status_t step_moreau(cli_system_t *system, const tf_input_t *input,
                               tf_report_t *report) {
  const tf_machine_t *machine = &system->machine.machine;
  if (!(system->accuracy > 0)) {
    return tf_step(machine, &system->state, input, report);
  }
  tf_real_t error;
  const tf_status_t status = tf_step_estimated(
      machine, &system->state, input, system->accuracy, report, &error);
  system->error = error > system->error ? error : system->error;
  return status;
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
    {"moreau", 0, step_moreau, false, ALL_LAWS, "tolerance",
     "under --scheme moreau: it belongs to --scheme located"},
    {"located", 1, step_located, true, LAW(JUMP) | LAW(COULOMB) | LAW(NONE),
     "theta", "under --scheme located but where a step falls back on moreau"},
    {"compensated", 2, step_compensated, false, ALL_LAWS, "tolerance",
     "under --scheme compensated: it belongs to --scheme located"},
};

// Float loses a motion in the rounding of its state at shorter steps [s].
#define SHORT_STEP TF_R(1e-3)

const cli_scheme_t *cli_scheme_for(const cli_args_t *args, tf_real_t dt,
                                   const cli_scheme_t *there) {
  if (args->scheme != CLI_NOT_GIVEN) {
    return &cli_schemes[args->scheme];
  }
  const bool rounds = sizeof dt == sizeof(float) && dt < SHORT_STEP;
  if (there != NULL) {
    if (there != &cli_schemes[rounds ? 2 : 0]) {
      (void)cli_message(CLI_DONE, "note: --scheme %s, which is that of %s",
                        there->name,
                        args->from != NULL ? args->from : args->replay);
    }
    return there;
  }
  if (rounds) {
    (void)cli_message(CLI_DONE,
                      "note: float at dt = %g s: --scheme compensated; moreau "
                      "would lose slow motions in the rounding of the state",
                      (double)dt);
  }
  return &cli_schemes[rounds ? 2 : 0];
}

int cli_check_law(const cli_scheme_t *scheme, tf_tyre_law_t law) {
  if (((scheme->laws >> (unsigned)law) & 1u) != 0) {
    return CLI_DONE;
  }
  return cli_message(CLI_REFUSED,
                     "--scheme %s: law must be jump, coulomb or none, not "
                     "%s; --scheme moreau takes every law",
                     scheme->name, tf_tyre_law_name(law));
}

tf_real_t cli_end_of(const cli_args_t *args) {
  return args->t_end.text != NULL ? (tf_real_t)args->t_end.from
                                  : args->scene->t_end;
}

int cli_count_steps(const cli_args_t *args, tf_real_t dt, uint64_t *steps) {
  const char *text = args->t_end.text;
  const tf_real_t t_end = cli_end_of(args);
  const double count = round((double)t_end / (double)dt);
  const double most = (double)CLI_MAX_STEPS;
  if (!(t_end >= 0 && count <= most)) {
    return cli_message(CLI_REFUSED,
                       "--t-end %s: t-end must lie in [0, %g] s (at most 1e15 "
                       "steps of dt = %g s)",
                       text != NULL ? text : "", most * (double)dt, (double)dt);
  }
  *steps = (uint64_t)count;
  return CLI_DONE;
}

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

// The tick is the counter of the random generator, and each part draws for
// itself. Multiples of sqrt(2) 2^64 stay apart: modulo 2^64 those of two parts
// among n are at least 2^62 / n from each other, so that no step less than so
// many ticks away has the same draw.
#define PART_OF_TICK UINT64_C(0x6A09E667F3BCC909)

tf_status_t cli_drive_take(cli_drive_t *drive, const cli_scheme_t *scheme,
                           const cli_setup_t *setup, cli_system_t *system,
                           tf_input_t *input, tf_report_t *report) {
  const tf_state_t before = system->state;
  cli_span_t rest = cli_span_of(before.tick, setup->machine.dt);
  tf_report_t met = {.status = TF_OK};
  for (uint64_t part = 0, last = 0; !last && met.status >= 0; part++) {
    cli_span_t span = rest;
    span.to = scheme->splits ? cli_drive_next(drive, &rest) : rest.to;
    last = !(span.to < rest.to);
    span.dt = last ? rest.dt : span.to - span.from;
    *input = cli_drive_over(drive, &setup->machine, &span);
    if (last && part == 0) {
      return scheme->step(system, input, report);
    }
    tf_params_t params = setup->params;
    params.dt = span.dt;
    (void)tf_prepare(&system->machine.machine, &params, NULL);
    system->state.tick = before.tick + part * PART_OF_TICK;
    if (scheme->step(system, input, report) >= 0 && met.status > TF_OK) {
      report->status = met.status;
    }
    if (met.choices > report->choices) {
      report->choices = met.choices;
      report->set = met.set;
    }
    met = *report;
    rest.from = span.to;
    rest.dt -= span.dt;
  }
  system->machine.machine = setup->machine;
  if (met.status < 0) {
    system->state = before;
  } else {
    system->state.tick = before.tick + 1;
  }
  return met.status;
}
