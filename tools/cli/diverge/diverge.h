/// @file
/// The command `diverge`: samples of the motions that can follow a two-fold.
#ifndef TWOFOLD_CLI_DIVERGE_H
#define TWOFOLD_CLI_DIVERGE_H

#include "../setup/args.h"

// What selects the exit of a motion whose future is not unique: a random draw,
// or an imperfection that makes friction single-valued.

typedef enum {
  CLI_BY_RANDOM,     ///< a draw: exit at a rate, to either side
  CLI_BY_NOISE,      ///< additive white noise on h
  CLI_BY_SMOOTHING,  ///< sign(h) smoothed
  CLI_BY_HYSTERESIS, ///< friction changes its side at |h| = size
  CLI_BY_DELAY       ///< friction has the sign that h had some time ago
} cli_mechanism_t;
#define CLI_MECHANISMS 5

/// Name, unit of the size ("" where it has none), and default values.
typedef struct {
  const char *name, *unit;
  double dt;         ///< step [s]
  double refinement; ///< dt / step near the two-fold
  double spread;     ///< sizes are drawn from [size / spread, size]
} cli_mechanism_info_t;
extern const cli_mechanism_info_t cli_mechanisms[CLI_MECHANISMS];

/// What --by random does where the wheel comes to h = g = 0.
typedef enum {
  CLI_CODIM2_REST,       ///< pinned where that is consistent, as in `run`
  CLI_CODIM2_ATTRACTING, ///< the attracting stick where there is one: `persist`
  CLI_CODIM2_EVEN        ///< draws one of the consistent modes, all equally
} cli_codim2_choice_t;

/// Checks options that need or exclude each other, and sets what depends on
/// others.
int cli_diverge_check(cli_args_t *args);

int cli_diverge(const cli_args_t *args);

#endif
