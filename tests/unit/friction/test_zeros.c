/* The common zeros of two forms, which pin a contact: those that are hard to
 * find. test_joint.c has those of any contact, by brute force. */
#include "common.h"
#include "friction/inclusion.h"
#include "moreau/stages.h"

/* c[0] + c[1] x + c[2] y + c[3] x^2 + c[4] x y + c[5] y^2. */
static tf_form_t form_of(const double c[6]) {
  return (tf_form_t){(tf_real_t)c[0], (tf_real_t)c[1], (tf_real_t)c[2],
                     (tf_real_t)c[3], (tf_real_t)c[4], (tf_real_t)c[5]};
}

static double value(const double c[6], double x, double y) {
  return c[0] + c[1] * x + c[2] * y + c[3] * x * x + c[4] * x * y +
         c[5] * y * y;
}

/* Whether rounding hides that a form is not 0. */
static bool vanishes(const tf_form_t *f, real x, real y) {
  const real c[6] = {wide(f->c0),  wide(f->cx),  wide(f->cy),
                     wide(f->cxx), wide(f->cxy), wide(f->cyy)};
  const real of[6] = {1, x, y, x * x, x * y, y * y};
  real sum = 0, size = 0;
  for (int i = 0; i < 6; i++) {
    sum += c[i] * of[i];
    size += fabsl(c[i]);
  }
  return fabsl(sum) <= 128 * EPSILON * size;
}

/* How two curves meet at the point that is drawn. */
typedef enum { CROSS, TOUCH, COINCIDE, WAYS } way_t;

/* Forms of any size, of coefficients that are alike, differ by decades or are
 * whole, which meet at (x, y). */
static void draw(way_t way, double x, double y, tf_form_t *h, tf_form_t *g) {
  const double unit = IS_DOUBLE ? 1e150 : 1e15;
  const uint64_t kind = tap_bits() % 3;
  const double k = (double)of_any_sign(log_uniform(0.1, 10));
  double c[2][6];
  for (int i = 0; i < 12; i++) {
    double *to = &c[i / 6][i % 6];
    *to = kind == 0 ? (double)of_any_sign(log_uniform(1e-4, 1e4))
                    : tap_uniform(-1, 1);
    if (kind == 1) *to = floor(2.5 * *to + 0.5) / 2;
    if (way == COINCIDE && i >= 6) *to = 2 * c[0][i - 6];
  }
  if (way == TOUCH) {
    const double *a = c[0];
    double *b = c[1];
    b[1] = k * (a[1] + 2 * a[3] * x + a[4] * y) - 2 * b[3] * x - b[4] * y;
    b[2] = k * (a[2] + a[4] * x + 2 * a[5] * y) - b[4] * x - 2 * b[5] * y;
  }
  for (int f = 0; f < 2; f++) {
    const double size = (double)log_uniform(1 / unit, unit);
    c[f][0] -= value(c[f], x, y);
    for (int i = 0; i < 6; i++) c[f][i] *= size;
  }
  *h = form_of(c[0]);
  *g = form_of(c[1]);
}

/* What is found is a zero, and the one that was drawn is among them: where the
 * curves touch but for the root of the rounding. */
TEST(zeros_of_any_forms_are_found) {
  int several = 0;
  for (int way = 0; way < WAYS; way++) {
    int missed = 0;
    const int count = samples(16000);
    for (int n = 0; n < count; n++) {
      const double x = tap_uniform(-1.3, 1.3), y = tap_uniform(-1.3, 1.3);
      tf_form_t h, g;
      multipliers_t at[TF_MOST_ZEROS];
      draw((way_t)way, x, y, &h, &g);
      const unsigned found = tf_common_zeros(&h, &g, at);
      double nearest = 9;
      CHECK(found <= TF_MOST_ZEROS);
      for (unsigned i = 0; i < found; i++) {
        const real X = wide(at[i].x), Y = wide(at[i].y);
        CHECK(vanishes(&h, X, Y) && vanishes(&g, X, Y));
        nearest = fmin(nearest, (double)(fabsl(X - x) + fabsl(Y - y)));
        for (unsigned j = 0; j < i && way == CROSS && IS_DOUBLE; j++)
          CHECK(at[i].x != at[j].x || at[i].y != at[j].y);
      }
      missed += nearest > (IS_DOUBLE ? 1e-5 : 0.05);
      several += found > 2;
    }
    printf("# way %d: %d of %d missed\n", way, missed, count);
    CHECK(way == COINCIDE || missed <= count / (way == TOUCH ? 25 : 500));
  }
  CHECK_ABOVE(several, samples(1000));
}

/* A step ends at h = g = 0 where p is 0 and either z or r is: at rest, which is
 * its pinned point, or on the axis, where friction cannot hold g at 0. One of
 * the two solves the inclusion where nothing else does. */
TEST(step_without_a_mode_could_end_on_the_axis) {
  unsigned pinned = 0, axis = 0, none = 0, missed = 0;
  for (int n = 0; n < samples(200000); n++) {
    tf_params_t p = wide_params();
    p.dt = log_uniform(1e-5, 0.03);
    const tf_machine_t k = prepared(&p);
    const tf_input_t u = tf_input_default(&k);
    tf_state_t x = {.r = log_uniform(1e-5, 1), .mode = TF_NO_MODE, .seed = 1};
    x.w = u.omega0 + of_any_sign(log_uniform(1e-4, 3));
    x.v = p.d * (x.w - u.omega0) + of_any_sign(log_uniform(1e-5, 1));
    free_motion_t c = free_motion(&k, &x, &u, start_of(&k, &x, &u));
    inclusion_t in = inclusion(&c);
    multipliers_t at[TF_MOST_ZEROS];
    if (!c.linear.definite || signs_of(&in.g) != BOTH_SIGNS) continue;
    add_pinned_point(&c, &in);
    const bool rests = rests_under(in.rest, in.pin_x, in.pin_y);
    const unsigned count = tf_common_zeros(&in.h, &in.g, at);
    const double close = IS_DOUBLE ? 1e-6 : 3e-2;
    bool is_found = false, is_solved = false;
    for (unsigned i = 0; i < count; i++) {
      const end_state_t end = end_after(&k, &c.linear, change_by(&c, at[i]));
      const bool stops = fabs((double)(at[i].x - in.pin_x)) < close &&
                         fabs((double)(at[i].y - in.pin_y)) < close;
      missed += !stops && fabs((double)end.r) >= close * (double)(x.r + p.dt);
      is_found |= stops;
      is_solved |= rests_under(in.rest, at[i].x, at[i].y);
      axis += !stops;
    }
    tf_contact_modes_t s = {0};
    enumerate(&in, BOTH_SIGNS, &s);
    const real det =
        wide(in.h.cx) * wide(in.g.cy) - wide(in.h.cy) * wide(in.g.cx);
    const real noise = 1e4L * EPSILON * fabsl(wide(in.h.cx) * wide(in.g.cx));
    missed += rests && !is_found && fabsl(det) >= noise;
    missed += s.set == 0 && !is_solved;
    pinned += rests;
    none += s.set == 0;
  }
  CHECK(pinned > 0 && axis > 0 && none > 0);
  CHECK(250 * missed <= (IS_DOUBLE ? 0 : pinned)); /* curves that touch */
  printf("# %u pinned, %u on the axis, %u without a mode\n", pinned, axis,
         none);
}
