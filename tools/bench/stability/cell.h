/// What is swept: one parameter or start each, from the mild to the extreme,
/// all else as in scene `chaos` unless the sweep says otherwise. And one cell
/// of the map: one case, one scheme, one step size, and what is to be said
/// about the run.
#pragma once

#include "twofold.h"

/// One machine and its start.
typedef struct {
  tf_params_t params;
  tf_real_t r, v, w;       ///< start ...
  tf_real_t h;             ///< ... where v_from_h, v follows from this h
  bool v_from_h;           ///< and from v where h does not depend on it
  const tf_scene_t *scene; ///< of the inputs; NULL: inputs at rest
} case_t;

/// One sweep. Values are 10^(low + i / per_decade); where per_decade is 0,
/// sweep_value has them.
typedef struct {
  const char *name;
  int count;
  int low, per_decade;
  bool from_zero; ///< one more value, 0, before the others
  void (*set)(case_t *c, tf_real_t value);
} sweep_t;

#define SWEEPS 25
extern const sweep_t sweeps[SWEEPS];

/// Value i of a sweep.
double sweep_value(const sweep_t *sweep, int i);

/// The case of value i of a sweep.
void sweep_case(const sweep_t *sweep, int i, case_t *c);

typedef tf_status_t step_t(const tf_machine_t *, tf_state_t *,
                           const tf_input_t *, tf_report_t *);

/// The schemes and steps of all cells: 1e-6 to 1e-1 s, two a decade.
typedef struct {
  const char *name;
  step_t *step;
  tf_real_t theta;
} cell_scheme_t;
#define CELL_SCHEMES 3
extern const cell_scheme_t cell_schemes[CELL_SCHEMES];
#define CELL_DTS 11
double cell_dt(int i);

/// Most steps of a cell. An instability grows by the step, so steps count and
/// not seconds.
#define CELL_STEPS 4000
/// How many steps of dt/CELL_FINER ask a refused step again.
#define CELL_FINER 1024

/// The worst that can be said about a run, the best first.
typedef enum {
  CELL_OK,        ///< all steps, energy bounded by what was put in
  CELL_DEGRADED,  ///< the same, in some steps no mode was consistent
  CELL_PHYSICS,   ///< the motion itself leaves the range of states
  CELL_TOO_LONG,  ///< refused: r moves by more than its size in a step
  CELL_DIVERGED,  ///< refused, and shorter steps go on: the scheme's fault
  CELL_TOLD,      ///< more energy than the contact can have put in, by steps
                  ///< that said TF_COARSE, TF_STALLED or TF_DEGRADED
  CELL_CREATED,   ///< the same by steps that said nothing of it
  CELL_PARAMETER, ///< the scheme or the real type does not take the case
  CELL_TOUCHED,   ///< a refused step changed the state, or lied about status
  CELL_NON_FINITE ///< an accepted step left a number that is not finite
} cell_verdict_t;
#define CELL_VERDICTS 10
extern const char *const cell_verdict_names[CELL_VERDICTS];

typedef struct {
  cell_verdict_t verdict;
  long double excess; ///< largest E / (E0 + W), see CELL_TOLD
} cell_t;

/// Begins a case, with theta and dt of its machine.
tf_status_t cell_begin(const case_t *c, tf_real_t theta, tf_real_t dt,
                       tf_machine_t *k, tf_state_t *x);

/// Runs one cell.
/// c: the case; step: the scheme; theta, dt: of its machine.
cell_t cell_run(const case_t *c, step_t *step, tf_real_t theta, tf_real_t dt);
