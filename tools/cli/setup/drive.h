/// @file
/// What drives a machine: the profile of its scene, and over it a table that
/// the command line gives.
#ifndef TWOFOLD_CLI_DRIVE_H
#define TWOFOLD_CLI_DRIVE_H

#include "inputs.h"
#include "setup.h"

typedef struct {
  cli_inputs_t profile; ///< of the scene
  cli_inputs_t table;   ///< of --inputs; without rows if there is none
} cli_drive_t;

/// The options --inputs and --between as typed, NULL: not given.
typedef struct {
  const char *inputs, *between;
} cli_drive_args_t;

/// Reads what drives a scene.
/// drive: out; to be freed by cli_drive_free, whatever is returned.
/// Returns: CLI_DONE; after a message as cli_inputs_read, and CLI_USAGE where
/// only one of the options is given.
int cli_drive_read(cli_drive_t *drive, const tf_scene_t *scene,
                   const cli_drive_args_t *args);

/// Prepares it for the machine of a setup and sets the inputs of the setup at
/// t = 0.
void cli_drive_begin(cli_drive_t *drive, cli_setup_t *setup);

/// Reports on standard error which settings have no effect beside the table.
void cli_drive_notes(const cli_drive_t *drive, const cli_setup_t *setup);

/// Goes to a tick and its time, at which a run begins that goes on from another
/// one.
void cli_drive_go_to(cli_drive_t *drive, uint64_t tick, tf_real_t t);

/// Inputs for the step of a machine from a tick to the next one.
/// t: in, time at the end of that step [s].
tf_input_t cli_drive_step(cli_drive_t *drive, const tf_machine_t *machine,
                          uint64_t tick, tf_real_t t);

void cli_drive_free(cli_drive_t *drive);

#endif
