/* The pinned points of a contact against brute force in long double: h = 0 is
 * solved for y on rows of x and for x on rows of y, and where |g| is least or
 * changes its sign along what comes of it, Newton's method goes on from there.
 * DRAWS=1000000 in the environment draws as many systems of each class. */
#include "common.h"
#include "friction/inclusion.h"
#include "moreau/stages.h"

#define ROWS 160
#define REACH 1.45L
#define MANY 24

/* f = c[0] + c[1] x + c[2] y + c[3] x^2 + c[4] x y + c[5] y^2. */
typedef struct {
  real c[6];
} conic_t;

/* A zero; what rounding makes of it; whether it could be none. */
typedef struct {
  real x, y, off;
  int unsure;
} zero_t;

typedef struct {
  conic_t h, g;
  zero_t at[MANY];
  int count, singular;
} system_t;

/* Value, slopes and rounding of a conic, by its terms and by the point. */
typedef struct {
  real value, x, y, rounding;
} local_t;

static local_t local(const conic_t *f, real x, real y) {
  const real *c = f->c;
  const real of[6] = {c[0],         c[1] * x,     c[2] * y,
                      c[3] * x * x, c[4] * x * y, c[5] * y * y};
  local_t at = {0, c[1] + 2 * c[3] * x + c[4] * y,
                c[2] + c[4] * x + 2 * c[5] * y, 0};
  at.rounding = fabsl(at.x) + fabsl(at.y);
  for (int i = 0; i < 6; i++) {
    at.value += of[i];
    at.rounding += fabsl(of[i]);
  }
  at.rounding *= 64 * EPSILON;
  return at;
}

/* Adds the zero that Newton's method finds from a point. */
static void add(system_t *s, real x, real y) {
  real det = 0, step = 1;
  local_t h, g;
  for (int i = 0; i < 60 && step > 1e-17L; i++) {
    h = local(&s->h, x, y);
    g = local(&s->g, x, y);
    det = h.x * g.y - h.y * g.x;
    const real dx = (h.y * g.value - g.y * h.value) / det;
    const real dy = (g.x * h.value - h.x * g.value) / det;
    step = fabsl(dx) + fabsl(dy);
    if (!(step < 1e6L)) s->singular += det == 0;
    if (!(step < 1e6L)) return;
    x += dx;
    y += dy;
  }
  if (!(step <= 1e-15L && fabsl(x) < 1.6L && fabsl(y) < 1.6L)) return;
  const real by_h = h.rounding / fabsl(det), by_g = g.rounding / fabsl(det);
  const real dx = fabsl(g.y) * by_h + fabsl(h.y) * by_g;
  const real dy = fabsl(g.x) * by_h + fabsl(h.x) * by_g;
  const real *a = s->h.c, *b = s->g.c;
  const real turn_h =
      fabsl(a[3]) * dx + fabsl(a[4]) * (dx + dy) + fabsl(a[5]) * dy;
  const real turn_g =
      fabsl(b[3]) * dx + fabsl(b[4]) * (dx + dy) + fabsl(b[5]) * dy;
  const real turn =
      turn_h * (fabsl(g.x) + fabsl(g.y)) + turn_g * (fabsl(h.x) + fabsl(h.y));
  const zero_t zero = {x, y, dx + dy + 8 * EPSILON, !(turn < fabsl(det) / 8)};
  for (int i = 0; i < s->count; i++)
    if (fabsl(s->at[i].x - x) + fabsl(s->at[i].y - y) < 1e-13L + zero.off / 100)
      return;
  if (s->count < MANY) s->at[s->count++] = zero;
}

/* Both roots of c0 + c1 t + c2 t^2, far away where there are none. */
static void roots(real c0, real c1, real c2, real t[2]) {
  const real disc = c1 * c1 - 4 * c0 * c2;
  const real q = -(c1 + copysignl(sqrtl(disc > 0 ? disc : 0), c1)) / 2;
  t[0] = disc >= 0 ? c0 / q : 9;
  t[1] = disc >= 0 ? q / c2 : 9;
}

/* swap: rows of y. */
static void trace(system_t *s, int swap) {
  const real *c = s->h.c;
  real x[2][3] = {{0}}, y[2][3] = {{0}}, g[2][3] = {{0}};
  int known[2] = {0, 0};
  for (int i = 0; i <= ROWS; i++) {
    const real at = REACH * (2.0L * i / ROWS - 1) + 0.00123L;
    real t[2];
    if (swap)
      roots(c[0] + at * (c[2] + at * c[5]), c[1] + at * c[4], c[3], t);
    else
      roots(c[0] + at * (c[1] + at * c[3]), c[2] + at * c[4], c[5], t);
    for (int k = 0; k < 2; k++) {
      if (!(fabsl(t[k]) < 3)) known[k] = 0;
      if (!(fabsl(t[k]) < 3)) continue;
      for (int n = 2; n > 0; n--) {
        x[k][n] = x[k][n - 1];
        y[k][n] = y[k][n - 1];
        g[k][n] = g[k][n - 1];
      }
      x[k][0] = swap ? t[k] : at;
      y[k][0] = swap ? at : t[k];
      g[k][0] = local(&s->g, x[k][0], y[k][0]).value;
      known[k]++;
      const int low = known[k] > 2 && fabsl(g[k][1]) < fabsl(g[k][0]) &&
                      fabsl(g[k][1]) < fabsl(g[k][2]);
      const int passes = known[k] > 1 && (g[k][0] > 0) != (g[k][1] > 0);
      const int from = known[k] < 3 ? known[k] : low ? 3 : passes ? 2 : 0;
      for (int n = 0; n < from; n++) add(s, x[k][n], y[k][n]);
    }
  }
}

/* > 0 outside. */
static real beyond(tf_rest_law_t law, real x, real y) {
  const real X = fabsl(x), Y = fabsl(y);
  const real by_x = law == TF_REST_HULL ? X - 4.0L / 3 + Y / 3 : X - 1;
  return fmaxl(by_x, law == TF_REST_BOW_TIE ? Y - X : Y - 1);
}

static tf_form_t form_of(const double c[6]) {
  const tf_form_t f = {(tf_real_t)c[0], (tf_real_t)c[1], (tf_real_t)c[2],
                       (tf_real_t)c[3], (tf_real_t)c[4], (tf_real_t)c[5]};
  return f;
}

/* In units in which it is of size 1. */
static conic_t conic_of(const tf_form_t *f) {
  conic_t is = {{wide(f->c0), wide(f->cx), wide(f->cy), wide(f->cxx),
                 wide(f->cxy), wide(f->cyy)}};
  real size = 0;
  for (int i = 0; i < 6; i++) size += fabsl(is.c[i]);
  for (int i = 0; i < 6 && size > 0; i++) is.c[i] /= size;
  return is;
}

typedef enum {
  MASSES,
  GENERIC,
  TOUCHING,
  ANY_SIZE,
  WHOLE,
  UNITS,
  CLASSES
} class_t;

/* Through an inverse mass matrix: gradients of h and g, force and moment. */
static void by_masses(double h[6], double g[6]) {
  const double a = (double)log_uniform(0.1, 10),
               b = (double)log_uniform(0.1, 10);
  const double c = tap_uniform(-0.95, 0.95) * sqrt(a * b);
  const double turn = tap_uniform(-3.14, 3.14),
               kappa = (double)log_uniform(0.01, 1);
  const double of_h[2] = {cos(turn), sin(turn) + tap_uniform(-0.5, 0.5)};
  const double of_g[2] = {-sin(turn), cos(turn) + tap_uniform(-0.5, 0.5)};
  const double by_x[2] = {a * of_h[0] + c * of_h[1], c * of_h[0] + b * of_h[1]};
  h[1] = -(of_h[0] * by_x[0] + of_h[1] * by_x[1]);
  g[1] = -(of_g[0] * by_x[0] + of_g[1] * by_x[1]);
  h[2] = kappa * (of_h[0] * c + of_h[1] * b);
  g[2] = kappa * (of_g[0] * c + of_g[1] * b);
  for (int i = 0; i < 2; i++) {
    double *f = i ? g : h;
    const double size = fabs(f[1]) + fabs(f[2]);
    f[0] *= 1.3 * size;
    for (int n = 3; n < 6; n++) f[n] *= 1e-3 * size;
  }
}

/* Slopes and values that let h and g almost touch at a point. */
static void let_touch(double h[6], double g[6]) {
  const double x = tap_uniform(-1.2, 1.2), y = tap_uniform(-1, 1);
  const double k = (double)of_any_sign(log_uniform(0.1, 10));
  g[1] = k * (h[1] + 2 * h[3] * x + h[4] * y) - 2 * g[3] * x - g[4] * y;
  g[2] = k * (h[2] + h[4] * x + 2 * h[5] * y) - g[4] * x - 2 * g[5] * y;
  h[0] = -(h[1] * x + h[2] * y + h[3] * x * x + h[4] * x * y + h[5] * y * y);
  g[0] = -(g[1] * x + g[2] * y + g[3] * x * x + g[4] * x * y + g[5] * y * y) +
         (double)of_any_sign(log_uniform(1e-18, 0.1));
}

static void draw(class_t class, tf_form_t *h, tf_form_t *g) {
  const double scale = IS_DOUBLE ? 1e150 : 1e18;
  double a[6], b[6];
  const double of_h = (double)log_uniform(1 / scale, scale);
  const double of_g = (double)log_uniform(1 / scale, scale);
  for (int i = 0; i < 6; i++) {
    a[i] = tap_uniform(-1, 1);
    b[i] = tap_uniform(-1, 1);
    if (class == ANY_SIZE) a[i] = (double)of_any_sign(log_uniform(1e-4, 1e4));
    if (class == ANY_SIZE) b[i] = (double)of_any_sign(log_uniform(1e-4, 1e4));
    if (class == WHOLE) a[i] = floor(2.5 * a[i] + 0.5) / 2;
    if (class == WHOLE) b[i] = floor(2.5 * b[i] + 0.5) / 2;
    if (class == UNITS) a[i] *= of_h;
    if (class == UNITS) b[i] *= of_g;
  }
  if (class == MASSES) by_masses(a, b);
  if (class == TOUCHING) let_touch(a, b);
  *h = form_of(a);
  *g = form_of(b);
}

/* Whether a point is a zero as far as rounding shows. */
static int leads(const system_t *s, real x, real y) {
  const local_t h = local(&s->h, x, y), g = local(&s->g, x, y);
  return fabsl(h.value) <= h.rounding && fabsl(g.value) <= g.rounding;
}

static real rounding_at(const system_t *s, real x, real y) {
  for (int i = 0; i < s->count; i++) {
    const zero_t *z = &s->at[i];
    if (!z->unsure && fabsl(z->x - x) + fabsl(z->y - y) <= z->off)
      return z->off;
  }
  return IS_DOUBLE ? 1e-5L : 0.05L;
}

typedef struct {
  unsigned missed, false_, wrong, miscounted, pinned, several, one;
} verdict_t;

static void judge(class_t class, int n, verdict_t *sum) {
  system_t s = {.count = 0};
  tf_form_t h, g;
  tf_contact_t contact;
  tf_contact_modes_t is;
  tf_force_t f = {0, 0};
  multipliers_t at[TF_MOST_ZEROS];
  draw(class, &h, &g);
  s.h = conic_of(&h);
  s.g = conic_of(&g);
  const tf_rest_law_t law = (tf_rest_law_t)(n % TF_REST_LAWS);
  const tf_slip_t now = {uniform(-1, 1), uniform(-1, 1)};
  CHECK(tf_contact_prepare(&contact, TF_TYRE_JUMP, log_uniform(0.1, 10),
                           log_uniform(0.05, 1), law, TF_RULE_PERSIST,
                           0) == TF_OK);
  CHECK(tf_contact_modes(&contact, &h, &g, now, TF_NO_MODE, &is, NULL) ==
        TF_OK);
  const unsigned bit = TF_MODE_BIT(TF_PINNED), has = is.set & bit;
  is.set |= (uint8_t)bit; /* without a pinned point there is no force */
  CHECK((tf_contact_force(&contact, &h, &g, &is, TF_PINNED, now, &f) ==
         TF_OK) == (has > 0));
  const real x = wide(f.F) / wide(contact.tyre.mu),
             y = wide(f.M) / wide(contact.kappa_mu);
  trace(&s, 0);
  trace(&s, 1);
  const int found = (int)tf_common_zeros(&h, &g, at);
  int unsure = 0, of_all = 0, of_found = 0;
  unsigned inside = 0;
  for (int i = 0; i < found; i++) {
    const real X = wide(at[i].x), Y = wide(at[i].y);
    add(&s, X, Y);
    CHECK(leads(&s, X, Y));
    unsure += rounding_at(&s, X, Y) == (IS_DOUBLE ? 1e-5L : 0.05L);
    of_found += fmaxl(fabsl(X), fabsl(Y)) < 1.4L;
  }
  real least = 9;
  for (int i = 0; i < s.count; i++) {
    const zero_t *z = &s.at[i];
    const real far = fmaxl(fabsl(z->x), fabsl(z->y));
    unsure += z->unsure || fabsl(far - 1.4L) < z->off;
    of_all += far < 1.4L;
    if (z->unsure || !(beyond(law, z->x, z->y) < -z->off)) continue;
    inside++;
    least = fminl(least, fabsl(z->x) + z->off);
  }
  const int is_curve = s.singular > 4;
  sum->pinned += inside > 0;
  sum->several += inside > 1;
  sum->one += found == 1;
  sum->missed += inside > 0 && !has && !is_curve;
  sum->false_ += has && !(leads(&s, x, y) && beyond(law, x, y) <= 8 * EPSILON);
  sum->wrong += has && !is_curve && fabsl(x) - rounding_at(&s, x, y) > least;
  sum->miscounted += !unsure && !is_curve && of_all != of_found;
}

TEST(pinned_points_are_all_found) {
  const char *draws = getenv("DRAWS");
  for (int class = 0; class < CLASSES; class ++) {
    verdict_t sum = {0};
    const int count = draws ? atoi(draws) : samples(16000);
    for (int n = 0; n < count; n++) judge((class_t) class, n, &sum);
    /* curves that almost coincide near a point can exhaust the search */
    const unsigned lost = class == TOUCHING ? 1 + (unsigned)count / 1000 : 0;
    CHECK(sum.false_ == 0 && sum.missed <= lost);
    CHECK(sum.wrong <= lost && sum.miscounted <= lost);
    CHECK_ABOVE(50 * sum.pinned, (unsigned)count);
    CHECK(class == MASSES || class == UNITS || sum.several > 0);
    printf(
        "# class %d: %d drawn, %u pinned, %u in several points; %u missed, "
        "%u false, %u wrong, %u miscounted\n",
        class, count, sum.pinned, sum.several, sum.missed, sum.false_,
        sum.wrong, sum.miscounted);
  }
}

/* A step ends at h = g = 0 where p is 0 and either z or r is: at rest, which is
 * its pinned point, or on the axis, where friction cannot hold g at 0. One of
 * the two solves the inclusion where nothing else does. */
TEST(step_without_a_mode_could_end_on_the_axis) {
  unsigned pinned = 0, axis = 0, none = 0;
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
      CHECK(stops || fabs((double)end.r) < close * (double)(x.r + p.dt));
      is_found |= stops;
      is_solved |= rests_under(in.rest, at[i].x, at[i].y);
      axis += !stops;
    }
    tf_contact_modes_t s = {0};
    enumerate(&in, BOTH_SIGNS, &s);
    const real det =
        wide(in.h.cx) * wide(in.g.cy) - wide(in.h.cy) * wide(in.g.cx);
    const real noise = 1e4L * EPSILON * fabsl(wide(in.h.cx) * wide(in.g.cx));
    CHECK(!rests || is_found || fabsl(det) < noise);
    CHECK(s.set != 0 || is_solved);
    pinned += rests;
    none += s.set == 0;
  }
  CHECK(pinned > 0 && axis > 0 && none > 0);
  printf("# %u pinned, %u on the axis, %u without a mode\n", pinned, axis,
         none);
}
