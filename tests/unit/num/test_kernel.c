/* The elementary functions of the core against libm in long double: every
 * error bound that a header claims is measured here, in units in the last
 * place (ULP) of the real type, over the whole range that the header admits
 * and at the points where such code breaks: borders of the range reduction,
 * subnormal arguments, the numbers next to multiples of pi/2. */
#include "common.h"
#include "friction/tyre_law.h"
#include "model/mechanics.h"
#include "same_state.h"

/* Claimed bounds [ULP]. For cot_psi over kappa in [1e-9, 1e6] the
 * largest error of 1.5e8 samples is 11.2 (double) and 9.8 (float). */
#define COT_PSI_ULP 16
#define SINE_ULP 2
#define ARCTANGENT_ULP 2
#define EXIT_ULP 16

#ifdef TF_REAL_FLOAT
#define MIN_EXPONENT (FLT_MIN_EXP - 1)
#define PI_REAL 0x1.921fb6p+1f
#else
#define MIN_EXPONENT (DBL_MIN_EXP - 1)
#define PI_REAL 0x1.921fb54442d18p+1
#endif

/* Error of got in units in the last place of want. */
static real ulps(tf_real_t got, real want) {
  int exponent = want == 0 ? MIN_EXPONENT : ilogbl(want);
  if (exponent < MIN_EXPONENT) exponent = MIN_EXPONENT;
  return fabsl(wide(got) - want) / ldexpl(wide(TF_REAL_EPSILON), exponent);
}

static tf_tyre_t tyre_with(tf_real_t kappa) {
  tf_params_t params = tf_scenes[0]->params;
  params.kappa = kappa;
  return prepared(&params).contact.tyre;
}

/* tan(a atan(G/H)), a = (2/pi) atan(6 kappa). Above 1 it is the cotangent of
 * the rest, which is the paper's psi: tan near pi/2 would lose digits. */
static real cot_psi_by_libm(real kappa, real G, real H) {
  const real half_pi = acosl(0), T_top = 6 * kappa;
  const real angle = atanl(T_top) / half_pi * atan2l(G, H);
  if (angle < half_pi / 2) return tanl(angle);
  return 1 / tanl(atan2l(H, G) + atanl(1 / T_top) / half_pi * atan2l(G, H));
}

static void judge(const tf_tyre_t *tyre, tf_real_t G, tf_real_t H) {
  const tf_real_t T = cot_psi(tyre, G, H);
  const real top = 6 * wide(tyre->kappa);
  const real error =
      ulps(T, cot_psi_by_libm(wide(tyre->kappa), wide(G), wide(H)));
  CHECK(T >= 0 && wide(T) <= top * (1 + 2 * wide(TF_REAL_EPSILON)));
  if (!CHECK(error <= COT_PSI_ULP))
    printf("# kappa %La G %La H %La: %Lg ULP\n", wide(tyre->kappa), wide(G),
           wide(H), error);
}

/* Ratios of all sizes; then ratios next to the anchors and borders, where w
 * is smallest and largest. */
static void judge_ratios(const tf_tyre_t *tyre, int count) {
  const real step = acosl(0) / 16;
  for (int i = 0; i < count; i++) {
    const tf_real_t H = log_uniform(1e-3, 1e3);
    judge(tyre, H * log_uniform(1e-18, 1e18), H);
    judge(tyre, H * log_uniform(1e-2, 1e2), H);
    judge(tyre, H * (tf_real_t)tan(tap_uniform(0, 1.57)), H);
    tf_real_t G = H * (tf_real_t)tanl(step * (real)(i % 15 + 1));
    const tf_real_t to = i & 1 ? 0 : TF_R(1e30);
    for (int n = 0; n < 3; n++, G = NEXT(G, to)) judge(tyre, G, H);
  }
}

static void judge_extremes(const tf_tyre_t *tyre) {
  const tf_real_t tiny[] = {
      TF_REAL_MIN, TF_REAL_MIN / 4, TF_REAL_MIN * TF_REAL_EPSILON,
      7 * TF_REAL_MIN * TF_REAL_EPSILON, TF_REAL_MIN / TF_REAL_EPSILON};
  for (int i = 0; i < 5; i++) {
    for (int j = 0; j < 5; j++) judge(tyre, tiny[i], tiny[j]);
    judge(tyre, tiny[i], 1);
    judge(tyre, 1, tiny[i]);
    judge(tyre, tiny[i], TF_R(1e30));
    judge(tyre, TF_R(1e30), tiny[i]);
    judge(tyre, tiny[i], 0);
    judge(tyre, 0, tiny[i]);
  }
  for (int i = 0; i < 200; i++) { /* products with an anchor are subnormal */
    const tf_real_t H =
        TF_REAL_MIN * log_uniform(1, (double)(4 / TF_REAL_EPSILON));
    judge(tyre, H * log_uniform(0.05, 20), H);
  }
  judge(tyre, TF_R(1e30), TF_R(1e30));
  judge(tyre, TF_R(1e30), TF_R(0.7e30));
  judge(tyre, TF_R(0.1e30), TF_R(1e30));
  CHECK(cot_psi(tyre, 0, 0) == 0);
  CHECK(cot_psi(tyre, 0, 1) == 0);
}

/* The anchors T = tan(a n pi/16) where most of them are steep. Those above pi/4
 * come down from T(inf), which is exact: a sum of angles would multiply the
 * rounding of its terms, and T[6] is that of the smallest angle. By the square
 * mean, which chance does not change. */
TEST(anchors_error_bound) {
  real sum[TF_TYRE_ANCHORS] = {0};
  const int count = samples(20000);
  for (int i = 0; i < count; i++) {
    const tf_tyre_t tyre = tyre_with(log_uniform(1, 1e6));
    const real whole = atanl(6 * wide(tyre.kappa));
    for (int n = 1; n < TF_TYRE_ANCHORS - 1; n++) {
      const real off = ulps(tyre.T_anchor[n], tanl(whole * (real)n / 8));
      sum[n] += off * off / count;
    }
  }
  for (int n = 1; n < TF_TYRE_ANCHORS - 1; n++)
    if (!CHECK(sqrtl(sum[n]) < (n == 6 ? 0.85L : 1.2L))) printf("# T[%d]\n", n);
}

TEST(angle_kernel_error_bound) {
  const struct {
    double low, high;
  } band[] = {{1e-9, 1e-6}, {1e-6, 1}, {1, 1e3}, {1e3, 1e6}};
  const tf_real_t end[] = {TF_R(1e-9), TF_R(1e6), 1};
  for (int b = 0; b < 4; b++) {
    for (int i = 0; i < samples(1000); i++) {
      const tf_tyre_t tyre = tyre_with(log_uniform(band[b].low, band[b].high));
      judge_ratios(&tyre, 30);
      if (i < 10) judge_extremes(&tyre);
    }
  }
  for (int i = 0; i < 3; i++) {
    const tf_tyre_t tyre = tyre_with(end[i]);
    judge_ratios(&tyre, 2000);
    judge_extremes(&tyre);
  }
}

static void judge_sine(tf_real_t x) {
  tf_real_t s, c, s_minus, c_minus;
  tf_sine_cosine(x, &s, &c);
  tf_sine_cosine(-x, &s_minus, &c_minus);
  const real in_s = ulps(s, sinl(wide(x))), in_c = ulps(c, cosl(wide(x)));
  if (!CHECK(in_s <= SINE_ULP && in_c <= SINE_ULP))
    printf("# at %La: %Lg, %Lg ULP\n", wide(x), in_s, in_c);
  if (!CHECK(same_bits(s_minus, -s) && same_bits(c_minus, c)))
    printf("# at %La\n", wide(x));
}

TEST(sine_kernel_error_bound) {
  const tf_real_t special[] = {0,
                               TF_REAL_MIN,
                               TF_REAL_MIN * TF_REAL_EPSILON,
                               PI_REAL,
                               PI_REAL / 2,
                               PI_REAL * TF_R(0.75),
                               PI_REAL / 4,
                               TF_R(2.35619449019234492885),
                               TF_R(3.2),
                               1};
  for (int i = 0; i < 10; i++) judge_sine(special[i]);
  for (int i = 0; i < samples(400000); i++) judge_sine(uniform(-3.2, 3.2));
  for (int i = 0; i < samples(20000); i++) judge_sine(log_uniform(1e-30, 3.2));
  for (int q = 1; q <= 8; q++) { /* multiples of pi/8: reduction, its borders */
    tf_real_t up = PI_REAL * (tf_real_t)q / 8, down = up;
    for (int n = 0; n < 2000; n++) {
      judge_sine(up);
      judge_sine(down);
      up = NEXT(up, TF_R(4.0));
      down = NEXT(down, TF_R(0.0));
    }
  }
}

TEST(arctangent_kernel) {
  for (int i = 0; i < samples(400000); i++) {
    const tf_real_t t = i & 1 ? uniform(-0.1, 0.1) : log_uniform(1e-30, 0.1);
    const tf_real_t y = tf_small_arctangent(t);
    const real error = ulps(y, atanl(wide(t)));
    CHECK(error <= ARCTANGENT_ULP);
    CHECK(tf_small_arctangent(-t) == -y);
  }
  CHECK(ulps(tf_small_arctangent(TF_R(0.1)), atanl(wide(TF_R(0.1)))) <=
        ARCTANGENT_ULP);
  CHECK(tf_small_arctangent(0) == 0);
}

/* Below 1024 times the least normal number x/1024 is subnormal: then the
 * error is absolute. */
TEST(exit_probability_kernel) {
  const tf_real_t least = 1024 * TF_REAL_MIN;
  for (int i = 0; i < samples(200000); i++) {
    const tf_real_t x =
        i & 1 ? log_uniform((double)least, 1e3) : log_uniform(1e-4, 1e2);
    const tf_real_t p = tf_exit_probability(x);
    const real error = ulps(p, -expm1l(-wide(x)));
    if (!CHECK(error <= EXIT_ULP && p <= 1))
      printf("# at %La: %Lg ULP\n", wide(x), error);
  }
  for (tf_real_t x = least; x > 0; x /= 2)
    CHECK_NEAR(wide(tf_exit_probability(x)), wide(x),
               wide(least * TF_REAL_EPSILON));
  CHECK(tf_exit_probability(0) == 0);
  CHECK(tf_exit_probability(40) == 1);
  CHECK(tf_exit_probability(TF_REAL_MAX) == 1);
  CHECK(tf_exit_probability((tf_real_t)NAN) == 1);
}

/* The vectors of Random123's kat_vectors: counter low word first. */
TEST(philox_known_answers) {
  const struct {
    uint64_t counter;
    uint32_t key, out[2];
  } known[] = {{0, 0, {0xff1dae59u, 0x6cd10df2u}},
               {UINT64_MAX, UINT32_MAX, {0x2c3f628bu, 0xab4fd7adu}},
               {0x85a308d3243f6a88u, 0x13198a2eu, {0xdd7ce038u, 0xf62a4c12u}}};
  for (int i = 0; i < 3; i++) {
    uint32_t out[2] = {1, 2};
    tf_philox(known[i].counter, known[i].key, out);
    CHECK(out[0] == known[i].out[0]);
    CHECK(out[1] == known[i].out[1]);
  }
}

/* Numbers at and around the limit of a state, and infinity and NaN. */
static tf_real_t at_the_limit(int i) {
  static const tf_real_t some[] = {0,
                                   TF_REAL_MIN,
                                   1,
                                   TF_STATE_LIMIT / 2,
                                   TF_STATE_LIMIT,
                                   TF_STATE_LIMIT * (1 + TF_REAL_EPSILON),
                                   TF_STATE_LIMIT * 2,
                                   TF_REAL_MAX,
                                   (tf_real_t)INFINITY,
                                   (tf_real_t)NAN};
  return i % 2 ? -some[i / 2] : some[i / 2];
}
#define AT_THE_LIMIT 20

static int is_in_reach(tf_real_t x) {
  return isfinite(x) && x >= -TF_STATE_LIMIT && x <= TF_STATE_LIMIT;
}

/* Of a state and an input that are checked, each is finite and within the
 * limit, and nothing else is refused; sums: test_begin.c.
 * tools/verify/eva/cases.h assumes that clip() makes the lower bound of NaN. */
TEST(numbers_that_pass_are_finite_and_within_the_limit) {
  for (int i = 0; i < AT_THE_LIMIT; i++) {
    const tf_real_t a = at_the_limit(i), y = clip(a, -1, 1);
    CHECK(within(a, TF_STATE_LIMIT) == is_in_reach(a));
    CHECK(y >= -1 && y <= 1 && (!isnan(a) || y == -1));
    for (int j = 0; j < 15 * AT_THE_LIMIT; j++) {
      const tf_real_t b = at_the_limit(j / 15);
      tf_state_t x = {.r = 0};
      tf_input_t u = {.r0 = 0};
      tf_real_t *const state[] = {&x.r, &x.v, &x.w};
      tf_real_t *const input[] = {&u.omega0, &u.r0, &u.force, &u.torque,
                                  &u.alpha};
      *state[j % 3] = a;
      *input[j % 5] = b;
      CHECK(in_range(&x, &u) == (is_in_reach(a) && is_in_reach(b)));
    }
  }
}
