/// What is recorded of a motion, cycle by cycle: exit, windings, landing and
/// return to the two-fold; the motion of one sample; and what the steppers have
/// in common.
#pragma once

#include "job.h"

/// An instant of a motion, as the tracker sees it.
typedef struct {
  double t; ///< since the start of the sample [s]
  cli_point_t at;
  double h, g;   ///< [m/s]
  bool on;       ///< on h = 0, or within the band that stands for it
  bool rests;    ///< on the turntable, for a while or for good
  bool released; ///< stick ended with the escaping region, not by a draw
} cli_instant_t;

/// How a cycle ended.
typedef enum {
  CLI_CYCLE_OPEN,     ///< it goes on
  CLI_CYCLE_RETURNED, ///< at the two-fold again
  CLI_CYCLE_SMALL,    ///< landed several times without coming back
  CLI_CYCLE_REST,     ///< at rest on the turntable
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
  const cli_job_t *job;
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

/// Returns: whether the next instant ends the cycle.
bool cli_track(cli_tracker_t *tracker, const cli_instant_t *at);

void cli_track_next(cli_tracker_t *tracker);

/// The random numbers of one sample. The generator is counter based, so they do
/// not depend on the order in which samples are computed.
typedef struct {
  uint32_t seed, sample, used;
} cli_draws_t;

double cli_draw_uniform(cli_draws_t *draws); ///< in (0, 1)

typedef struct {
  const cli_job_t *job;
  cli_tracker_t tracker;
  cli_draws_t draws;
  double size;          ///< of the mechanism, in this sample
  double band;          ///< noise: |h| <= band is on the surface [m/s]
  tf_machine_t machine; ///< its dt is the longest step
  double near;          ///< longest step near the two-fold, or in slip [s]
  tf_state_t state;
  tf_report_t report;
  double t;
  double wait;   ///< until an escaping stick or pinned ends [s]; < 0: none
  double length; ///< of the last step, under noise [s]
} cli_motion_t;

/// How a mechanism moves a sample.
typedef struct {
  /// Puts the sample at its start. Returns: its first instant.
  cli_instant_t (*start)(cli_motion_t *motion);
  /// Takes one step. Returns: whether the cycle ended.
  bool (*advance)(cli_motion_t *motion);
  /// Passes the two-fold. Returns: whether the cycle ended. NULL where advance
  /// does that as well.
  bool (*pass)(cli_motion_t *motion);
} cli_stepper_t;

/// Puts a motion at t = 0, at the two-fold or the start that was given.
void cli_motion_begin(cli_motion_t *motion);

/// Takes a step of a length by tf_step_located. Returns: whether it was taken.
bool cli_step_of(cli_motion_t *motion, double dt);

cli_instant_t cli_instant(const cli_motion_t *motion);

bool cli_refuse_cycle(cli_motion_t *motion);

/// --by random, and --by noise.
extern const cli_stepper_t cli_random_stepper;
extern const cli_stepper_t cli_noise_stepper;

typedef enum {
  CLI_BRANCH_TWO_FOLD,
  CLI_BRANCH_CODIM2,   ///< at h = g = 0 with several consistent modes
  CLI_BRANCH_ESCAPING, ///< in an escaping stick
  CLI_BRANCH_TIME      ///< the time is up, or a step was refused
} cli_branch_t;

/// Goes from motion->state in a given mode to the next point where several
/// modes are consistent.
/// set: out, the modes that are consistent there.
cli_branch_t cli_random_branch(cli_motion_t *motion, unsigned mode,
                               unsigned *set);

/// `diverge --exhaustive`: follows all branches instead of samples, and writes
/// them.
int cli_exhaustive(const cli_job_t *job);
