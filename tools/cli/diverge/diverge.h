/// `diverge`: what all samples share, the motion of one, and what is recorded
/// of it from one arrival at the two-fold to the next.
#pragma once

#include "../host/sheet.h"
#include "../setup/args.h"
#include "corner.h"

// What selects the exit of a motion whose future is not unique.

typedef enum {
  CLI_BY_RANDOM, ///< a draw: exit at a rate, to either side
  CLI_BY_NOISE   ///< additive white noise on h
} cli_mechanism_t;

/// What --by random does where the wheel comes to h = g = 0.
typedef enum {
  CLI_CODIM2_REST,       ///< pinned where that is consistent, as in `run`
  CLI_CODIM2_ATTRACTING, ///< the attracting stick where there is one: `persist`
  CLI_CODIM2_EVEN,       ///< draws one of the consistent modes, all equally
  CLI_CODIM2_NOISE       ///< what vanishing noise on v selects, on both slips
} cli_codim2_choice_t;

typedef struct {
  const cli_args_t *args;
  cli_setup_t setup;
  tf_machine_t machine;    ///< its rule never leaves an escaping stick
  cli_wide_t wide;         ///< the same
  cli_two_fold_t two_fold; ///< NAN: there is none
  cli_canard_t canard;     ///< through the two-fold
  bool at_two_fold;        ///< the samples start there
  double near;             ///< noise: step near the two-fold [s]
  double dwell; ///< within the band of noise, to be on the surface [s]
} cli_job_t;

/// Finds the first two-fold that stick passes through.
/// Returns: whether there is one.
bool cli_find_two_fold(const tf_machine_t *machine, cli_two_fold_t *out);

#define CLI_DIVERGE_ROW 512 ///< room for a row

/// `diverge --exhaustive`: follows all branches instead of samples, writes them
/// to the sheet that is open, and closes it.
int cli_exhaustive(const cli_job_t *job, cli_sheets_t *sheets);

/// An instant of a motion.
typedef struct {
  double t; ///< since the start of the sample [s]
  cli_point_t at;
  double h, g; ///< [m/s]
  double A;    ///< Delassus scalar on the side of the two-fold [1/kg]
  bool on;     ///< on h = 0, or within the band that stands for it
  bool rests;  ///< on the turntable, for a while or for good
} cli_instant_t;

/// How a cycle ended.
typedef enum {
  CLI_CYCLE_OPEN,     ///< it goes on
  CLI_CYCLE_RETURNED, ///< at the two-fold again
  CLI_CYCLE_SMALL,    ///< landed several times without coming back
  CLI_CYCLE_REST,     ///< at rest on the turntable
  CLI_CYCLE_TIMEOUT,  ///< none of these within the patience
  CLI_CYCLE_REFUSED,  ///< a step was refused
  CLI_OUTCOMES
} cli_outcome_t;

/// One cycle. Times are since the start of the sample [s].
typedef struct {
  double arrived; ///< 0 where the sample starts elsewhere
  bool left;      ///< the surface was left
  bool released;  ///< stick ended with the escaping region, not by a draw
  double exit_t, exit_r, exit_omega, exit_g;
  int side;          ///< of the exit, +1 or -1
  double phase;      ///< at the section [windings]; NAN: not there in slip
  double section_t;  ///< passage of the section in slip; NAN: not yet
  double up_last;    ///< last change from slip- to slip+, NAN: none
  bool upper;        ///< on the upper sliding region at present
  uint64_t landings; ///< on the upper sliding region
  double land_t;     ///< first time
  double land_r;     ///< [m]
  uint64_t windings; ///< changes of slip until the first landing
  double ended;
  cli_outcome_t outcome;
} cli_cycle_t;

typedef struct {
  const cli_job_t *job;
  cli_random_t random;
  cli_cycle_t cycle; ///< the present one
  cli_instant_t before, last;
  double on_since; ///< start of the present stay on the surface
  double on_r;     ///< where it began [m]
  int slip_side;   ///< of the last slip
  double size;     ///< of the noise, in this sample
  double band;     ///< noise: |h| <= band is on the surface [m/s]
  double near;     ///< noise: longest step near the two-fold [s]
  tf_state_t state;
  tf_report_t report;
  double t;
  bool passes;   ///< random: it goes on along the canard next
  double wait;   ///< until an escaping stick or pinned ends [s]; < 0: none
  double length; ///< of the last step, under noise [s]
} cli_motion_t;

/// Puts a sample at its start: the two-fold, under noise before it, or the
/// start that was given.
void cli_motion_begin(cli_motion_t *motion, const cli_job_t *job,
                      uint64_t sample);

/// Takes one step; after a cycle that returned, the first of the next one.
/// Returns: whether the cycle ended.
bool cli_motion_advance(cli_motion_t *motion);

/// Noise on v next to h = g = 0, where the motion is.
cli_corner_t cli_motion_corner(const cli_motion_t *motion);

/// Takes a step of a length by tf_step_located. Returns: whether it was taken.
bool cli_step_of(cli_motion_t *motion, double dt);

cli_instant_t cli_instant(const cli_motion_t *motion);

/// Begins the first cycle, where the motion is.
void cli_track_start(cli_motion_t *motion);

/// Returns: whether the next instant ends the cycle.
bool cli_track(cli_motion_t *motion, const cli_instant_t *at);

/// Ends the cycle with a step that was refused. Returns: true.
bool cli_refuse_cycle(cli_motion_t *motion);

/// cli_motion_advance of --by random.
bool cli_random_advance(cli_motion_t *motion);

/// Goes from motion->state in a given mode to the next point where several
/// modes are consistent.
/// set: out, under "codim2" the modes that are consistent there.
/// Returns: what it came to, as in the column `end`.
const char *cli_random_branch(cli_motion_t *motion, unsigned mode,
                              unsigned *set);
