// One step of the Moreau-Jean theta scheme, from its start to its end, stage by
// stage, and its rare ends. tf_step and tf_step_compensated differ in what they
// start with and in how they store the end.
#ifndef TF_SCHEME_H
#define TF_SCHEME_H

#include "balance.h"
#include "stages.h"

// How a step ends. All but END_COMMON are rare.
typedef enum {
  END_COMMON,
  END_SINGLE_VALUED, // the law has no solution set
  END_TOO_LONG,      // it is refused
  END_CODIM2,        // at h = g = 0, or near it with the mode lost
  END_NO_MODE,       // no mode is consistent, or none that a slip may enter
  END_REVERSED,      // of these on there is an end: a slip that is reversed,
  END_HELD,          // one that turns and is held by the limit at h -> 0,
  END_TURNING,       // another one whose force turns, see slip_end();
  END_TO_CHECK // a slip that is lost, or a balance of energy to be checked
} end_kind_t;

// The end of a rare step, judged by its balance of energy. to: in/out; in are
// its end and its set, where it has got so far. Free motion and inclusion are
// formed anew, so that the common step need not keep them.
// Returns: the status of the end.
#define tf_rare_end TF_LINK(tf_rare_end)
TF_API tf_status_t tf_rare_end(end_kind_t kind, const tf_machine_t *k,
                               const tf_state_t *state, const tf_input_t *input,
                               const start_t *start, step_end_t *to);

// mode_end() as a function: rare ends are many, and this saves code size.
#define tf_mode_end TF_LINK(tf_mode_end)
TF_API forced_end_t tf_mode_end(const free_motion_t *c,
                                const tf_contact_modes_t *s, unsigned mode);

// Whether a change of the velocities P and w, or that of the whole step, is
// large in the norm of the kinetic energy: its square is more than a share of
// the sum of those at both ends.
#define tf_changes_much TF_LINK(tf_changes_much)
TF_API bool tf_changes_much(const tf_machine_t *k, const tf_state_t *from,
                            end_state_t to, tf_real_t dP, tf_real_t dw,
                            tf_real_t share);

#define tf_step_changes_much TF_LINK(tf_step_changes_much)
TF_API bool tf_step_changes_much(const tf_machine_t *k, const tf_state_t *from,
                                 end_state_t to, tf_real_t share);

// At h = g = 0, or near it with the mode lost; see codim2_end.c. in: with the
// pinned point, here and in tf_least_violation.
#define tf_codim2_end TF_LINK(tf_codim2_end)
TF_API void tf_codim2_end(const free_motion_t *c, inclusion_t *in,
                          step_end_t *to);

// A slip ends where its course does, if that is in one of these modes and a
// force of the law leads there. Returns: whether that is so; if not, `to` is as
// it was.
#define tf_end_along_course TF_LINK(tf_end_along_course)
TF_API bool tf_end_along_course(const free_motion_t *c, const inclusion_t *in,
                                unsigned modes, step_end_t *to);

// Where no mode is consistent, or none that a slip may enter: of all ends that
// the step may take, the one that violates the law least.
#define tf_least_violation TF_LINK(tf_least_violation)
TF_API void tf_least_violation(const free_motion_t *c, inclusion_t *in,
                               unsigned set, step_end_t *to);

// Ends a step that loses its slip in two parts. c, in: of the whole step.
// Returns: whether both parts have a common end; if not, `to` is as it was.
#define tf_split_end TF_LINK(tf_split_end)
TF_API bool tf_split_end(const free_motion_t *c, const inclusion_t *in,
                         step_end_t *to);

// The end of a step whose balance of energy needs a check: in the form that
// creates no energy where it does, and not TF_OK where the step is too long for
// the motion.
#define tf_checked_end TF_LINK(tf_checked_end)
TF_API void tf_checked_end(const tf_machine_t *k, const tf_state_t *state,
                           const tf_input_t *input, step_end_t *to);

// The form that creates no energy: its end, the force of the step, and the slip
// that the end has. mode, force: what the linear step ends with.
typedef struct {
  end_state_t at;
  tf_force_t force;
  unsigned mode;
  tf_real_t delassus;
} balanced_end_t;

#define tf_balanced_end TF_LINK(tf_balanced_end)
TF_API balanced_end_t tf_balanced_end(const tf_machine_t *k,
                                      const tf_state_t *state,
                                      const tf_input_t *input, unsigned mode,
                                      tf_force_t force);

TF_INLINE bool may_step(const tf_state_t *state, const tf_input_t *input) {
  return state->mode < TF_MODES && in_range(state, input);
}

TF_INLINE balance_t balance_of_end(const tf_machine_t *k,
                                   const tf_state_t *state,
                                   const tf_input_t *input,
                                   const step_end_t *to) {
  const end_state_t from = {state->r, state->v, state->w};
  return balance_of(k, is_midpoint(k), input, from, to->end.at,
                    to->end.force.F);
}

// The end of a step: complete where it is a common one. What its stages have
// found is in registers; the rest is left to tf_rare_end.
TF_INLINE end_kind_t end_of_step(const tf_machine_t *k, const tf_state_t *state,
                                 const tf_input_t *input, start_t start,
                                 step_end_t *to) {
  if (!tf_tyre_is_set_valued(k->contact.tyre.law)) return END_SINGLE_VALUED;
  // Without a moment g = 0 is no border.
  const bool has_border = k->contact.stick_kappa > 0;
  if (has_border && state->mode == TF_PINNED) return END_CODIM2;
  // Free motion, (1)-(7).
  free_motion_t c = free_motion(k, state, input, start);
  if (!c.linear.definite) return END_TOO_LONG;
  // Inclusion, (8), and every mode that solves it.
  inclusion_t in;
  tf_contact_modes_t s;
  const unsigned signs = solve_inclusion(&c, &in, &s);
  // Choose.
  if (has_border && is_near_codim2(&c, &in, signs, s.set)) return END_CODIM2;
  const unsigned mode = choose_mode(k, state, &s);
  to->outcome = (outcome_t){.mode = mode, .set = s.set, .status = TF_OK};
  if (mode == TF_NO_MODE) return END_NO_MODE;
  // End in the mode, (9), (10).
  to->end = mode_end(&c, &s, mode, false);
  if (to->end.reverses | to->end.turns)
    return to->end.reverses ? END_REVERSED
           : to->end.held   ? END_HELD
                            : END_TURNING;
  to->outcome.delassus = end_delassus(&c, &in, signs, &to->end);
  // Balance.
  const balance_t b = balance_of_end(k, state, input, to);
  return !is_balanced(&b) || loses_slip(state->mode, mode) ? END_TO_CHECK
                                                           : END_COMMON;
}

#endif
