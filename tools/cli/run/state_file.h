/// @file
/// Where a run stands, as a file from which another run goes on bit for bit:
/// the state, the compensation, the last report, and what they belong to.
#ifndef TWOFOLD_CLI_STATE_FILE_H
#define TWOFOLD_CLI_STATE_FILE_H

#include <stdbool.h>

#include "../setup/args.h"

/// Room for the text of a file.
#define CLI_STATE_BYTES 8192

/// Inputs that a board got by a command, which hold on or have expired; the
/// members are those of tf_simulation_t. Under TF_INPUT_SCENE there are none.
typedef struct {
  tf_input_source_t source;
  uint32_t deadman, left;
  tf_input_t input;
} cli_held_t;

typedef struct {
  tf_state_t state;
  tf_compensation_t compensation;
  tf_report_t report; ///< of the last step, or of the start
  uint32_t inputs;    ///< cli_inputs_hash of what drove it
  cli_held_t held;
} cli_stand_t;

/// Writes it as text.
/// setup: in, whose machine and scene it belongs to.
size_t cli_state_print(const cli_stand_t *stand, const cli_setup_t *setup,
                       const cli_scheme_t *scheme, char out[CLI_STATE_BYTES]);

/// Reads it from text. The machine, the profile of the scene, the scheme and
/// the number type have to be those with which it was written, bit for bit.
/// text: in/out, size bytes and a zero behind them; it is cut into lines.
/// setup: in, its parameters, which need not be prepared.
/// scheme: in/out, NULL: that of the text.
/// Returns: CLI_DONE; after a message that says what differs CLI_REFUSED, or
/// CLI_USAGE where the text is none of this kind.
int cli_state_parse(cli_stand_t *stand, const char *path, char *text,
                    size_t size, const cli_setup_t *setup,
                    const cli_scheme_t **scheme);

/// Reads it from a file.
/// Returns: as cli_state_parse; CLI_USAGE as well where it cannot be read.
int cli_state_read(cli_stand_t *stand, const char *path,
                   const cli_setup_t *setup, const cli_scheme_t **scheme);

#endif
