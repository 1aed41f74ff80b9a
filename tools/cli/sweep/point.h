/// One point of a sweep: its settings, its motion, its row.
#pragma once

#include "../setup/args.h"
#include "../text/text.h"

#define CLI_SWEEP_ROW 2048 // room for a row or a header

/// Name of a column, unit ("" of modes), what it is, and whether it is a count.
typedef struct {
  const char *name, *unit, *what;
  bool counts;
} cli_measure_info_t;
#define CLI_MEASURES 19
extern const cli_measure_info_t cli_measures[CLI_MEASURES];

/// What all points share.
typedef struct {
  const cli_args_t *args;
  motion_scheme_t scheme; ///< MOTION_SCHEMES: that of the first point
  uint32_t hash;          ///< of what a motion depends on and no option names
  size_t together;   ///< how many points are followed together, one in each
                     ///< lane of an ensemble: 1 where an axis changes the
                     ///< machine, or its law or scheme has no lanes
  cli_drive_t drive; ///< of --inputs, and of the scene
} cli_sweep_t;

/// How a point ended.
typedef enum {
  CLI_POINT_DONE,
  CLI_POINT_FLAGGED, ///< some steps were degraded, coarse or stalled
  CLI_POINT_STOPPED, ///< a step was refused
  CLI_POINT_REFUSED  ///< the machine or its start was refused
} cli_point_end_t;
#define CLI_POINT_ENDS 4

/// Checks what is the same at all points, and the ends of every axis; sets all
/// of the sweep but the arguments and the drive.
int cli_point_check(cli_sweep_t *sweep);

/// Follows the motions at so many points, which stay until the next call.
/// index: in, of the first, 0 to points - 1; the last axis is the inner loop.
/// count: in, 1 to sweep->together.
/// Returns: whether they have come to their ends; false: a stop was asked for.
bool cli_points_follow(cli_sweep_t *sweep, uint64_t index, size_t count);

/// Writes the row of one of these points, with its newline.
/// index: in, as above. which: in, 0 to count - 1. length: out.
cli_point_end_t cli_point_row(uint64_t index, size_t which,
                              char row[CLI_SWEEP_ROW], size_t *length);

/// Name of an end, as in the column `status`.
const char *cli_point_status(cli_point_end_t end);
