/* The selection rule against its own declaration (tf_rule_t): every set of
 * modes, every pattern of attracting sticks, every present mode and rule, so
 * that no branch is left to luck; then the random rule as statistics, with
 * bounds of five standard deviations that a fixed seed keeps or breaks. */
#include <stdbool.h>

#include "friction/mode_set.h"
#include "tap.h"
#include "twofold.h"

#define BIT(mode) ((unsigned)TF_MODE_BIT(mode))
#define NEVER UINT64_C(0)
#define ALWAYS (UINT64_C(1) << 63)

/* One question to tf_contact_choose. */
typedef struct {
  tf_rule_t rule;
  unsigned set, attracting, near, mode;
  bool minus_is_faster;
  uint64_t threshold;
} question_t;

static unsigned answer(const question_t *q, uint64_t tick, uint32_t seed) {
  const tf_contact_modes_t solutions = {
      .set = (uint8_t)q->set,
      .attracting = (uint8_t)q->attracting,
      .near_stick = (uint8_t)q->near,
      .departure = {2, q->minus_is_faster ? -3 : -1}};
  const tf_contact_t contact = {.rule = q->rule,
                                .exit_threshold = q->threshold};
  return tf_contact_choose(&contact, &solutions, q->mode, tick, seed);
}

/* Number n of all questions; false past the last. */
static bool question(unsigned n, question_t *q) {
  q->set = n & 31u;
  q->attracting = n >> 5 & 15u; /* slips as well, as at h = g = 0 */
  q->near = n >> 9 & 1u ? TF_STICK_MINUS : TF_STICK_PLUS;
  q->minus_is_faster = n >> 10 & 1u;
  q->threshold = n >> 11 & 1u ? ALWAYS : NEVER;
  n >>= 12;
  q->mode = n % TF_MODES;
  q->rule = (tf_rule_t)(n / TF_MODES % TF_RULES);
  return n < TF_MODES * TF_RULES;
}

/* The one of these sticks at the present side of g, else the other. */
static unsigned nearest(unsigned sticks, unsigned near) {
  return (sticks & BIT(near)) ? BIT(near) : sticks;
}

/* (4): where the present mode is lost. Answers are sets of one mode, or more
 * where chance decides; bit TF_NO_MODE is "none". */
static unsigned when_lost(const question_t *q) {
  const unsigned sticks = q->set & STICKS;
  const unsigned fast = q->minus_is_faster ? TF_SLIP_MINUS : TF_SLIP_PLUS;
  const unsigned turning = q->set & SLIPS & q->attracting;
  if (sticks & q->attracting) return nearest(sticks & q->attracting, q->near);
  if (turning) return turning == SLIPS ? BIT(fast) : turning;
  if (q->set & BIT(TF_PINNED)) return BIT(TF_PINNED);
  if (q->set & SLIPS)
    return (q->set & SLIPS) == SLIPS ? BIT(fast) : q->set & SLIPS;
  if (sticks && !is_slip(q->mode)) return nearest(sticks, q->near);
  return BIT(TF_NO_MODE);
}

/* How the rule ends an escaping stick that is still consistent. */
static unsigned when_escaping(const question_t *q) {
  const unsigned now = BIT(q->mode), slips = q->set & SLIPS;
  if (q->rule == TF_RULE_SLIP_PLUS)
    return (slips & BIT(TF_SLIP_PLUS)) ? BIT(TF_SLIP_PLUS) : now;
  if (q->rule == TF_RULE_SLIP_MINUS)
    return (slips & BIT(TF_SLIP_MINUS)) ? BIT(TF_SLIP_MINUS) : now;
  if (q->rule == TF_RULE_RANDOM)
    return q->threshold == ALWAYS && slips ? slips : now;
  return now;
}

/* RANDOM draws among the other modes; the others go into an attracting
 * stick and otherwise do as with an escaping stick. */
static unsigned when_pinned(const question_t *q) {
  const unsigned now = q->set & BIT(TF_PINNED);
  const unsigned others = q->set & ~BIT(TF_PINNED);
  const unsigned safe = others & STICKS & q->attracting;
  if (q->rule == TF_RULE_RANDOM) {
    if (now && (q->threshold == NEVER || !others)) return now;
    return others ? others : BIT(TF_NO_MODE);
  }
  if (!now || safe) return when_lost(q);
  return when_escaping(q);
}

static unsigned declared(const question_t *q) {
  const unsigned now = BIT(q->mode);
  if (q->mode == TF_PINNED) return when_pinned(q);
  if (!(q->set & now)) {
    const unsigned rest = q->set & BIT(TF_PINNED);
    return rest && q->rule == TF_RULE_RANDOM ? rest : when_lost(q);
  }
  if (now & SLIPS || now & q->attracting) return now;
  return when_escaping(q);
}

static void print_question(const question_t *q, unsigned got) {
  printf("# rule %d set %#x attracting %#x near %u mode %u faster %c: %u\n",
         (int)q->rule, q->set, q->attracting, q->near, q->mode,
         q->minus_is_faster ? '-' : '+', got);
}

/* Also from an escaping stick, which is the rules' own to end: an attracting
 * stick beside it is not one of their exits. */
TEST(rules_choose_as_declared) {
  question_t q;
  for (unsigned n = 0; question(n, &q); n++) {
    for (uint64_t tick = 0; tick < 8; tick++) {
      const unsigned got = answer(&q, tick, 1);
      if (!CHECK(declared(&q) & BIT(got))) print_question(&q, got);
    }
  }
}

/* An escaping stick and both slips, under the random rule. */
static const question_t escaping = {.rule = TF_RULE_RANDOM,
                                    .set = SLIPS | BIT(TF_STICK_PLUS),
                                    .near = TF_STICK_PLUS,
                                    .mode = TF_STICK_PLUS,
                                    .threshold = ALWAYS / 2};

/* Of two slips that are equally fast the image takes the image. */
TEST(equally_fast_slips_have_a_mirror_image) {
  const tf_contact_t contact = {.rule = TF_RULE_PERSIST};
  tf_contact_modes_t s = {.set = SLIPS, .departure = {1, -1}};
  s.tau[0] = TF_R(-0.1), s.tau[1] = TF_R(0.2);
  CHECK(tf_contact_choose(&contact, &s, TF_NO_MODE, 0, 0) == TF_SLIP_MINUS);
  s.tau[0] = TF_R(-0.2), s.tau[1] = TF_R(0.1);
  CHECK(tf_contact_choose(&contact, &s, TF_NO_MODE, 0, 0) == TF_SLIP_PLUS);
}

/* 63 bits of the generator decide, so the threshold has no coarser grain. */
TEST(random_exit_has_a_sharp_threshold) {
  for (uint64_t tick = 0; tick < 10000; tick++) {
    question_t q = escaping;
    uint32_t word[2];
    tf_philox(tick, 9, word);
    q.threshold = (uint64_t)word[0] << 31 | word[1] >> 1;
    CHECK(answer(&q, tick, 9) == q.mode);
    q.threshold++;
    CHECK(answer(&q, tick, 9) != q.mode);
    q.threshold = NEVER;
    CHECK(answer(&q, tick, 9) == q.mode);
    q.threshold = ALWAYS;
    CHECK(answer(&q, tick, 9) != q.mode);
  }
}

/* Also where an exit is so rare that it fixes the whole first word of the
 * generator but for 14 bits. */
TEST(rare_exits_take_either_side) {
  question_t q = escaping;
  int exits = 0, plus = 0;
  q.threshold = ALWAYS >> 18;
  for (uint64_t tick = 0; tick < UINT64_C(64) << 18; tick++) {
    uint32_t word[2];
    tf_philox(tick, 9, word);
    if (word[0] >> 14) continue;
    const unsigned got = answer(&q, tick, 9);
    CHECK(got != q.mode);
    exits++;
    plus += got == TF_SLIP_PLUS;
  }
  CHECK(exits > 32);
  CHECK(fabs(plus - exits / 2.0) < 5 * sqrt(exits) / 2);
}

/* Every choice out of n others has its share: chi square of n - 1 degrees of
 * freedom, below mean + 5 standard deviations. stays is what must come where
 * there is no other. */
static void judge_draws(const question_t *q, unsigned others, unsigned stays) {
  int count[TF_MODES + 1] = {0, 0, 0, 0, 0, 0}, n = 0;
  const int N = samples(60000);
  for (int tick = 0; tick < N; tick++) count[answer(q, (uint64_t)tick, 5)]++;
  for (unsigned mode = 0; mode < 4; mode++) n += others >> mode & 1u ? 1 : 0;
  if (n == 0) {
    CHECK(count[stays] == N);
    return;
  }
  double chi2 = 0;
  for (unsigned mode = 0; mode <= TF_MODES; mode++) {
    const double want = others >> mode & 1u ? (double)N / n : 0;
    if (want > 0)
      chi2 += (count[mode] - want) * (count[mode] - want) / want;
    else
      CHECK(count[mode] == 0);
  }
  CHECK(chi2 < n - 1 + 5 * sqrt(2.0 * n));
}

/* A pinned wheel that leaves, and one that has to: there the rate does not
 * matter. */
TEST(random_draws_are_even) {
  for (unsigned others = 0; others < 16; others++) {
    question_t q = {.rule = TF_RULE_RANDOM,
                    .set = others | BIT(TF_PINNED),
                    .attracting = BIT(TF_STICK_MINUS),
                    .near = TF_STICK_MINUS,
                    .mode = TF_PINNED,
                    .threshold = ALWAYS};
    judge_draws(&q, others, TF_PINNED);
    q.set = others;
    q.threshold = NEVER;
    judge_draws(&q, others, TF_NO_MODE);
  }
}
