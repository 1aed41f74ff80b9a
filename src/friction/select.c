// The choice among the modes that are consistent, and its random generator.
#include "mode_set.h"
#include "twofold/contact.h"

// Philox-2x32-10, with the constants and rounds of Salmon et al. (2011).

TF_API void tf_philox(uint64_t counter, uint32_t key, uint32_t out[2]) {
  uint32_t left = (uint32_t)counter, right = (uint32_t)(counter >> 32);
  for (int round = 0; round < 10; round++) {
    const uint64_t product = (uint64_t)0xD256D193u * left;
    left = (uint32_t)(product >> 32) ^ key ^ right;
    right = (uint32_t)product;
    key += 0x9E3779B9u;
  }
  out[0] = left;
  out[1] = right;
}

// Which of several consistent modes a step takes.

// The stick of a non-empty set; of two, the one on the present side of g.
static unsigned stick_of(unsigned sticks, const tf_contact_modes_t *solutions) {
  if (has(sticks, solutions->near_stick)) return solutions->near_stick;
  return has(sticks, TF_STICK_PLUS) ? TF_STICK_PLUS : TF_STICK_MINUS;
}

// The n-th mode of a set that has more than n.
static unsigned nth_mode(unsigned set, unsigned n) {
  unsigned found = TF_NO_MODE;
  for (unsigned mode = 0; mode < TF_MODES; mode++)
    if (has(set, mode) && n-- == 0) found = mode;
  return found;
}

// Whether a constant rate of exit ends the present mode in this step. 63 bits
// decide: a rate as low as one exit in 2^63 steps is not rounded away.
static bool exits_now(uint64_t exit_threshold, const uint32_t word[2]) {
  return (((uint64_t)word[0] << 31) | (word[1] >> 1)) < exit_threshold;
}

// RANDOM draws the next mode from those that the physics allows. An escaping
// stick ends by a slip; a pinned wheel by whatever else is consistent. The low
// bits of the second word pick, because exits_now hardly uses them.
static unsigned random_exit(uint64_t exit_threshold, unsigned set,
                            unsigned mode, uint64_t tick, uint32_t seed) {
  const unsigned others =
      set & (mode == TF_PINNED ? ~TF_MODE_BIT(TF_PINNED) : SLIPS);
  const unsigned n = size_of(others);
  uint32_t word[2];
  if (n == 0) return mode;
  tf_philox(tick, seed, word);
  if (has(set, mode) && !exits_now(exit_threshold, word)) return mode;
  return nth_mode(others, (word[1] & 0xFFFFu) * n >> 16);
}

// How the rule ends a mode that is left to it; mode itself if it does not.
static unsigned rule_exit(tf_rule_t rule, uint64_t exit_threshold, unsigned set,
                          unsigned mode, uint64_t tick, uint32_t seed) {
  switch (rule) {
    case TF_RULE_SLIP_PLUS:
      return has(set, TF_SLIP_PLUS) ? TF_SLIP_PLUS : mode;
    case TF_RULE_SLIP_MINUS:
      return has(set, TF_SLIP_MINUS) ? TF_SLIP_MINUS : mode;
    case TF_RULE_RANDOM:
      return random_exit(exit_threshold, set, mode, tick, seed);
    case TF_RULE_PERSIST:
    default:
      break;
  }
  return mode;
}

// The faster slip of a non-empty set; of equal ones, where rounding hides
// which it is, the one with more of the moment: its mirror image the other. At
// gamma = 0 beside r = 0 both are equal in that, too (2 of 4e7 pairs in float).
static unsigned fastest_of(unsigned slips,
                           const tf_contact_modes_t *solutions) {
  const tf_real_t plus = magnitude(solutions->departure[0]),
                  minus = magnitude(solutions->departure[1]);
  const bool has_more =
      magnitude(solutions->tau[0]) >= magnitude(solutions->tau[1]);
  const bool plus_is_faster = plus > minus || (plus == minus && has_more);
  if (has(slips, TF_SLIP_PLUS) && (plus_is_faster || slips != SLIPS))
    return TF_SLIP_PLUS;
  return TF_SLIP_MINUS;
}

TF_API unsigned tf_contact_choose(const tf_contact_t *contact,
                                  const tf_contact_modes_t *solutions,
                                  unsigned mode, uint64_t tick, uint32_t seed) {
  const tf_rule_t rule = contact->rule;
  const unsigned set = solutions->set;
  const unsigned sticks = set & STICKS, slips = set & SLIPS;
  const unsigned attracting = set & solutions->attracting;
  const bool slipping = is_slip(mode);
  const bool lost = !has(set, mode);
  const bool waits_for_draw = mode == TF_PINNED && rule == TF_RULE_RANDOM;
  if (!lost && (slipping || has(attracting & STICKS, mode))) return mode;
  // It must not matter whether a step ends just before h = g = 0 or just after.
  if (lost && rule == TF_RULE_RANDOM && has(set, TF_PINNED)) return TF_PINNED;
  if (attracting & STICKS && !waits_for_draw && (lost || mode == TF_PINNED))
    return stick_of(attracting & STICKS, solutions);
  if (lost && has(attracting, TF_PINNED)) return TF_PINNED;
  if (attracting & SLIPS && !waits_for_draw && lost)
    return fastest_of(attracting & SLIPS, solutions);
  if (!lost || waits_for_draw) {
    const unsigned next =
        rule_exit(rule, contact->exit_threshold, set, mode, tick, seed);
    if (has(set, next)) return next;
  }
  if (has(set, TF_PINNED)) return TF_PINNED;
  if (slips) return fastest_of(slips, solutions);
  return sticks && !slipping ? stick_of(sticks, solutions) : TF_NO_MODE;
}
