/// @file
/// One step of the machine: Moreau-Jean theta scheme.
#ifndef TWOFOLD_STEP_H
#define TWOFOLD_STEP_H

#include "twofold/machine.h"
#include "twofold/mode.h"
#include "twofold/status.h"

/// What happened in one step.
typedef struct {
  uint8_t mode;       ///< tf_mode_t, taken
  uint8_t set;        ///< every consistent mode, bits TF_MODE_BIT(mode), and
                      ///< pinned where the step ends at h = g = 0 (see tf_step)
  uint8_t choices;    ///< how many modes that is
  tf_force_t force;   ///< F [N], M [N m], mean over the step; of
                      ///< tf_step_located at its end
  tf_slip_t slip;     ///< h, g [m/s] at the end of the step
  tf_real_t delassus; ///< Delassus scalar of stick at sign(g) [1/kg]: of
                      ///< tf_step -dh+/dx / (mu dt), with the implicit terms of
                      ///< the step, else A of the motion
  tf_real_t residual; ///< distance of force from the law at the end of the
                      ///< step, by the natural map [N]; in slip whether h has
                      ///< the sign of the mode, not the angle; for a
                      ///< single-valued law |F - law| at the theta point [N]
  tf_status_t status; ///< as returned
} tf_report_t;

/// Finds the mode in which a state starts, and reports the law at that instant.
/// Scheme: slip by the sign of h; at h = 0 stick where |lambda| <= mu, else
///   slip by the sign of dh/dt; at h = g = 0 pinned, and the first step reports
///   what else is possible. |h| within rounding (8 epsilon times its terms)
///   counts as 0.
/// machine: in, prepared.
/// state: in/out. r, v, w are set by the caller, within TF_STATE_LIMIT; mode
///   holds the one preferred where several are possible, or TF_NO_MODE for
///   none, and ends as the mode taken. phi, tick and seed keep what they hold.
/// input: in.
/// report: out; choices counts the consistent modes of the instant.
/// Returns: TF_OK; TF_BAD_STATE (nothing touched).
/// Cost: at most 480 instructions. Stack: 800 B.
/// Memory: caller's, reentrant.
/// Claims: begin_finds_the_mode
#define tf_begin TF_LINK(tf_begin)
TF_API tf_status_t tf_begin(const tf_machine_t *machine, tf_state_t *state,
                            const tf_input_t *input, tf_report_t *report);

/// Advances the state by dt.
/// Scheme: Moreau-Jean theta method, linearly implicit in spring, dampers and
///   gyroscopic terms; the friction law holds at the end of the step; DESIGN.md
///   equations (1)-(12). Order 2 in smooth phases for theta = 1/2, else 1.
///   A step within which a slip or a stick comes to h = g = 0, with no
///   attracting stick to continue in, ends there, pinned: its force is a mean
///   of those before and after, its residual the distance of that from the law.
///   The next step chooses from that point.
///   A step that leaves r as it was while the machine moves, and with which 256
///   more would, stands still: its change is less than the rounding of the
///   state. In float at dt <= 1e-4 s every motion departs from rest like that,
///   and some never do. Use tf_step_compensated then, or a longer dt.
/// machine: in, prepared.
/// state: in/out, from tf_begin.
/// input: in, within TF_STATE_LIMIT together with the state.
/// report: out.
/// Returns: TF_OK; TF_DEGRADED (advanced, although no mode was consistent and
///   admissible: report->set holds the consistent ones); TF_COARSE (advanced,
///   but the motion stands still);
///   TF_BAD_STATE, TF_DIVERGED, TF_STEP_TOO_LONG (state untouched, report holds
///   the status).
/// Cost: at most 4400 instructions, the worst found by search;
///   no path through its code has more than 0; no data-dependent loop. The
///   worst is a degraded step: see `make bench` for others. Stack: 1888 B.
/// Memory: caller's, no overlap, reentrant.
/// Claims: smooth_slip_order_of_convergence, stick_is_exact, mirror_symmetry,
///   branch_is_independent_of_the_step_size, golden_trajectories,
///   branch_at_codimension_two_is_independent_of_dt,
///   random_machines_take_one_branch,
///   no_step_enters_an_escaping_stick_from_slip,
///   enumeration_against_grid_search, one_or_three_solutions,
///   signs_are_those_of_the_mode, rounding_does_not_end_a_rest,
///   residual_vanishes_at_solutions_only,
///   slip_never_enters_an_escaping_stick, rules_choose_as_declared,
///   no_scheme_stands_still_without_a_word,
///   slip_in_equilibrium_is_not_told_to_move,
///   stick_in_equilibrium_is_not_told_to_move,
///   random_exit_rate_is_independent_of_dt
#define tf_step TF_LINK(tf_step)
TF_API tf_status_t tf_step(const tf_machine_t *machine, tf_state_t *state,
                           const tf_input_t *input, tf_report_t *report);

#endif
