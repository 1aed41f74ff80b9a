// The ends of a step that are rare, as functions of their own: with an end, or
// with a status below TF_OK where the step is refused.
#ifndef TF_RARE_END_H
#define TF_RARE_END_H

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
  END_TO_CHECK       // a slip that ends, or a balance of energy to be checked
} end_kind_t;

// The end of a rare step, judged by its balance of energy. to: in/out; in are
// its end and its set, where it has got so far. Free motion and inclusion are
// formed anew, so that the common step need not keep them.
// Returns: the status of the end.
#define tf_rare_end TF_LINK(tf_rare_end)
TF_API tf_status_t tf_rare_end(end_kind_t kind, const tf_machine_t *k,
                               const tf_state_t *state, const tf_input_t *input,
                               const start_t *start, step_end_t *to);

// mode_end() as a function: rare ends are many, and need be small rather than
// fast.
#define tf_mode_end TF_LINK(tf_mode_end)
TF_API forced_end_t tf_mode_end(const free_motion_t *c,
                                const tf_contact_modes_t *s, unsigned mode);

// At h = g = 0, or near it with the mode lost; see codim2_end.c.
#define tf_codim2_end TF_LINK(tf_codim2_end)
TF_API void tf_codim2_end(free_motion_t *c, inclusion_t *in, step_end_t *to);

// A slip ends where its course does, if that is in one of these modes and a
// force of the law leads there. Returns: whether that is so; if not, `to` is as
// it was.
#define tf_end_along_course TF_LINK(tf_end_along_course)
TF_API bool tf_end_along_course(const free_motion_t *c, const inclusion_t *in,
                                unsigned modes, step_end_t *to);

// Where no mode is consistent, or none that a slip may enter: of all ends that
// the step may take, the one that violates the law least.
#define tf_least_violation TF_LINK(tf_least_violation)
TF_API void tf_least_violation(free_motion_t *c, inclusion_t *in, unsigned set,
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

#endif
