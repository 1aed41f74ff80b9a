// What a command line says of a motion as a whole: its scheme and its length.

#include "args.h"

#include <math.h>

// Float loses a motion in the rounding of its state at shorter steps [s].
#define SHORT_STEP TF_R(1e-3)

int cli_setup_scheme(cli_setup_t *setup, const cli_args_t *args) {
  const tf_real_t dt = setup->params.dt;
  const bool rounds = dt < SHORT_STEP && sizeof dt == sizeof(float);
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
