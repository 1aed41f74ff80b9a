/// @file
/// One step of the machine: Moreau-Jean theta scheme.
#ifndef TWOFOLD_STEP_H
#define TWOFOLD_STEP_H

#include "twofold/machine.h"
#include "twofold/mode.h"
#include "twofold/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What happened in one step.
typedef struct {
  uint8_t mode;       ///< tf_mode_t, taken
  uint8_t set;        ///< every consistent mode, bits TF_MODE_BIT(mode); of a
                      ///< step that comes to h = g = 0, those of that point
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
///   what else is possible. |h| within rounding (32 epsilon times its terms)
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

/// As tf_begin, for a start that is given by its lateral slip speed.
/// Scheme: v by tf_speed_for_slip; the mode preferred is slip on the side that
///   the sign of h names, none where h is 0; then tf_begin.
/// machine: in, prepared.
/// state: in/out. r, w are set by the caller, within TF_STATE_LIMIT; v and mode
///   are found. phi, tick and seed keep what they hold.
/// input: in.
/// h: in [m/s].
/// report: out; choices counts the consistent modes of the instant.
/// Returns: TF_OK; TF_BAD_STATE (nothing touched), also where h does not
///   depend on v, which tf_speed_for_slip tells apart.
/// Cost: at most 550 instructions. Stack: 896 B.
/// Memory: caller's, no overlap, reentrant.
/// Claims: begin_with_slip_is_its_parts, begin_with_slip_touches_nothing
#define tf_begin_with_slip TF_LINK(tf_begin_with_slip)
TF_API tf_status_t tf_begin_with_slip(const tf_machine_t *machine,
                                      tf_state_t *state,
                                      const tf_input_t *input, tf_real_t h,
                                      tf_report_t *report);

/// Advances the state by dt.
/// Scheme: Moreau-Jean theta method, linearly implicit in spring, dampers and
///   gyroscopic terms; the friction law holds at the end of the step; DESIGN.md
///   equations (1)-(12). Order 2 in smooth phases for theta = 1/2, else 1.
///   A step within which slip or stick comes to h = g = 0 goes on from there
///   in the mode that follows (tf_rule_t): its force is a mean of those before
///   and behind, its residual the distance of that from their convex hull.
///   A step that leaves r as it was while the machine moves, and with which 32
///   more would, stands still: its change is less than the rounding of the
///   state. In float at dt <= 1e-4 s every motion departs from rest like that,
///   and some never do. Use tf_step_compensated then, or a longer dt.
///   Where the linearisation would make more than 2^-12 of the energy, or
///   friction put in more than 2^-4, the step is taken in a form that balances
///   energy, and ends in slip on the side on which it is; the set stays that of
///   the consistent modes. So n steps make at most exp(n/4096) - 1 of it; a
///   slip whose spring turns by 1/45 rad a step or more takes that form from
///   2^-20 on.
/// machine: in, prepared.
/// state: in/out, from tf_begin.
/// input: in, within TF_STATE_LIMIT together with the state.
/// report: out.
/// Returns: TF_OK; TF_DEGRADED (advanced, although no mode was consistent and
///   admissible: report->set holds the consistent ones); TF_COARSE (advanced,
///   but too long for the motion: taken in the form that balances energy; or
///   the state turns by more than a right angle in it, in the norm of the
///   energy; or theta > 1/2 damps a quarter of the energy; or an impulse of
///   friction ends a slip and changes the velocities by more than a third, or
///   its force changes direction within it and that alone changes them by 3 %;
///   or a slip that several modes may follow passes by h = g = 0, or no
///   force leads along its course there; or the motion stands still);
///   TF_BAD_STATE, TF_DIVERGED, TF_STEP_TOO_LONG (state untouched, report holds
///   the status).
/// Trust: where it says TF_OK, the mode is one of the set, h and g have its
///   signs, or are 0 within their rounding, as it asks, no energy is created
///   but for that share, and what follows h = g = 0 is what law and rule say.
///   A step that passes h = g = 0 has the mean force of both sides. An
///   independent reference found none of 1.9 million steps and of 2000 stiff
///   runs that break this; what it and others did find, of 791 motions through
///   h = g = 0 and 1973 extreme machines, is in docs/VERIFICATION.md.
/// Cost: at most 24000 instructions found by search: a step that comes to
///   h = g = 0 or ends in no mode; see `make bench` for others. Every loop has
///   a bound: at most 230000 by the longest way. Stack: 4096 B.
/// Memory: caller's, no overlap, reentrant.
/// Claims: smooth_slip_order_of_convergence, stick_is_exact, mirror_symmetry,
///   branch_is_independent_of_the_step_size, golden_trajectories,
///   branch_at_codimension_two_is_independent_of_dt,
///   a_course_ends_with_the_signs_of_its_mode,
///   random_machines_take_one_branch,
///   motion_leaves_codimension_two_as_the_reference_does,
///   both_schemes_go_one_way_beside_codimension_two,
///   codimension_two_always_has_a_future,
///   no_step_enters_an_escaping_stick_from_slip,
///   enumeration_against_grid_search, one_or_three_solutions,
///   signs_are_those_of_the_mode, rounding_does_not_end_a_rest,
///   residual_vanishes_at_solutions_only,
///   slip_never_enters_an_escaping_stick, rules_choose_as_declared,
///   no_scheme_stands_still_without_a_word,
///   slip_in_equilibrium_is_not_told_to_move,
///   stick_in_equilibrium_is_not_told_to_move,
///   random_exit_rate_is_independent_of_dt, no_step_creates_energy,
///   friction_puts_in_no_more_than_the_law_allows,
///   a_turn_beyond_a_right_angle_is_coarse, an_impulse_ends_or_is_reported
#define tf_step TF_LINK(tf_step)
TF_API tf_status_t tf_step(const tf_machine_t *machine, tf_state_t *state,
                           const tf_input_t *input, tf_report_t *report);

#ifdef __cplusplus
}
#endif

#endif
