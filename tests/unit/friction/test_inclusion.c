/* The enumeration of consistent modes on its borders, by inclusions written by
 * hand in numbers that are exact: what holds there is decided by the law (a
 * slip needs h off 0, a stick an |x| <= 1, a stick with a moment g off 0), not
 * by rounding. */
#include "common.h"
#include "friction/inclusion.h"

#define BIT(mode) ((unsigned)TF_MODE_BIT(mode))
#define STICKS (BIT(TF_STICK_PLUS) | BIT(TF_STICK_MINUS))

static tf_real_t num(double x) { return (tf_real_t)x; }

static form_t affine(double c0, double F, double M) {
  return (form_t){.c0 = num(c0), .cx = num(F), .cy = num(M)};
}

/* h = c0 + F x and g = c0 + M y, out of reach of pinning. */
static inclusion_t inclusion(double h0, double hF, double g0, double gM) {
  return (inclusion_t){.h = affine(h0, hF, 0),
                       .g = affine(g0, 0, gM),
                       .g_now = num(g0),
                       .has_moment = true,
                       .pin_x = 2,
                       .pin_y = 2};
}

static solutions_t solved(const inclusion_t *in) {
  solutions_t out = {0};
  memset(&out, 0, sizeof out);
  enumerate(in, signs_of(&in->g), &out);
  return out;
}

static unsigned set_of(const inclusion_t *in) { return solved(in).set; }

/* g has one sign only if it has that sign at no force and at all four pairs of
 * extreme F and M. */
TEST(signs_of_g_are_those_of_extreme_forces) {
  for (int pair = 0; pair < 4; pair++)
    for (int sign = -1; sign <= 1; sign += 2) {
      const double s = sign, F = pair & 1 ? 1 : -1, M = pair & 2 ? 1 : -1;
      inclusion_t in = inclusion(1, 0, 0, 0);
      in.g = affine(s * 0.75, F * 0.25, M * 0.25); /* 0.25 at least */
      CHECK(signs_of(&in.g) == (sign > 0 ? 1 : 2));
      in.g = affine(s * 0.5, F * 0.25, M * 0.25); /* 0 at one pair */
      CHECK(signs_of(&in.g) == 3);
      in.g = affine(s * 0.25, F * 0.25, M * 0.25);
      CHECK(signs_of(&in.g) == 3);
      /* the terms of second order count as well */
      in.g = affine(s * 0.75, 0, 0);
      in.g.cxx = in.g.cyy = num(-s * 0.5);
      CHECK(signs_of(&in.g) == 3);
      in.g.cxx = in.g.cyy = num(-s * 0.25);
      CHECK(signs_of(&in.g) == (sign > 0 ? 1 : 2));
      in.g.cxy = num(F * M * 0.375);
      CHECK(signs_of(&in.g) == 3);
    }
  inclusion_t at_0 = inclusion(1, 0, 0, 0);
  CHECK(signs_of(&at_0.g) == 3);
  for (int sign = -1; sign <= 1; sign += 2) { /* 0 at no force alone */
    at_0.g.cxx = at_0.g.cyy = num(sign * 0.5);
    CHECK(signs_of(&at_0.g) == 3);
  }
}

/* Where neither sign of g ends as it began, the share s of the moment in a slip
 * is the root of g: it is 1 or -1 where g vanishes there, and never beyond. */
TEST(share_of_the_moment_is_at_most_1) {
  for (int i = 1; i <= 200; i++)
    for (int n = 0; n < 8; n++) {
      const int slip = n & 1, end = n & 2 ? -1 : 1, x = slip == 0 ? 1 : -1;
      const tf_real_t slope = -num(x) * 3 / 7;
      const tf_real_t bend = num(i) / (n & 4 ? 1024 : 1 << 22);
      inclusion_t in = inclusion(1, 1, 0, 0);
      in.g.c0 = -num(x * end) * slope - bend; /* g = 0 at y = x end */
      in.g.cy = slope;
      in.g.cyy = bend;
      const solutions_t out = solved(&in);
      CHECK(out.tau[slip] >= -1 && out.tau[slip] <= 1);
      CHECK_NEAR((double)out.tau[slip], end, 64 * (double)TF_REAL_EPSILON);
    }
}

/* A slip that would end on h = 0 is not consistent: the stick at x = +-1 is. */
TEST(slip_needs_nonzero_h) {
  for (int side = -1; side <= 1; side += 2)
    for (int sign = -1; sign <= 1; sign += 2) {
      const unsigned stick = BIT(sign > 0 ? TF_STICK_PLUS : TF_STICK_MINUS);
      inclusion_t in = inclusion(side, -1, 8 * sign, 1);
      CHECK(set_of(&in) == stick);
      in = inclusion(side, -1, sign * 0.125, 1); /* both signs of g */
      in.pin_x = num(side);
      in.pin_y = num(sign * -0.125);
      CHECK(set_of(&in) == (BIT(TF_PINNED) | (side > 0 ? STICKS : 0u)));
      /* an escaping one: from 0 on the other side leaves as well */
      in = inclusion(side, 1, 8 * sign, 1);
      CHECK(set_of(&in) == BIT(side > 0 ? TF_SLIP_PLUS : TF_SLIP_MINUS));
    }
}

/* With a moment a stick that ends at g = 0 is the pinned wheel; without one it
 * is a stick like others, and g = 0 goes with g > 0. */
TEST(stick_with_a_moment_needs_nonzero_g) {
  inclusion_t in = inclusion(0, -1, 0, 1);
  CHECK(set_of(&in) == 0);
  in.pin_x = in.pin_y = 0;
  CHECK(set_of(&in) == BIT(TF_PINNED));
  in = inclusion(0, -1, 0, 0);
  in.has_moment = false;
  CHECK(set_of(&in) == BIT(TF_STICK_PLUS));
}

/* The hull |y| <= 1, |x| <= 4/3 - |y|/3, the square |x|, |y| <= 1 and the bow
 * tie |y| <= |x| <= 1, all borders included. */
TEST(pinned_needs_a_force_of_the_law) {
  static const struct {
    double x, y;
    int holds[TF_REST_LAWS];
  } cases[] = {{1, 1, {1, 1, 1}},         {1, -1, {1, 1, 1}},
               {-1, 1, {1, 1, 1}},        {-1, -1, {1, 1, 1}},
               {1.25, 0, {1, 0, 0}},      {-1.25, 0, {1, 0, 0}},
               {1.25, 0.5, {0, 0, 0}},    {-1.375, 0, {0, 0, 0}},
               {0.5, 0.75, {1, 1, 0}},    {0.5, -0.75, {1, 1, 0}},
               {-0.5, 0.75, {1, 1, 0}},   {-0.5, 1.25, {0, 0, 0}},
               {1.0625, 0.75, {1, 0, 0}}, {-0.5, 0.5, {1, 1, 1}},
               {0.75, -0.5, {1, 1, 1}},   {0, 0, {1, 1, 1}}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    for (int rest = 0; rest < TF_REST_LAWS; rest++) {
      inclusion_t in = inclusion(0, -1, 0, 1);
      in.rest = (tf_rest_law_t)rest;
      in.pin_x = num(cases[i].x);
      in.pin_y = num(cases[i].y);
      CHECK(set_of(&in) == (cases[i].holds[rest] ? BIT(TF_PINNED) : 0));
      in.has_moment = false;
      CHECK(!(set_of(&in) & BIT(TF_PINNED)));
    }
}

/* h = (x - 1/2) (x + 1/4) bends so much that stick solves twice beside one
 * slip: the one with its sign of g is taken, that nearer to 0 if both have. */
TEST(stick_of_two_has_its_sign_of_g) {
  static const struct {
    double g0, slope; /* of s g along the segment of stick */
    double x;         /* 0: no stick */
  } cases[] = {{0.0625, 0.125, -0.25}, {0.5, 0.5, -0.25},
               {0.0625, -0.5, -0.25},  {0.0625, 0.5, 0.5},
               {-0.5, 4, 0.5},         {-0.5, 0.5, 0},
               {0.125, 0.5, 0},        {0.25, -0.5, -0.25}};
  for (int side = -1; side <= 1; side += 2)
    for (int s = -1; s <= 1; s += 2)
      for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const unsigned stick = BIT(s > 0 ? TF_STICK_PLUS : TF_STICK_MINUS);
        inclusion_t in = inclusion(-0.125 * side, -0.25 * side, 0, 0);
        in.h.cxx = num(side);
        in.g.c0 = num(s * cases[i].g0);
        in.g.cx = num(s * cases[i].slope);
        const solutions_t out = solved(&in);
        CHECK(!(out.set & stick) == (cases[i].x == 0));
        if (cases[i].x != 0) CHECK(out.x[s < 0] == num(cases[i].x));
      }
}

/* The root of h along a segment, where a series gives it and where the formula
 * does: as good as its rounding, however far h bends. */
TEST(stick_is_where_h_vanishes) {
  real worst = 0;
  for (int n = 0; n < samples(40000); n++) {
    const double q = exp2(tap_uniform(-40, -3)) * (n % 2 ? 1 : -1);
    const double c1 = tap_uniform(-2, -0.5), x1 = tap_uniform(0.1, 0.9);
    inclusion_t in = inclusion(-x1 * c1, c1, 8, 1);
    in.h.cxx = num(q * c1 / x1);
    const solutions_t out = solved(&in);
    const real a = wide(in.h.cxx), b = wide(in.h.cx), c = wide(in.h.c0);
    const real want = -2 * c / (b - sqrtl(b * b - 4 * a * c));
    if (fabsl(want) > 1) continue;
    if (!CHECK(out.set & BIT(TF_STICK_PLUS))) continue;
    CHECK(fabs(q) > 0x1p-6 || out.set == BIT(TF_STICK_PLUS));
    worst = fmaxl(worst, fabsl(wide(out.x[0]) - want) / want);
  }
  printf("# off by %.3Lg epsilon at most\n", worst / EPSILON);
  CHECK_NEAR(worst, 0, 3 * EPSILON);
}
