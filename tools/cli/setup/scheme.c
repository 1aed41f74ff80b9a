// The schemes by which the command line advances a motion, and what it says of
// them.

#include <math.h>

#include "../text/text.h"
#include "args.h"
#include "setup.h"
#include "twofold/step.h"

// Float loses a motion in the rounding of its state at shorter steps [s].
#define SHORT_STEP TF_R(1e-3)

int cli_setup_scheme(cli_setup_t *setup, const cli_args_t *args) {
  const tf_real_t dt = setup->params.dt;
  const bool rounds = sizeof dt == sizeof(float) && dt < SHORT_STEP;
  const motion_scheme_t usual = rounds ? MOTION_COMPENSATED : MOTION_MOREAU;
  if (args->scheme != CLI_NOT_GIVEN) {
    setup->scheme = (motion_scheme_t)args->scheme;
  } else if (setup->scheme == MOTION_SCHEMES) {
    setup->scheme = usual;
    if (rounds) {
      (void)cli_message(CLI_DONE,
                        "note: float at dt = %g s: --scheme compensated; "
                        "moreau would lose slow motions in the rounding of the "
                        "state",
                        (double)dt);
    }
  } else if (setup->scheme != usual) {
    (void)cli_message(CLI_DONE, "note: --scheme %s, which is that of %s",
                      motion_scheme_name(setup->scheme),
                      args->from != NULL ? args->from : args->replay);
  }
  return motion_takes_law(setup->scheme, setup->params.law)
             ? CLI_DONE
             : cli_message(CLI_REFUSED,
                           "--scheme %s: law must be " MOTION_LOCATED_LAWS
                           ", not %s; --scheme moreau takes every law",
                           motion_scheme_name(setup->scheme),
                           tf_tyre_law_name(setup->params.law));
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

tf_status_t cli_step(cli_drive_t *drive, motion_scheme_t scheme,
                     motion_t *motion, const tf_input_t *input) {
  if (!(drive->accuracy > 0)) {
    return motion_step(motion, scheme, input);
  }
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

tf_status_t cli_drive_take(cli_drive_t *drive, const cli_setup_t *setup,
                           motion_t *motion, tf_input_t *input) {
  const motion_scheme_t scheme = setup->scheme;
  const tf_state_t before = motion->state;
  tf_report_t *report = &motion->report;
  cli_span_t rest = cli_span_of(before.tick, setup->machine.dt);
  tf_report_t met = {.status = TF_OK};
  for (uint64_t part = 0, last = 0; !last && met.status >= 0; part++) {
    cli_span_t span = rest;
    span.to = scheme == MOTION_LOCATED ? cli_drive_next(drive, &rest) : rest.to;
    last = !(span.to < rest.to);
    span.dt = last ? rest.dt : span.to - span.from;
    *input = cli_drive_over(drive, &setup->machine, &span);
    if (last && part == 0) {
      return cli_step(drive, scheme, motion, input);
    }
    tf_params_t params = setup->params;
    params.dt = span.dt;
    (void)motion_prepare(motion, scheme, &params, NULL);
    motion->state.tick = before.tick + part * PART_OF_TICK;
    if (cli_step(drive, scheme, motion, input) >= 0 && met.status > TF_OK) {
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
  motion->machine.machine = setup->machine;
  if (met.status < 0) {
    motion->state = before;
  } else {
    motion->state.tick = before.tick + 1;
  }
  return met.status;
}
