/// What the commands of the judge share: a machine as it is drawn, the library
/// that runs it, and the reference's view of it.
#ifndef REFERENCE_JUDGE_H
#define REFERENCE_JUDGE_H

#include <stdint.h>

#include "reference.h"

typedef ref_real_t real_t;

/// Inputs at a time; linear in between.
enum { LIB_KNOTS = 16 };
typedef struct {
  double t, omega0, force, torque;
} lib_knot_t;

/// Parameters of a machine, where it starts and what drives it; enough to
/// replay a run.
typedef struct {
  double m, d, beta, k2, c1, c2, r0, omega0, mu, kappa, gamma;
  bool coulomb;
  double r, v, omega;
  bool on_surface; ///< v is to make h = 0
  double dt;
  int rest;  ///< law at h = g = 0, numbered as by the library
  int knots; ///< 0: omega0 is constant
  lib_knot_t knot[LIB_KNOTS];
  double swing, swing_rate; ///< a sine on top of omega0 [rad/s]
} lib_machine_t;

/// As motion_scheme_t, and one more.
typedef enum {
  LIB_STEP,
  LIB_LOCATED,
  LIB_COMPENSATED,
  LIB_SCHEMES,
  LIB_LANES = LIB_SCHEMES ///< tf_ensemble_step, the same state in each lane
} lib_scheme_t;
extern const char *const lib_scheme_names[LIB_SCHEMES + 1];

/// A state of the library.
typedef struct {
  double r, v, w;
} lib_row_t;

/// The simulator in one real type, behind functions in double: library.c is
/// compiled twice. run takes a machine from its start to a time; -1: refused,
/// 0: all steps OK, 1: not all. parts: its mirror image ends elsewhere.
typedef struct {
  const char *name;
  double epsilon;
  int (*run)(const lib_machine_t *machine, lib_scheme_t scheme, double t_end,
             lib_row_t *end, bool *parts);
} lib_real_t;
extern const lib_real_t lib_f64, lib_f32;

/// Ends of the range of a parameter, by its name.
void lib_range(const char *name, double *low, double *high);

/// A random sequence; machine i of a seed has its own.
typedef struct {
  uint64_t state;
} draw_t;
draw_t draw_begin(uint64_t seed, uint64_t index);
/// Uniform in [low, high), or its logarithm is; that needs low > 0.
double draw_uniform(draw_t *draw, double low, double high);
double draw_log(draw_t *draw, double low, double high);
double draw_sign(draw_t *draw);
/// Machine with a start near h = g = 0, on h = 0 or anywhere. All numbers but
/// special angles are floats. `extreme`: m, beta, k2 and mu towards the ends of
/// their ranges in half of the machines.
lib_machine_t draw_machine(draw_t *draw, bool extreme);
/// The reference's machine and start.
ref_machine_t draw_reference(const lib_machine_t *machine);
ref_state_t draw_start(const lib_machine_t *machine, const ref_machine_t *q);
/// Prints the command that replays a run of the library.
void draw_print(const lib_machine_t *machine, double t_end, const char *scheme);

/// Inputs that move, in shapes that machines meet.
typedef enum {
  MOVING_RAMP,
  MOVING_TRIANGLE,
  MOVING_SINE,
  MOVING_HELD_STEPS,
  MOVING_JUMPS,
  MOVING_THROUGH_ZERO,
  MOVING_HOLD_THEN_RAMP,
  MOVING_KINKS,
  MOVING_SHAPES
} moving_shape_t;
/// Makes omega0 move from where it is over a time, with loads in half of the
/// draws, which move in an eighth. Half of the draws have their knots on
/// multiples of `grid`.
void moving_draw(draw_t *draw, lib_machine_t *machine, moving_shape_t shape,
                 double time, double grid);
/// Inputs of a step: omega0 at its end, the mean of its slope between jumps,
/// and mean loads. Of an empty span the values and the slope behind it.
typedef struct {
  double omega0, alpha, force, torque;
} moving_input_t;
moving_input_t moving_input(const lib_machine_t *machine, double from,
                            double to);
/// The inputs of `steps` steps of a machine's dt, for the reference: straight
/// within a step, a jump at its start where one lies in it. Writes up to `most`
/// knots; returns how many, or 0 where they are more.
int moving_table(const lib_machine_t *machine, long steps, ref_knot_t *table,
                 int most);

/// The command line.
typedef struct {
  long machines, first;
  uint64_t seed;
  double t_end;
  long show;             ///< of table: how many offenders it names
  const char *row, *dts; ///< of table: its class, steps instead of its own
} options_t;

typedef struct {
  const char *name, *about;
  long machines; ///< 0: it draws none
  double t_end;
  int (*run)(const options_t *options); ///< returns the exit code
} command_t;
extern const command_t command_validate, command_second, command_table;

/// What the reference met on the way.
typedef struct {
  int through;        ///< times at h = g = 0
  int events;         ///< all of them
  double stuck;       ///< shortest stick that came to h = g = 0 from a slip [s]
  bool rested;        ///< stood on the turntable
  bool left_rest;     ///< and did not stay there
  bool several;       ///< a choice that the rule does not make sharply
  bool passed_r;      ///< r changed its sign
  real_t stick_since; ///< -1: not in stick, or not from a slip
  ref_mode_t began;   ///< of the start
} met_t;

enum { ROW_STEPS = 3, ROW_MODELS = 7 };

/// One kind of run of the library.
typedef struct {
  lib_scheme_t scheme;
  const lib_real_t *real;
} model_t;
extern const model_t row_models[ROW_MODELS];

/// Which inputs move: of every other machine any shape, or of all.
typedef enum { MOVE_HALF, MOVE_ALL, MOVE_RAMP, MOVE_THROUGH_ZERO } move_t;

typedef struct {
  const char *name, *about;
  double t_end;
  double dt[ROW_STEPS]; ///< 0: no more
  double located;       ///< of dt, in located steps
  double least;         ///< dt of the shortest steps of `located` and lanes
  bool plain;           ///< without compensated double, located and lanes
  bool order; ///< counts errors that do not fall as dt^1.5, not those above 2 %
  bool rests; ///< takes a wheel that stands on the turntable if it stays
  move_t moves;
  /// Changes a random machine; NULL: not.
  void (*place)(draw_t *draw, lib_machine_t *machine);
  bool (*takes)(const met_t *met); ///< NULL: all
} row_t;

/// A machine of a row; inputs that move by half do where `moves`.
lib_machine_t row_machine(draw_t *draw, const row_t *row, bool moves);

enum { ROWS = 14 };
extern const row_t rows[ROWS];

#endif
