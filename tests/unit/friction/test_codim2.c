/* Modes that are consistent at h = g = 0, and the course of a slip there,
 * against the reference. */
#include "codim2_field.h"

/* A machine, and a field that no machine has: its friction may drive, so that
 * directions from which the neighbours turn away lead out as well. */
static place_t any_field(int n) {
  place_t c = {.params = any_params(n)};
  ref_affine_t *at = &c.at;
  c.k = prepared(&c.params);
  const tf_input_t u = tf_input_default(&c.k);
  c.q = reference_of(&c.params, &u);
  real *const part[] = {&at->h, &at->g, &at->h_F, &at->g_F, &at->h_M, &at->g_M};
  for (int i = 0; i < 6; i++) *part[i] = wide(uniform(-1, 1));
  if (tap_bits() % 2) {
    at->h_F = fabsl(at->h_F);
    at->h = -c.q.mu * at->h_F * wide(uniform(1, TF_R(4.0) / 3));
    at->h_M *= 0.02L / c.q.kappa;
    at->g *= 0.02L;
    at->g_F *= 0.02L;
  }
  const tf_real_t mu = c.params.mu, kappa_mu = c.params.kappa * mu;
  c.field = (codim2_field_t){{(tf_real_t)at->h, mu * (tf_real_t)at->h_F,
                              kappa_mu * (tf_real_t)at->h_M},
                             {(tf_real_t)at->g, mu * (tf_real_t)at->g_F,
                              kappa_mu * (tf_real_t)at->g_M},
                             {2, 2}};
  return c;
}

/* The fastest of the limit directions out to one side that attract their
 * neighbours, or else of all; rate 0: there is none. */
static ref_way_t exit_of(const ref_consistent_t *found, ref_mode_t mode) {
  ref_way_t best = {.rate = 0};
  for (int i = 0; i < found->count; i++) {
    const ref_way_t next = found->list[i];
    if (next.mode == mode && (next.attracting == best.attracting
                                  ? next.rate > best.rate
                                  : next.attracting || best.rate == 0))
      best = next;
  }
  return best;
}

TEST(exits_of_any_field_are_those_of_a_search) {
  int attract = 0, repel = 0, close = 0;
  for (int n = 0; n < samples(2000); n++) {
    const place_t c = any_field(n);
    consistent_modes_t out;
    ref_consistent_t found;
    tf_codim2_modes(&c.k.contact, &c.field, &out);
    ref_consistent_field(&c.q, &c.at, &found);
    for (int slip = 0; slip < 2; slip++) {
      const unsigned bit = TF_MODE_BIT(TF_SLIP_PLUS + slip);
      const bool attracts = out.solutions.attracting & bit;
      const ref_way_t want = exit_of(&found, (ref_mode_t)slip);
      const real got = (out.solutions.set & bit)
                           ? fabsl(wide(out.solutions.departure[slip]))
                           : 0;
      const real size = 1 + wide(c.params.mu) * (1 + wide(c.params.kappa));
      if (attracts != want.attracting || fabsl(got - want.rate) > 1e-3L * size)
        close++;
      else if (want.rate > 0)
        (attracts ? attract++ : repel++);
    }
  }
  CHECK_ABOVE(attract, samples(1000));
  CHECK_ABOVE(repel, samples(10));
  CHECK_BELOW(close * 200, attract);
}

/* Only a stick that arrives goes on at rest where the bow tie holds the wheel:
 * which future a motion has that is at h = g = 0 and has lost its mode does not
 * depend on what that mode was. */
TEST(lost_modes_have_the_same_future) {
  int lost = 0, held = 0;
  for (int n = 0; n < samples(8000); n++) {
    place_t c = any_field(n);
    c.field.pin.x = uniform(-1, 1);
    c.field.pin.y = uniform(-1, 1) * c.field.pin.x;
    consistent_modes_t out;
    tf_codim2_modes(&c.k.contact, &c.field, &out);
    const unsigned none =
        tf_leave_codim2(&c.k.contact, &c.field, TF_NO_MODE, false, 7, 1, &out);
    for (unsigned mode = 0; mode < TF_PINNED; mode++) {
      if (tf_mode_is_slip(mode)) /* one that arrives is lost as well */
        CHECK(tf_leave_codim2(&c.k.contact, &c.field, mode, true, 7, 1, &out) ==
              none);
      if (out.solutions.set & TF_MODE_BIT(mode)) continue;
      CHECK(tf_leave_codim2(&c.k.contact, &c.field, mode, false, 7, 1, &out) ==
            none);
      lost++;
      held += none != TF_PINNED && !tf_mode_is_slip(mode) &&
              tf_leave_codim2(&c.k.contact, &c.field, mode, true, 7, 1, &out) ==
                  TF_PINNED;
    }
  }
  CHECK_ABOVE(lost, samples(8000));
  CHECK_ABOVE(held, samples(100));
}

/* Where a slip near h = g = 0 is after a step, by steps of its angle and its
 * distance that are short beside both. */
typedef struct {
  bool arrives, sticks;
  real h, g;
} followed_t;

static followed_t followed(const place_t *c, int side, real start,
                           real distance) {
  const real quarter = PAPER_PI / 2 - 1e-9L;
  real angle = start, time = 0;
  followed_t out = {false, false, 0, 0};
  for (int n = 0; n < 200000; n++) {
    const slip_rate_t rate = slip_rate_at(c, side, angle);
    const real size = fabsl(rate.rotation) + fabsl(rate.growth);
    real step = 2e-3L * distance / size;
    if (step > 1 - time) step = 1 - time;
    angle += rate.rotation / distance * step;
    distance += rate.growth * step;
    time += step;
    out.arrives = distance < 1e-6L;
    out.sticks = fabsl(angle) > quarter;
    if (out.arrives || out.sticks || time >= 1) break;
  }
  out.h = (real)side * distance * cosl(angle);
  out.g = distance * sinl(angle);
  return out;
}

/* The course of a slip near h = g = 0 within a step, against small steps of the
 * paper's law, as far as it stays in slip: where h comes to 0 the other side of
 * it goes on or holds it. */
TEST(slip_takes_its_course) {
  int slips = 0, arrives = 0, close = 0, leaves_h = 0;
  for (int n = 0; n < samples(1500); n++) {
    const place_t c = any_field(n);
    const int side = n & 1 ? 1 : -1;
    const real start = tap_uniform(-1.5, 1.5);
    const real distance = exp(tap_uniform(log(0.02), log(3)));
    const tf_slip_t slip = {(tf_real_t)(distance * (real)side * cosl(start)),
                            (tf_real_t)(distance * sinl(start))};
    const codim2_course_t is =
        tf_codim2_course(&c.k.contact, &c.field, slip, side < 0 ? MINUS : PLUS);
    const followed_t want = followed(&c, side, start, distance);
    if (want.sticks) {
      leaves_h += is.mode != (side > 0 ? TF_SLIP_PLUS : TF_SLIP_MINUS);
      close += is.mode == (side > 0 ? TF_SLIP_PLUS : TF_SLIP_MINUS);
      continue;
    }
    const real size = distance + hypotl(want.h, want.g);
    const real off = hypotl(wide(is.slip.h) - want.h, wide(is.slip.g) - want.g);
    if ((is.mode == TF_PINNED) != want.arrives || off > 0.1L * size)
      close++;
    else
      (want.arrives ? arrives++ : slips++);
    CHECK(is.share > 0 && is.share <= 1);
  }
  CHECK_ABOVE(slips, samples(500));
  CHECK_ABOVE(arrives, samples(5));
  CHECK_ABOVE(leaves_h, samples(100));
  CHECK_BELOW(close * 20, slips);
}

/* The same of slips that are on the way to h = g = 0 or pass close by it, with
 * a guess of the force: a course ends with the signs of its mode. */
TEST(a_course_ends_with_the_signs_of_its_mode) {
  int ends[TF_MODES + 1] = {0}, wrong = 0;
  for (int n = 0; n < samples(40000); n++) {
    const place_t c = any_field(n);
    const int side = n & 1 ? 1 : -1;
    const real angle = tap_uniform(-1.5, 1.5);
    const slip_rate_t rate = slip_rate_at(&c, side, angle);
    const real time = tap_uniform(0, 1), off = tap_uniform(-0.1, 0.1);
    /* Along -rate, for a time, past h = g = 0 by a share of that. */
    const real C = cosl(angle), S = sinl(angle);
    const real h = rate.growth * C - rate.rotation * S;
    const real g = rate.growth * S + rate.rotation * C;
    const tf_slip_t slip = {(tf_real_t)((real)side * time * (-h - off * g)),
                            (tf_real_t)(time * (-g + off * h))};
    if (!((tf_real_t)side * slip.h > 0)) continue;
    const codim2_course_t is =
        tf_codim2_course(&c.k.contact, &c.field, slip, side < 0 ? MINUS : PLUS);
    const tf_slip_t end = is.slip;
    ends[is.mode]++;
    if (is.mode == TF_SLIP_PLUS) wrong += !(end.h >= 0);
    if (is.mode == TF_SLIP_MINUS) wrong += !(end.h <= 0);
    if (!tf_mode_is_slip(is.mode)) wrong += end.h != 0;
    if (is.mode == TF_STICK_PLUS) wrong += !(end.g > 0);
    if (is.mode == TF_STICK_MINUS) wrong += !(end.g < 0);
    if (is.mode == TF_PINNED) wrong += end.g != 0;
    CHECK(is.share >= 0 && is.share <= 1);
  }
  CHECK(wrong == 0 && ends[TF_NO_MODE] == 0);
  for (int mode = 0; mode < TF_MODES; mode++)
    CHECK_ABOVE(ends[mode], samples(200));
}

TEST(a_field_that_is_no_number_has_no_course) {
  const tf_params_t params = tf_scenes[0]->params;
  const tf_machine_t k = prepared(&params);
  const tf_real_t none = (tf_real_t)NAN;
  const codim2_field_t field = {{none, 1, 1}, {1, none, 1}, {2, 2}};
  for (int side = -1; side <= 1; side += 2)
    CHECK(tf_codim2_course(&k.contact, &field, (tf_slip_t){(tf_real_t)side, 1},
                           side < 0 ? MINUS : PLUS)
              .mode == TF_NO_MODE);
}
