/// @file
/// What a board did, from a record of `monitor --record`: each command
/// takes effect after the step at which it did there, by the functions that
/// the board calls, so the motion has the board's bits.
#ifndef TWOFOLD_CLI_REPLAY_H
#define TWOFOLD_CLI_REPLAY_H

#include "../setup/scheme.h"

/// A frame of the record: a command, or a state to compare with.
typedef struct {
  uint64_t tick;
  uint8_t type, length;
  uint8_t data[TF_FRAME_PAYLOAD];
} cli_replay_row_t;

typedef struct {
  const char *name; ///< of the file
  cli_replay_row_t schema;
  cli_replay_row_t *rows; ///< from the heap
  size_t count, room;
  size_t next; ///< row to come
  tf_simulation_t simulation;
  tf_link_t link;
  uint32_t sequence;
  uint64_t commands;  ///< that took effect
  uint64_t states;    ///< that were compared
  const char *failed; ///< why the replay is not the simulation, or NULL
} cli_replay_t;

/// Reads a record.
/// replay: in/out, empty; to be freed by cli_replay_free, whatever is returned.
/// path: in, kept, for messages. scheme: in/out, NULL: that of the board.
/// Returns: CLI_DONE; after a message CLI_USAGE, CLI_REFUSED (cut off or
/// changed) or CLI_STOPPED.
int cli_replay_read(cli_replay_t *replay, const char *path,
                    const cli_scheme_t **scheme);

/// Begins it at the start of a setup, which takes the seed of the board.
/// steps: out, how many the record has.
/// Returns: CLI_DONE; after a message CLI_REFUSED (another machine, scheme or
/// number type).
int cli_replay_begin(cli_replay_t *replay, cli_setup_t *setup,
                     const cli_scheme_t *scheme, uint64_t *steps);

/// Applies what is due before the next step of a system, and finds the inputs
/// of that step.
/// report: in/out, of the last step; where a command puts another state in the
/// place of the one that it led to, that of the other state.
/// Returns: whether there is a next step; not where replay->failed is set.
bool cli_replay_next(cli_replay_t *replay, cli_system_t *system,
                     const tf_scene_t *scene, tf_report_t *report,
                     tf_input_t *input);

void cli_replay_free(cli_replay_t *replay);

#endif
