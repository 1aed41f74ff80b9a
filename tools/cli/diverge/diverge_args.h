/// @file
/// The command line of `diverge`.
#ifndef TWOFOLD_CLI_DIVERGE_ARGS_H
#define TWOFOLD_CLI_DIVERGE_ARGS_H

#include <stdbool.h>
#include <stdint.h>

#include "../setup/settings.h"
#include "../text/shard.h"
#include "mechanism.h"
#include "twofold.h"

/// What --by random does where the wheel comes to h = g = 0.
typedef enum {
  CLI_CODIM2_REST,       ///< pinned where that is consistent, as in `run`
  CLI_CODIM2_ATTRACTING, ///< the attracting stick where there is one: `persist`
  CLI_CODIM2_EVEN        ///< draws one of the consistent modes, all equally
} cli_codim2_choice_t;
#define CLI_CODIM2_CHOICES 3

/// The command line, read and validated except for the machine.
typedef struct {
  const tf_scene_t *scene;
  cli_settings_t settings;
  const char *exits, *returns; ///< paths, NULL: not written, "-": stdout
  const char *counts;          ///< likewise
  const char *branches;        ///< likewise, of --exhaustive
  bool exhaustive;
  const char *only_exhaustive; ///< an option that needs --exhaustive, or NULL
  bool resume;                 ///< goes on with the rows that are there
  bool header;                 ///< a header even if the shard is not the first
  bool provenance; ///< comments before the header: what the rows are of
  bool json;       ///< the summary
  cli_mechanism_t mechanism;
  const char *size_text; ///< as typed, NULL: not given
  cli_codim2_choice_t codim2;
  const char *codim2_name; ///< as typed; NULL: not given
  double size;             ///< unit: that of the mechanism; 0: not given
  double spread;           ///< sizes are drawn from [size / spread, size]
  double patience;         ///< longest cycle [s]
  double section; ///< distance behind the two-fold where the phase is read [m]
  double refinement; ///< dt / step near the two-fold
  double grid;       ///< of --exhaustive: time between two exits [s]
  uint64_t samples, cycles;
  cli_shard_t shard;
  uint64_t depth, count; ///< bounds of --exhaustive
  uint32_t seed;
} cli_diverge_args_t;

/// Reads the arguments after `diverge`.
/// Returns: CLI_DONE; after a message CLI_USAGE or CLI_REFUSED.
int cli_diverge_args(cli_diverge_args_t *args, int argc, char *const argv[]);

#endif
