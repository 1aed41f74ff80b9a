/* The first root of a series in an interval: of products of known factors. */
#include "num/polynomial.h"
#include "sample.h"

static series_t parabola(tf_real_t c0, tf_real_t c1, tf_real_t c2) {
  series_t s;
  memset(&s, 0, sizeof s);
  s.c[0] = c0;
  s.c[1] = c1;
  s.c[2] = c2;
  return s;
}

static series_t times(const series_t *s, double root) {
  series_t out;
  for (int n = 0; n <= SERIES_ORDER; n++)
    out.c[n] = (n > 0 ? s->c[n - 1] : 0) - (tf_real_t)root * s->c[n];
  return out;
}

/* Positive at 0: as many factors as roots, of either sign. */
static series_t with_roots(const double *root, int count) {
  series_t s = parabola(count % 2 ? -1 : 1, 0, 0);
  for (int i = 0; i < count; i++) s = times(&s, root[i]);
  return s;
}

TEST(first_of_several_roots_is_found) {
  int found[4] = {0};
  for (int n = 0; n < samples(3000); n++) {
    const int count = 1 + n % 3;
    double root[3], first = 1;
    for (int i = 0; i < count; i++) root[i] = tap_uniform(0.02, 1.5);
    for (int i = 0; i < count; i++) first = root[i] < first ? root[i] : first;
    int near = 0;
    for (int i = 0; i < count; i++)
      near += fabs(root[i] - first) < 0.02 || fabs(root[i] - 1) < 0.02;
    if (near > (first < 1)) continue; /* nearly a touch, or at the end */
    const series_t s = with_roots(root, count);
    tf_real_t when = -1;
    if (!CHECK(tf_first_root(&s, SERIES_ORDER, 1, &when) == (first < 1)))
      continue;
    if (first < 1) {
      CHECK_NEAR(wide(when), (real)first, 20000 * EPSILON);
      CHECK(!is_rootless(&s, SERIES_ORDER, 1));
    }
    found[first < 1 ? count : 0]++;
  }
  for (int i = 0; i < 4; i++) CHECK(found[i] > samples(50));
}

/* (t + a) (b - t) rises at first and has its root b all the same; what stays
 * above 0 because its slope is too small needs no further look. */
TEST(no_root_is_taken_for_none) {
  for (int n = 0; n < 1000; n++) {
    const tf_real_t a = uniform(0, 0.1), b = uniform(0.001, 1);
    const tf_real_t length = b * uniform(1.01, 3);
    series_t s = parabola(a * b, b - a, -1);
    tf_real_t when = -1;
    CHECK(!is_rootless(&s, SERIES_ORDER, length));
    CHECK(tf_first_root(&s, SERIES_ORDER, length, &when));
    CHECK_NEAR(wide(when), wide(b), 64 * EPSILON);
    s.c[0] = (a + b + length) * length;
    CHECK(is_rootless(&s, SERIES_ORDER, length) &&
          !tf_first_root(&s, SERIES_ORDER, length, &when));
  }
}

/* At c0 = 0 the root that is there is not meant: t (t + a) has no other one,
 * t (b - t) has b. */
TEST(root_at_the_start_is_not_meant) {
  for (int n = 0; n < 1000; n++) {
    const tf_real_t a = uniform(0.01, 1), b = uniform(0.01, 1);
    series_t s = parabola(0, a, 1);
    tf_real_t when = -1;
    CHECK(!tf_first_root(&s, SERIES_ORDER, 1, &when));
    s = parabola(0, b, -1);
    CHECK(tf_first_root(&s, SERIES_ORDER, 1, &when));
    CHECK_NEAR(wide(when), wide(b), 64 * EPSILON);
  }
}

/* A double crossing before a third root: the first of them is found as far as
 * the halving goes. */
TEST(close_roots_hide_none_behind_them) {
  const double least = sizeof(tf_real_t) == 8 ? 1e-3 : 2e-2;
  int found = 0, tried = 0;
  for (int n = 0; n < samples(20000); n++) {
    const double a = tap_uniform(0.02, 0.8);
    const double gap = exp(tap_uniform(log(least), log(0.1)));
    const double root[3] = {a, a + gap, tap_uniform(a + gap + 0.02, 0.98)};
    if (root[2] < a + gap) continue;
    const series_t s = with_roots(root, 3);
    tf_real_t when = -1;
    tried++;
    if (!CHECK(tf_first_root(&s, SERIES_ORDER, 1, &when))) continue;
    found += fabsl(wide(when) - (real)a) < 1e3L * EPSILON / (real)gap;
  }
  printf("# %d of %d\n", found, tried);
  CHECK(tried > samples(5000) && found == tried);
  const series_t nothing = parabola(0, 0, 0);
  tf_real_t when = -1;
  CHECK(!tf_first_root(&nothing, SERIES_ORDER, 1, &when) && when == -1);
}
