/// @file
/// The command `diverge`, in its parts: what was asked for, the two-fold of the
/// scene, the motions that leave it, and what is counted on them.
#ifndef TWOFOLD_CLI_DIVERGE_H
#define TWOFOLD_CLI_DIVERGE_H

#include <stdbool.h>
#include <stdint.h>

#include "host.h"
#include "setup.h"

/// What decides where the future is open.
typedef enum {
  CLI_BY_RANDOM,     ///< a draw: exit at a rate, by either side
  CLI_BY_NOISE,      ///< additive white noise on h
  CLI_BY_SMOOTHING,  ///< sign(h) smoothed
  CLI_BY_HYSTERESIS, ///< friction changes its side at |h| = size
  CLI_BY_DELAY       ///< friction sees the sign of h of a while ago
} cli_by_t;
#define CLI_BYS 5

/// What --by random does where the wheel comes to h = g = 0.
typedef enum {
  CLI_CORNER_REST,       ///< it rests where it may, as under `random` of run
  CLI_CORNER_ATTRACTING, ///< the attracting stick where there is one: `persist`
  CLI_CORNER_EVEN        ///< each consistent mode alike, by a draw
} cli_corner_t;
#define CLI_CORNERS 3

/// The command line of `diverge`, read and validated but for the machine.
typedef struct {
  const tf_scene_t *scene;
  cli_settings_t settings;
  const char *exits, *returns; ///< paths, NULL: not written, "-": stdout
  const char *branches;        ///< likewise, of --exhaustive
  bool exhaustive;
  const char *only_exhaustive; ///< NULL, or an option that goes with it alone
  bool header;                 ///< asked for, whatever the shard
  cli_by_t by;
  const char *size_text; ///< as typed, NULL: not given
  cli_corner_t corner;
  double size;     ///< unit by kind; 0: not given
  double spread;   ///< 0: not given; sizes are drawn from [size / spread, size]
  double patience; ///< longest cycle [s]
  double section;  ///< where the phase is read, past the two-fold [m]
  double near_ratio; ///< dt / step near the two-fold; 0: not given
  double grid;       ///< --exhaustive: between two exits of a stick [s]
  uint64_t samples, cycles;
  uint64_t shard, shards; ///< 1 to shards
  uint64_t depth, count;  ///< bounds of --exhaustive
  uint32_t seed;
} cli_diverge_args_t;

/// Reads the arguments behind `diverge`.
/// Returns: CLI_DONE, CLI_USAGE or CLI_REFUSED (complained).
int cli_diverge_args(cli_diverge_args_t *args, int argc, char *const argv[]);

/// Place on the way, in the variables in which friction is diagonal.
typedef struct {
  double r; ///< [m]
  double p; ///< v - d z [m/s]
  double z; ///< w - omega0 [rad/s]
} cli_place_t;

/// Derivatives of a place under a contact force.
cli_place_t cli_flow(const tf_machine_t *machine, cli_place_t at, double F,
                     double M);

/// Slip speeds at a place.
tf_slip_t cli_place_slip(const tf_machine_t *machine, cli_place_t at);

/// State at a place, and back.
tf_state_t cli_place_state(const tf_machine_t *machine, cli_place_t at);
cli_place_t cli_state_place(const tf_machine_t *machine,
                            const tf_state_t *state);

/// Delassus scalar [1/kg] at r for the sign of g.
double cli_delassus(const tf_machine_t *machine, double r, double g);

/// A two-fold that stick runs through, from attracting to escaping.
typedef struct {
  double r, omega, g; ///< [m], [rad/s], [m/s]
  double v;           ///< [m/s]
  double slope;       ///< dw/dr of the weak direction [rad/(s m)]
} cli_twofold_t;

/// Finds it.
/// Returns: whether there is one.
bool cli_find_twofold(const tf_machine_t *machine, cli_twofold_t *out);

/// Stick on the weak direction, so far before the two-fold [m].
tf_state_t cli_before_twofold(const tf_machine_t *machine,
                              const cli_twofold_t *twofold, double distance);

/// The place on h = 0 at (r, z).
cli_place_t cli_on_surface(const tf_machine_t *machine, double r, double z);

/// h' without friction, at a place on h = 0 [m/s^2].
double cli_free_rate(const tf_machine_t *machine, cli_place_t at);

/// The sliding field times A, regular where A = 0: (r', z') A.
void cli_sliding_field(const tf_machine_t *machine, double r, double z,
                       double s, double out[2]);

/// The stick through a two-fold, a curve z(r) on h = 0.
#define CLI_STICK_TERMS 14
typedef struct {
  const tf_machine_t *machine;
  double r, z;               ///< two-fold
  double s;                  ///< sign of g
  double reach;              ///< the curve holds within r +- reach [m]
  double c[CLI_STICK_TERMS]; ///< z - z* = x sum c[n] x^n, x = (r - r*) / reach
} cli_stick_t;

/// Solves for it.
/// Returns: whether it was found.
bool cli_stick_through(const tf_machine_t *machine,
                       const cli_twofold_t *twofold, cli_stick_t *stick);

/// Where it is so long after the two-fold.
/// reached: out, t, or when the stick ended by itself.
/// Returns: whether it is still in the escaping region at t.
bool cli_stick_after(const cli_stick_t *stick, double t, cli_place_t *at,
                     double *reached);

/// The 64-bit counter based draws of one sample: reproducible whatever the
/// order of the samples.
typedef struct {
  uint32_t seed, sample, used;
} cli_draws_t;
double cli_draw_uniform(cli_draws_t *draws); ///< in (0, 1)
double cli_draw_normal(cli_draws_t *draws);

/// An instant of a motion, as the tracker sees it.
typedef struct {
  double t; ///< since the start of the sample [s]
  cli_place_t at;
  double h, g;   ///< [m/s]
  bool on;       ///< on h = 0, or within the band that stands for it
  bool pinned;   ///< at h = g = 0 for good or for a while
  bool released; ///< a stick ended by |lambda| = mu instead of by a draw
} cli_instant_t;

/// How a cycle ended.
typedef enum {
  CLI_CYCLE_OPEN,     ///< it goes on
  CLI_CYCLE_RETURNED, ///< at the two-fold again
  CLI_CYCLE_SMALL,    ///< lands again and again and never comes back
  CLI_CYCLE_PINNED,   ///< at rest on the turntable
  CLI_CYCLE_TIMEOUT,  ///< none of these within the patience
  CLI_CYCLE_REFUSED   ///< a step was refused
} cli_outcome_t;
#define CLI_OUTCOMES 6
const char *cli_outcome_name(cli_outcome_t outcome);

/// One cycle, from one arrival at the two-fold to the next.
typedef struct {
  double arrived; ///< [s]; of a start elsewhere: 0
  bool left;      ///< the surface was left since
  bool released;  ///< by |lambda| = mu
  double exit_t, exit_r, exit_omega, exit_g;
  int side;          ///< of the exit, +1 or -1
  double phase;      ///< at the section [turns]; < 0: not there in slip
  double section_t;  ///< when it passed there, where phase >= 0 [s]
  bool landed;       ///< on the upper sliding region
  double land_t;     ///< first time [s]
  double land_r;     ///< [m]
  uint64_t landings; ///< there
  uint64_t windings; ///< changes of slip until the first landing
  double ended;      ///< [s]
  cli_outcome_t outcome;
} cli_cycle_t;

/// Watches a motion.
typedef struct {
  const tf_machine_t *machine;
  const cli_twofold_t *twofold;
  double section, patience;
  double stay; ///< so long within the band is on the surface [s]
  cli_instant_t before, last;
  cli_cycle_t cycle;
  bool upper;       ///< on the upper sliding region at last
  double on_since;  ///< start of the present stay on the surface
  double on_r;      ///< where it began [m]
  int slip_side;    ///< of the last slip
  double up_last;   ///< last change from slip- to slip+ [s], < 0: none
  double section_t; ///< passing the section in slip, < 0: not yet
} cli_tracker_t;
void cli_track_start(cli_tracker_t *tracker, const cli_instant_t *at);
/// Returns: whether the cycle has ended at this instant.
bool cli_track(cli_tracker_t *tracker, const cli_instant_t *at);
/// When r passes a value between two instants.
double cli_passing(const cli_tracker_t *tracker, const cli_instant_t *a,
                   const cli_instant_t *b, double r);
/// Begins the next cycle, after one that returned.
void cli_track_next(cli_tracker_t *tracker);

/// What all samples share.
typedef struct {
  const cli_diverge_args_t *args;
  cli_setup_t setup;
  cli_twofold_t twofold;
  cli_stick_t stick;  ///< through it
  bool at_twofold;    ///< the samples start there
  double dt;          ///< [s]
  double rate;        ///< of exits [1/s]
  tf_params_t params; ///< of a machine that leaves open what is open
  tf_machine_t stay;  ///< that machine
} cli_job_t;

/// |g| within so many bands, and |h| within the band, is at rest at h = g = 0.
#define CLI_REST 4

/// A motion that is followed, sample by sample.
#define CLI_PENDING 64
typedef struct {
  const cli_job_t *job;
  cli_tracker_t *tracker;
  cli_draws_t draws;
  double size;       ///< of this sample
  double band;       ///< |h| within is on the surface [m/s]
  tf_machine_t far;  ///< machine of the long steps
  tf_machine_t near; ///< of the short ones
  tf_state_t state;
  tf_report_t report;
  double t;
  double clock;   ///< until an open stick or a pinned wheel is left; < 0: none
  cli_place_t at; ///< of a forced motion
  int side;       ///< on which its friction is
  double pending[CLI_PENDING]; ///< when that side changes [s]
  int pendings;
} cli_mover_t;

/// The kinds of motion. start: places the sample and tells the tracker. move:
/// one step, told to the tracker; pass: likewise, from the two-fold, NULL where
/// move does that too. Both return whether the cycle ended.
typedef struct {
  void (*start)(cli_mover_t *mover);
  bool (*move)(cli_mover_t *mover);
  bool (*pass)(cli_mover_t *mover);
} cli_motion_t;
extern const cli_motion_t cli_random_motion; ///< the draws of CLI_BY_RANDOM
extern const cli_motion_t cli_kicked_motion; ///< CLI_BY_NOISE, _SMOOTHING
extern const cli_motion_t cli_forced_motion; ///< CLI_BY_HYSTERESIS, _DELAY

/// Where a single future of --exhaustive ends.
typedef enum {
  CLI_BRANCH_TWOFOLD,
  CLI_BRANCH_CORNER,   ///< h = g = 0 with more than one future
  CLI_BRANCH_ESCAPING, ///< in an escaping stick that no rule ends
  CLI_BRANCH_TIME      ///< the patience is over
} cli_branch_t;

/// Goes from mover->state in a mode to the next place that is open.
/// set: out, the modes that are consistent there.
cli_branch_t cli_random_branch(cli_mover_t *mover, unsigned mode,
                               unsigned *set);

/// `diverge --exhaustive`. Returns: the exit code.
int cli_diverge_exhaust(const cli_job_t *job);

/// A tracker of the job's motions; `stay` is still to be told.
cli_tracker_t cli_tracker_of(const cli_job_t *job);

/// State from which a motion starts that has to arrive at the two-fold first,
/// or the start that was typed.
tf_state_t cli_mover_start(const cli_job_t *job);

/// Prepares the machine of the short steps. params: of the long ones.
void cli_prepare_near(cli_mover_t *mover, const tf_params_t *params);

/// Length of step where the motion is: short near the two-fold [s].
double cli_step_here(const cli_mover_t *mover, cli_place_t at, double g);

/// The present instant of a motion for which the band stands for the surface.
cli_instant_t cli_instant_in_band(const cli_mover_t *mover, cli_place_t at);

/// Ends the cycle where a step was refused. Returns: true.
bool cli_refuse_cycle(cli_mover_t *mover);

/// Name and unit of the size of a kind, for people; unit "" where none.
typedef struct {
  const char *name, *unit;
  double dt;     ///< step where none is given [s]
  double near;   ///< dt / step near the two-fold, likewise
  double spread; ///< likewise
  const cli_motion_t *motion;
} cli_kind_t;
extern const cli_kind_t cli_kinds[CLI_BYS];

/// Makes the machine, the two-fold and the start of all samples.
/// Returns: CLI_DONE, CLI_USAGE or CLI_REFUSED (complained).
int cli_diverge_prepare(cli_job_t *job, const cli_diverge_args_t *args);

/// Both files of a command, opened together.
typedef struct {
  cli_output_t exits, returns;
  bool has_exits, has_returns;
} cli_files_t;
/// Returns: CLI_DONE or CLI_STOPPED (complained, nothing left behind).
int cli_files_open(cli_files_t *files, const cli_diverge_args_t *args);
/// Returns: whether all that was written has arrived.
bool cli_files_put(cli_files_t *files, uint64_t sample, uint64_t cycle,
                   const cli_cycle_t *what);
bool cli_files_flush(cli_files_t *files);
/// Returns: CLI_DONE or CLI_STOPPED (complained).
int cli_files_close(cli_files_t *files);

/// Writing: headers and the rows of one cycle.
#define CLI_DIVERGE_ROW 512
size_t cli_exit_header(char out[CLI_DIVERGE_ROW]);
size_t cli_return_header(char out[CLI_DIVERGE_ROW]);
size_t cli_exit_row(char out[CLI_DIVERGE_ROW], uint64_t sample, uint64_t cycle,
                    const cli_cycle_t *what);
size_t cli_return_row(char out[CLI_DIVERGE_ROW], uint64_t sample,
                      uint64_t cycle, const cli_cycle_t *what);

/// `diverge`: argv[0] is the first argument behind it.
/// Returns: the exit code.
int cli_diverge(int argc, char *const argv[]);

/// Prints its help page.
void cli_diverge_help(void);

#endif
