/// One point of a sweep: its settings, its motion, its row.
#pragma once

#include "../host/sheet.h"
#include "../host/workers.h"
#include "../setup/args.h"

/// Name of a column, unit ("" of modes), what it is, and whether it is a count.
typedef struct {
  const char *name, *unit, *what;
  bool counts;
} cli_measure_info_t;
#define CLI_MEASURES 20
extern const cli_measure_info_t cli_measures[CLI_MEASURES];

/// How a point ended.
typedef enum {
  CLI_POINT_DONE,
  CLI_POINT_FLAGGED, ///< some steps were degraded, coarse or stalled
  CLI_POINT_STOPPED, ///< a step was refused
  CLI_POINT_REFUSED, ///< the machine or its start was refused
  CLI_POINT_ENDS
} cli_point_end_t;

/// Their names, as in the column `status`.
extern const char *const cli_point_ends[CLI_POINT_ENDS];

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
