/// @file
/// The motion of one sample, and what the steppers have in common.
#ifndef TWOFOLD_CLI_MOTION_H
#define TWOFOLD_CLI_MOTION_H

#include "draws.h"
#include "job.h"
#include "tracker.h"

/// |h| <= band and |g| <= CLI_REST_BANDS band count as at rest at h = g = 0.
#define CLI_REST_BANDS 4

/// Changes of side that a delay can hold at a time.
#define CLI_QUEUED_SWITCHES 64

typedef struct {
  const cli_job_t *job;
  cli_tracker_t *tracker;
  cli_draws_t draws;
  double size;              ///< of the mechanism, in this sample
  double band;              ///< |h| <= band is on the surface [m/s]
  tf_machine_t long_steps;  ///< machine away from the two-fold
  tf_machine_t short_steps; ///< machine near the two-fold
  tf_state_t state;
  tf_report_t report;
  double t;
  double wait;    ///< until an escaping stick or pinned ends [s]; < 0: none
  cli_point_t at; ///< under hysteresis or delay, instead of state
  int side;       ///< on which friction acts then, +1 or -1
  double queue[CLI_QUEUED_SWITCHES]; ///< times when that side changes [s]
  int queued;
} cli_motion_t;

/// How a mechanism moves a sample.
typedef struct {
  /// Puts the sample at its start and starts the tracker.
  void (*start)(cli_motion_t *motion);
  /// Takes one step. Returns: whether the cycle ended.
  bool (*advance)(cli_motion_t *motion);
  /// Passes the two-fold. Returns: whether the cycle ended. NULL where advance
  /// does that as well.
  bool (*pass)(cli_motion_t *motion);
} cli_stepper_t;

/// A tracker of the job's motions, without its dwell time.
cli_tracker_t cli_tracker_of(const cli_job_t *job);

/// State from which a motion starts that has to arrive at the two-fold first,
/// or the start that was typed.
tf_state_t cli_motion_start(const cli_job_t *job);

/// Prepares the machine of the short steps. params: of the long ones.
void cli_prepare_near(cli_motion_t *motion, const tf_params_t *params);

/// Length of the next step: shorter near the two-fold [s].
double cli_step_length(const cli_motion_t *motion, cli_point_t at, double g);

/// The present instant of a motion for which a band stands for the surface.
cli_instant_t cli_instant_in_band(const cli_motion_t *motion, cli_point_t at);

/// Ends the cycle after a refused step. Returns: true.
bool cli_refuse_cycle(cli_motion_t *motion);

#endif
