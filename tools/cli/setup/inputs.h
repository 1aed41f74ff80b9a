/// Inputs over time: a table with a row for each time and a column for each
/// input that it gives; those that it does not give stay as they are.
///
/// held: a row holds from the first step that begins at its time or later until
///   the next row does.
/// linear: between rows. omega0 is that of the end of the step, alpha the mean
///   over the step, as in tf_scene_input and bit for bit the same; r0, force
///   and torque are constant over a step and the mean over it, so that no part
///   of a force is lost. Two rows of one time are a jump, of which alpha has no
///   part: within a step it acts on omega0 at the start of that step.
///
/// Before the first row and after the last one inputs are those of that row.
#pragma once

#include "setup.h"

/// The columns of a table beside t, which is the last in the list.
enum {
  CLI_INPUT_OMEGA0,
  CLI_INPUT_R0,
  CLI_INPUT_FORCE,
  CLI_INPUT_TORQUE,
  CLI_INPUTS
};
extern const tf_parameter_range_t cli_input_columns[CLI_INPUTS + 1];

typedef struct {
  tf_real_t t;                 ///< [s]
  tf_real_t value[CLI_INPUTS]; ///< 0 where the column is not given
} cli_input_row_t;

typedef struct {
  const char *name; ///< of the file, for messages
  bool linear;      ///< else held
  bool given[CLI_INPUTS + 1];
  cli_input_row_t *rows; ///< from the heap, NULL while empty
  size_t count, room;
  size_t at;            ///< row of the last look-up
  size_t first, last;   ///< rows that steps came to see, with the one behind
  size_t passed;        ///< rows of a held table that never held
  size_t within, jumps; ///< times of rows within a step, and jumps there
  bool applied; ///< to a step, or more of them; then their least and largest:
  tf_real_t low[CLI_INPUTS], high[CLI_INPUTS];
} cli_inputs_t;

/// Reads a table from text: CSV with the header `t,...`; lines that begin with
/// # are comments.
/// inputs: in/out; linear is set by the caller. name: in, kept, for messages.
int cli_inputs_parse(cli_inputs_t *inputs, const char *name, const char *text,
                     size_t size);

/// CRC-32 of all that a table gives: columns, what holds between rows, rows. 0
/// without rows.
uint32_t cli_inputs_hash(const cli_inputs_t *inputs);

/// A step, or a part of one.
typedef struct {
  tf_real_t from, to; ///< times of its ends [s]
  tf_real_t dt;       ///< its length, not rounded as they are [s]
  tf_real_t off;      ///< what is nearer to an end belongs to it [s]
} cli_span_t;

/// The step from a tick to the next one.
cli_span_t cli_span_of(uint64_t tick, tf_real_t dt);

/// Sets the inputs that the table gives over a span.
void cli_inputs_over(cli_inputs_t *inputs, const cli_span_t *span,
                     tf_input_t *input);

void cli_inputs_free(cli_inputs_t *inputs);

/// What drives a machine: the profile of its scene, without rows where the
/// table has its column, and over it the table of --inputs, without rows if
/// there is none.
typedef struct {
  cli_inputs_t profile, table;
  tf_real_t accuracy; ///< of a step of moreau; 0: its error is not estimated
  tf_real_t error;    ///< the largest estimate
  motion_changes_t changes; ///< of the last step; time: since its start
} cli_drive_t;

/// Reads both. drive: out; to be freed by cli_drive_free, whatever is returned.
/// inputs, between: in, the values of these options.
int cli_drive_read(cli_drive_t *drive, const tf_scene_t *scene,
                   const char *inputs, unsigned between);

/// Goes to a tick at which a run of a machine begins.
/// Returns: the inputs of that instant, with the alpha of the step behind it.
tf_input_t cli_drive_begin(cli_drive_t *drive, const tf_machine_t *machine,
                           uint64_t tick);

/// Notes which settings have no effect beside the table, and where its rows do
/// not fit a run between two times [s].
void cli_drive_notes(const cli_drive_t *drive, const cli_setup_t *setup,
                     double begin, double end);

/// Inputs of a machine over a span.
tf_input_t cli_drive_over(cli_drive_t *drive, const tf_machine_t *machine,
                          const cli_span_t *span);

/// A step of moreau as two halves, too: drive->accuracy is not 0.
tf_status_t cli_step_in_halves(cli_drive_t *drive, motion_t *motion,
                               const tf_input_t *input);

/// One step, whose changes are added. Returns: as motion_step.
static inline tf_status_t cli_step(cli_drive_t *drive, motion_scheme_t scheme,
                                   motion_t *motion, const tf_input_t *input) {
  return drive->accuracy > 0
             ? cli_step_in_halves(drive, motion, input)
             : motion_step_changes(motion, scheme, input, &drive->changes);
}

/// cli_drive_take where there are rows. Steps of scheme located are split at
/// the rows of a linear table: the report then has the largest set of the
/// parts, and the first status that is not TF_OK.
tf_status_t cli_drive_by_rows(cli_drive_t *drive, const cli_setup_t *setup,
                              motion_t *motion, tf_input_t *input);

/// Takes a step of a setup's machine under what drives it.
/// input: out, that of the step, or of its last part.
static inline tf_status_t cli_drive_take(cli_drive_t *drive,
                                         const cli_setup_t *setup,
                                         motion_t *motion, tf_input_t *input) {
  drive->changes.count = 0;
  if (drive->profile.count + drive->table.count > 0)
    return cli_drive_by_rows(drive, setup, motion, input);
  *input = setup->input;
  return cli_step(drive, setup->scheme, motion, input);
}

void cli_drive_free(cli_drive_t *drive);
