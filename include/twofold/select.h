/// @file
/// Which of several consistent modes a step takes: a declared rule, part of the
/// scene.
///
/// What every rule shares:
/// 1. A slip that is still consistent goes on: off h = 0 the future is unique,
///    and a second consistent mode beside it is an artefact of the finite step
///    (it is reported all the same).
/// 2. Admissibility: a slip never enters an escaping stick, because both fields
///    point away from it.
/// 3. An attracting stick goes on.
/// 4. Where the present mode is lost: attracting stick, pinned, slip (the
///    faster one if both), escaping stick, in this order.
/// The rule decides how an escaping stick ends, and what a wheel does that
/// comes to h = g = 0 where it may rest. All rules but RANDOM take it into an
/// attracting stick where one is consistent, because it stands on the border of
/// that region and any disturbance moves it in. RANDOM lets it rest, pinned,
/// until its draw.
#ifndef TWOFOLD_SELECT_H
#define TWOFOLD_SELECT_H

#include <stdint.h>

#include "twofold/friction.h"
#include "twofold/machine.h"

/// Philox-2x32-10 (Salmon et al. 2011): a counter-based generator, so that a
/// state carries no stream position but its tick, and a replay needs no
/// history.
/// Scheme: none.
/// counter, key: in, any.
/// out: out, 2 words.
/// Returns: nothing.
/// Cost: at most 110 instructions; 10 multiplications 32 x 32 -> 64.
///   Stack: 64 B.
/// Memory: caller's, reentrant.
/// Claims: philox_known_answers
#define tf_philox TF_LINK(tf_philox)
TF_API void tf_philox(uint64_t counter, uint32_t key, uint32_t out[2]);

/// Picks one of the solutions of a step.
/// Scheme: the list at the top of this file.
/// rule: in.
/// exit_threshold: in, probability to leave an escaping stick in this step,
///   times 2^63 (RANDOM only).
/// solutions: in, from tf_friction_solve.
/// mode: in, present tf_mode_t.
/// tick, seed: in, counter and key (RANDOM only).
/// Returns: a tf_mode_t of solutions->set, or TF_MODES where none of it is
///   admissible.
/// Cost: at most 230 instructions; RANDOM with a draw. Stack: 112 B.
/// Memory: none kept, reentrant.
/// Claims: slip_never_enters_an_escaping_stick, rules_choose_as_declared,
///   random_exit_rate_is_independent_of_dt
#define tf_select TF_LINK(tf_select)
TF_API unsigned tf_select(tf_rule_t rule, uint64_t exit_threshold,
                          const tf_solutions_t *solutions, unsigned mode,
                          uint64_t tick, uint32_t seed);

#endif
