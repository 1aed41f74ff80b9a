/// One point of a sweep: its settings, its motion, its row.
#pragma once

#include "../host/sheet.h"
#include "../host/workers.h"
#include "../run/events.h"
#include "../setup/args.h"

/// Name of a column, unit ("" of modes), what it is, and whether it is a count.
typedef struct {
  const char *name, *unit, *what;
  bool counts;
} cli_measure_info_t;
#define CLI_MEASURES 20
extern const cli_measure_info_t cli_measures[CLI_MEASURES];

/// How a motion ended.
typedef enum {
  CLI_POINT_DONE,    ///< or it goes on
  CLI_POINT_FLAGGED, ///< some steps were degraded, coarse or stalled
  CLI_POINT_STOPPED, ///< a step was refused
  CLI_POINT_REFUSED, ///< the machine or its start was refused
  CLI_POINT_ENDS
} cli_point_end_t;

/// Their names, as in the column `status`.
extern const char *const cli_point_ends[CLI_POINT_ENDS];

/// What was seen of a motion so far; zero before it begins. The Python package
/// has it, too.
#define CLI_REASON_ROOM 512
typedef struct {
  char reason[CLI_REASON_ROOM]; ///< of the end, empty where it is done
  cli_point_end_t end;
  uint64_t steps;
  tf_input_t input;    ///< of the last step
  tf_report_t report;  ///< of the last step that was looked at
  tf_real_t low, high; ///< of r [m], where all steps were
  double dt;           ///< [s]
  tf_tally_t tally;
  cli_events_t events;
  unsigned modes; ///< bits TF_MODE_BIT
  uint64_t changes, stuck;
  double pinned_since;                ///< [s], of the last time
  double first_arrival, last_arrival; ///< at the two-fold [s]
  double energy_at_start;             ///< [J]
} cli_outcome_t;

/// The motion has begun, under the input.
void cli_outcome_begin(cli_outcome_t *seen, const motion_t *motion,
                       const tf_input_t *input);

/// Looks at step i, behind one with the report `before`, whose state and input
/// these are, and at the changes within it.
void cli_outcome_see(cli_outcome_t *seen, uint64_t i, const tf_report_t *before,
                     const tf_report_t *report, const tf_state_t *state,
                     const tf_input_t *input, const motion_changes_t *within);

/// The motion is at its end. values: out, in the order of cli_measures; modes
/// are sets, NaN is what there is not. Returns: how it ended.
cli_point_end_t cli_outcome_end(cli_outcome_t *seen, const motion_t *motion,
                                double values[CLI_MEASURES]);

/// tf_ensemble_step, by the vectors of AVX2 where processor and program have
/// them.
size_t cli_step_lanes(const tf_machine_t *machine, tf_state_block_t *states,
                      size_t n, const tf_input_t *input,
                      tf_report_block_t *reports);

/// Motions of one machine that are followed together, one in each lane; all
/// but the first three is their own.
typedef struct {
  motion_t *motion[TF_LANES];    ///< begun; behind the last step at its end
  cli_outcome_t *seen[TF_LANES]; ///< begun
  size_t count, going;           ///< motions, and those that go on
  tf_state_block_t states;
  tf_report_block_t reports[2];            // of even and of odd steps
  tf_input_t input;                        // of the last step
  tf_real_t low[TF_LANES], high[TF_LANES]; // of r [m]
} cli_lanes_t;

void cli_lanes_begin(cli_lanes_t *lanes);

/// Takes step i of the motions that go on.
void cli_lanes_step(cli_lanes_t *lanes, uint64_t i, const tf_input_t *input);

/// So many steps have been taken, or no motion goes on.
void cli_lanes_end(cli_lanes_t *lanes, uint64_t steps);

#define CLI_SWEEP_ROW 2048

/// What has become of some points.
typedef struct {
  size_t used;                  ///< bytes of the rows
  uint8_t ends[CLI_POINT_ENDS]; ///< counts
  char rows[TF_LANES * CLI_SWEEP_ROW];
} cli_chunk_t;

typedef struct {
  const cli_args_t *args;
  motion_scheme_t scheme; ///< MOTION_SCHEMES: that of the first point
  uint32_t hash;          ///< of what a motion depends on and no option names
  size_t together;   ///< how many points are followed together, one in each
                     ///< lane of an ensemble: 1 where an axis changes the
                     ///< machine, or its law or scheme has no lanes
  cli_drive_t drive; ///< of --inputs, and of the scene
  cli_sheets_t sheets;
  unsigned jobs;                 ///< processes
  cli_workers_t workers;         ///< none: this process follows all points
  uint64_t ends[CLI_POINT_ENDS]; ///< counts
} cli_sweep_t;

/// Checks what is the same at all points, and the ends of every axis; sets all
/// of the sweep that is not known before.
int cli_point_check(cli_sweep_t *sweep);

/// Follows the motions at so many points to their ends.
/// index: in, of the first, 0 to points - 1; the last axis is the inner loop.
/// count: in, 1 to sweep->together. chunk: out.
/// Returns: whether they came there: no stop is asked for.
bool cli_points_follow(cli_sweep_t *sweep, uint64_t index, size_t count,
                       cli_chunk_t *chunk);
