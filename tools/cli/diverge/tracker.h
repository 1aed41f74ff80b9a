/// @file
/// What is recorded of a motion, cycle by cycle: exit, windings, landing and
/// return to the two-fold.
#ifndef TWOFOLD_CLI_TRACKER_H
#define TWOFOLD_CLI_TRACKER_H

#include <stdint.h>

#include "canard.h"

/// An instant of a motion, as the tracker sees it.
typedef struct {
  double t; ///< since the start of the sample [s]
  cli_point_t at;
  double h, g;   ///< [m/s]
  bool on;       ///< on h = 0, or within the band that stands for it
  bool pinned;   ///< at rest at h = g = 0, for a while or for good
  bool released; ///< stick ended with the escaping region, not by a draw
} cli_instant_t;

/// How a cycle ended.
typedef enum {
  CLI_CYCLE_OPEN,     ///< it goes on
  CLI_CYCLE_RETURNED, ///< at the two-fold again
  CLI_CYCLE_SMALL,    ///< landed several times without coming back
  CLI_CYCLE_PINNED,   ///< at rest on the turntable
  CLI_CYCLE_TIMEOUT,  ///< none of these within the patience
  CLI_CYCLE_REFUSED   ///< a step was refused
} cli_outcome_t;
#define CLI_OUTCOMES 6
const char *cli_outcome_name(cli_outcome_t outcome);

/// One cycle, from one arrival at the two-fold to the next. Times are since the
/// start of the sample.
typedef struct {
  double arrived; ///< [s]; 0 where the sample starts elsewhere
  bool left;      ///< the surface was left
  bool released;  ///< the escaping region ended
  double exit_t, exit_r, exit_omega, exit_g;
  int side;          ///< of the exit, +1 or -1
  double phase;      ///< at the section [windings]; < 0: not there in slip
  double section_t;  ///< when it passed the section, if phase >= 0 [s]
  bool landed;       ///< on the upper sliding region
  double land_t;     ///< first time [s]
  double land_r;     ///< [m]
  uint64_t landings; ///< on the upper sliding region
  uint64_t windings; ///< changes of slip until the first landing
  double ended;      ///< [s]
  cli_outcome_t outcome;
} cli_cycle_t;

typedef struct {
  const tf_machine_t *machine;
  const cli_two_fold_t *two_fold;
  double section, patience;
  double dwell; ///< time within the band that counts as on the surface [s]
  cli_instant_t before, last;
  cli_cycle_t cycle;
  bool upper;       ///< on the upper sliding region at present
  double on_since;  ///< start of the present stay on the surface
  double on_r;      ///< where it began [m]
  int slip_side;    ///< of the last slip
  double up_last;   ///< last change from slip- to slip+ [s], < 0: none
  double section_t; ///< passage of the section in slip, < 0: not yet
} cli_tracker_t;

/// Starts at the first instant of a sample.
void cli_track_start(cli_tracker_t *tracker, const cli_instant_t *at);

/// Takes the next instant.
/// Returns: whether it ends the cycle.
bool cli_track(cli_tracker_t *tracker, const cli_instant_t *at);

/// Begins the next cycle, after one that returned.
void cli_track_next(cli_tracker_t *tracker);

#endif
