/* The solution set of one step against brute force. The judge builds the same
 * discrete step in long double, from the mass matrix in (v, w) and a plain
 * 2 x 2 inverse, and searches the law's graph {(lambda, s kappa lambda)} on a
 * grid for points that lie on it at the end of the step. It shares neither
 * formulas nor variables with the enumeration. */
#include "extremes.h"
#include "friction/inclusion.h"
#include "moreau/balance.h"
#include "moreau/stages.h"
#include "scheme.h"

typedef struct {
  tf_params_t p;
  tf_state_t x;
  tf_input_t u;
  scheme_step_t c;
  real noise, load; /* rounding of h and g [m/s]; largest forces [N, N m] */
} step_t;

/* How large the terms are whose rounding a step has in h and g. One below the
 * smallest normal number is rounded as much as that, whatever it is. */
static void discretise(step_t *k) {
  const real at[3] = {wide(k->x.r), wide(k->x.v), wide(k->x.w)};
  k->c = scheme_step(&k->p, &k->u, at);
  const paper_t *p = &k->c.p;
  const real r = at[0], v = at[1], w = at[2], rt = k->c.r_t, m = p->m;
  const real least = TF_REAL_MIN;
  const real mu = p->mu, arm = fabsl(rt) + p->kappa;
  const real b = p->k2 * (fabsl((real)k->u.r0) + fabsl(rt)) + fabsl(p->c2 * v) +
                 fabsl(m * rt * w * w) + fabsl((real)k->u.force) + mu + least;
  const real c = fabsl((real)k->u.torque) + fabsl(p->c1 * w) +
                 fabsl(2 * m * rt * v * w) + mu * arm + fabsl(p->d) * b + least;
  const real J = paper_clock_rate(p, rt), dt = k->c.dt;
  const real turntable = fabsl((real)k->u.omega0) + dt * fabsl(k->c.alpha);
  const real z = fabsl(w) + turntable + dt * c / J + least;
  k->load = b + c;
  k->noise = 64 * EPSILON *
             (fabsl(v) + least + dt * b / m +
              (fabsl(p->d) + fabsl(r) + dt * fabsl(v)) * z);
}

/* A quantity that decides and is as small as rounding, or almost so beside
 * those that it is compared with, is a tie and no verdict. */
static int tied;
static int positive(real x, real scale, real noise) {
  const real tie = IS_DOUBLE ? 1e-9L : 3e-3L;
  tied |= !(fabsl(x) > tie * scale + noise);
  return x > 0;
}

typedef scheme_slip_t slip_t;

/* At the end of the step, under a force in units of mu and kappa mu. */
static slip_t slip_at(const step_t *k, real x, real y) {
  real end[3];
  scheme_end(&k->c, x * k->p.mu, y * k->p.kappa * k->p.mu, end);
  return scheme_slip(&k->c, 1, end);
}

/* Between two points of a grid h and g are parabolas: three values of one give
 * its zeros, as shares of the way. */
static int zeros(real a, real middle, real b, real t[2]) {
  const real c2 = 2 * (a - 2 * middle + b), c1 = -3 * a + 4 * middle - b;
  const real root = c1 * c1 - 4 * a * c2;
  if (!(root >= 0)) return 0;
  const real twice = c1 < 0 ? c1 - sqrtl(root) : c1 + sqrtl(root);
  const real both[2] = {-twice / (2 * c2), -2 * a / twice};
  int n = 0;
  for (int i = 0; i < 2; i++)
    if (both[i] >= 0 && both[i] < 1) t[n++] = both[i];
  return n;
}

#define CELLS 16

/* Whether a segment from one force to another has a point where one slip speed
 * vanishes and the other has a sign: h = 0 and s g > 0 for a stick, g = 0 and
 * side h > 0 for a slip. The segment is x, y = from + i step. */
static int found_between(const step_t *k, slip_t from, slip_t to, int of_h,
                         int sign) {
  slip_t at[2 * CELLS + 1];
  real size[2] = {0, 0};
  int found = 0;
  for (int i = 0; i <= 2 * CELLS; i++) {
    const real t = (real)i / (2 * CELLS);
    at[i] =
        slip_at(k, from.h + t * (to.h - from.h), from.g + t * (to.g - from.g));
    size[0] = fmaxl(size[0], fabsl(at[i].h));
    size[1] = fmaxl(size[1], fabsl(at[i].g));
  }
  const slip_t ends[2] = {at[0], at[sizeof at / sizeof at[0] - 1]};
  for (int i = 0; i < 2; i++)
    positive(of_h ? ends[i].h : ends[i].g, size[!of_h], k->noise);
  for (int i = 0; i < 2 * CELLS; i += 2) {
    const slip_t *p = at + i;
    real t[2];
    const int n = of_h ? zeros(p[0].h, p[1].h, p[2].h, t)
                       : zeros(p[0].g, p[1].g, p[2].g, t);
    for (int j = 0; j < n; j++) {
      const real share = (i + 2 * t[j]) / (2 * CELLS);
      const slip_t zero = slip_at(k, from.h + share * (to.h - from.h),
                                  from.g + share * (to.g - from.g));
      found |= positive(sign * (of_h ? zero.g : zero.h), size[of_h], k->noise);
    }
  }
  return found;
}

/* Slip at x = side: y over [-1, 1], with s in Sgn(g+) and y = s x. */
static int slip_by_grid(const step_t *k, int side) {
  int found = found_between(k, (slip_t){side, -1}, (slip_t){side, 1}, 0, side);
  for (int s = -1; s <= 1; s += 2) {
    const slip_t end = slip_at(k, side, s * side);
    if (s * end.g > 0) found |= positive(side * end.h, fabsl(end.h), k->noise);
  }
  return found;
}

/* Stick with s: x over [-1, 1], y = s x, for a zero of h+ with s g+ > 0. */
static int stick_by_grid(const step_t *k, int s) {
  return found_between(k, (slip_t){-1, -s}, (slip_t){1, s}, 1, s);
}

/* Pinned: the force and moment of the law that end the step at v = 0 and
 * w = omega0, from the rows of (6). */
static int pinned_by_balance(const step_t *k) {
  const tf_params_t *p = &k->p;
  const real dv = -k->x.v, dw = (real)k->u.omega0 - k->x.w;
  const scheme_step_t *c = &k->c;
  const real rows[2] = {(c->s[0][0] * dv + c->s[0][1] * dw) / p->dt,
                        (c->s[1][0] * dv + c->s[1][1] * dw) / p->dt};
  const real F = (rows[0] - c->Q_r) / c->sin;
  const real M = rows[1] - c->Q_phi - F * scheme_arm(c);
  const real mu = p->mu, kappa = p->kappa;
  const real size = (fabsl(rows[0]) + fabsl(rows[1]) + k->load) / fabsl(c->sin);
  /* With a stiff spring the step has that force from terms that cancel: the
   * implicit mass times what the load alone would do to d w. */
  const real inertia = p->m * ((real)p->beta * p->beta + c->r_t * c->r_t);
  const real implicit = (c->s[0][0] - p->m) * fabsl((real)p->d);
  const real cancelled = implicit * k->load / inertia / fabsl(c->sin);
  const real noise =
      64 * (real)TF_REAL_EPSILON * (size * (1 + fabsl(c->r_t)) + cancelled);
  const real most = 4 * mu / 3 - fabsl(M) / (3 * kappa);
  const int inside = positive(most - fabsl(F), mu, noise * (1 + 1 / kappa));
  return positive(kappa * mu - fabsl(M), mu * kappa, noise * (1 + kappa)) &&
         inside;
}

static unsigned set_by_search(const step_t *k) {
  unsigned set = 0;
  if (slip_by_grid(k, 1)) set |= TF_MODE_BIT(TF_SLIP_PLUS);
  if (slip_by_grid(k, -1)) set |= TF_MODE_BIT(TF_SLIP_MINUS);
  if (stick_by_grid(k, 1)) set |= TF_MODE_BIT(TF_STICK_PLUS);
  if (stick_by_grid(k, -1)) set |= TF_MODE_BIT(TF_STICK_MINUS);
  if (pinned_by_balance(k)) set |= TF_MODE_BIT(TF_PINNED);
  return set;
}

/* An ordinary machine; with `extreme` of any size, three of its parameters from
 * anywhere in their ranges. */
static tf_params_t draw_params(int extreme) {
  tf_params_t p = tf_scenes[0]->params;
  p.dt = log_uniform(1e-4, 5e-3);
  p.theta = uniform(0.5, 1);
  p.beta = uniform(0.05, 0.5);
  p.gamma = uniform(-3.1, 3.1);
  p.mu = log_uniform(0.1, 10);
  p.kappa = log_uniform(0.03, 1);
  if (!extreme) return p;
  p.m = log_uniform(0.03, 30);
  p.d = of_any_sign(log_uniform(0.1, 3));
  p.beta = log_uniform(0.005, 5);
  p.k2 = log_uniform(0.1, 300);
  p.mu = log_uniform(0.01, 100);
  for (int n = 0; n < 3; n++) draw_member(&p, (int)(tap_bits() % 10));
  return p;
}

/* A random machine and a state whose h and g are of the size that one step
 * can change, so that every combination of modes occurs; some exactly at
 * h = g = 0, some at a zero of the Delassus scalar. */
static int draw(step_t *k, tf_machine_t *machine, int i) {
  const int extreme = i % 2;
  k->p = draw_params(extreme);
  const double r = (double)of_any_sign(log_uniform(extreme ? 1e-4 : 0.03, 1));
  const double b = k->p.beta, s = sin((double)k->p.gamma),
               c = cos((double)k->p.gamma);
  const double zero = fabs((r * r + b * b * s * s) / (r * c)); /* A = 0 */
  if (i % 10 == 0 && zero > 1e-2 && zero < 3) k->p.kappa = (tf_real_t)zero;
  if (fabs(s) < 0.1 || tf_prepare(machine, &k->p, NULL)) return 0;
  memset(&k->x, 0, sizeof k->x);
  const double step = (double)(k->p.dt * k->p.mu) / (double)k->p.m;
  const double z =
      i % 7 == 0 ? 0 : (double)of_any_sign(log_uniform(0.01, 100)) * step;
  const double h =
      i % 7 == 0 ? 0 : (double)of_any_sign(log_uniform(0.01, 10)) * step;
  k->x.r = (tf_real_t)r;
  k->x.w = (tf_real_t)((double)k->p.omega0 + z);
  k->u = tf_input_default(machine);
  k->u.force = (tf_real_t)(tap_uniform(-2, 2) * (double)k->p.mu);
  k->u.torque = (tf_real_t)(tap_uniform(-1, 1) * (double)k->p.mu);
  tf_speed_for_slip(machine, k->x.r, k->x.w, k->u.omega0, (tf_real_t)h,
                    &k->x.v);
  if (i % 3 == 0) k->u.alpha = uniform(-2, 2);
  k->u.omega0 += k->u.alpha * k->p.dt;
  k->x.mode = (uint8_t)(tap_bits() % TF_MODES);
  discretise(k);
  return 1;
}

/* What was compared: steps, ties, kinds of set, how many modes. */
typedef struct {
  int compared, ties, near;
  int seen[32], count[6];
} tally_t;

static void compare_step(const step_t *k, const tf_machine_t *machine, int i,
                         tally_t *tally) {
  tf_report_t report;
  tf_state_t x = k->x;
  if (tf_step(machine, &x, &k->u, &report) < 0) return;
  tied = 0;
  const unsigned want = set_by_search(k);
  if (tied) {
    tally->ties++;
    return;
  }
  tally->compared++;
  tally->seen[want]++;
  /* Beside h = g = 0 the report has what follows that point instead, and where
   * a slip is lost what follows at that instant. */
  free_motion_t c =
      free_motion(machine, &k->x, &k->u, start_of(machine, &k->x, &k->u));
  inclusion_t in;
  tf_contact_modes_t solutions, is;
  bool reaches = false;
  const unsigned signs = solve_inclusion(&c, &in, &solutions);
  const unsigned got = solutions.set;
  const bool near =
      k->x.mode == TF_PINNED || is_near_codim2(&c, &in, signs, got);
  if (near)
    tally->near++;
  else if (report.status != TF_DEGRADED && !loses_slip(k->x.mode, report.mode))
    CHECK(report.set == got);
  unsigned size = 0;
  for (int mode = 0; mode < TF_MODES; mode++) size += got >> mode & 1u;
  tally->count[size]++;
  /* The same by the forms alone, pinned to third order in what bends them. */
  CHECK(tf_contact_modes(&machine->contact, &in.h, &in.g, start_slip(&c),
                         k->x.mode, &is, &reaches) == TF_OK);
  CHECK(((is.set ^ want) & (i % 2 ? 15u : 31u)) == 0);
  CHECK(reaches == (near && machine->contact.stick_kappa > 0));
  if (!CHECK(got == want))
    printf("# draw %d: set %02x, search finds %02x\n", i, got, want);
}

TEST(enumeration_against_grid_search) {
  tally_t tallies[2]; /* ordinary machines, wide ones */
  memset(tallies, 0, sizeof tallies);
  for (int i = 0; i < samples(200000); i++) {
    step_t k;
    tf_machine_t machine;
    if (draw(&k, &machine, i)) compare_step(&k, &machine, i, &tallies[i % 2]);
  }
  for (int extreme = 0; extreme < 2; extreme++) {
    const tally_t *t = &tallies[extreme];
    int kinds = 0;
    for (int i = 0; i < 32; i++) kinds += t->seen[i] > 0;
    CHECK(t->near > 0 && t->near < t->compared);
    CHECK_ABOVE(t->compared, samples(extreme ? 20000 : 60000));
    CHECK(extreme || t->ties < t->compared / 5);
    CHECK_ABOVE(kinds, 9);
    CHECK_ABOVE(t->count[1], samples(1000));
    CHECK_ABOVE(t->count[3], samples(extreme ? 500 : 1000));
  }
}

/* Away from g = 0 theory counts: A > 0 one, A < 0 three within |A| dt mu. */
TEST(one_or_three_solutions) {
  for (int i = 0; i < samples(100000); i++) {
    const int s = (int)(tap_bits() & 1), kind = i % 3; /* A > 0, < 0, = 0 */
    const double A = kind == 2 ? 0 : tap_uniform(1e-3, 2);
    const double h1 = kind == 1 ? A : -A, share = tap_uniform(-1, 1);
    const inclusion_t in = {.h = {.c0 = i % 30 == 2 ? 0 : uniform(-1, 1),
                                  .cx = (tf_real_t)(h1 * (1 - share)),
                                  .cy = (tf_real_t)((s ? -1 : 1) * h1 * share)},
                            .g = {.c0 = s ? -100 : 100},
                            .g_now = s ? -100 : 100,
                            .has_moment = true};
    const double c1 =
        (double)(s ? in.h.cx - in.h.cy : in.h.cx + in.h.cy); /* as rounded */
    tf_contact_modes_t out = {0};
    CHECK(signs_of(&in.g) == (s ? 2u : 1u));
    enumerate(&in, signs_of(&in.g), &out);
    int n = 0;
    for (int mode = 0; mode < TF_MODES; mode++) n += out.set >> mode & 1;
    const int inside = fabs((double)in.h.c0) < fabs(c1);
    CHECK(n == (kind == 1 && inside ? 3 : 1));
    const unsigned stick = TF_MODE_BIT(TF_STICK_PLUS + s);
    CHECK(!(out.set & stick) == !(inside || (c1 == 0 && in.h.c0 == 0)));
    CHECK(!(out.attracting & stick) == !(c1 < 0));
    CHECK(!(out.attracting & ~stick));
    CHECK(out.near_stick == (unsigned)TF_STICK_PLUS + (unsigned)s);
    for (int slip = 0; slip < 2; slip++) {
      const double to = slip == 0 ? c1 : -c1;
      CHECK(out.tau[slip] == (s ? -1 : 1));
      CHECK_NEAR((double)out.departure[slip], (double)in.h.c0 + to,
                 4 * (double)TF_REAL_EPSILON);
    }
    if (out.set & stick)
      CHECK_NEAR((double)in.h.c0 + c1 * (double)out.x[s], 0,
                 4 * (double)TF_REAL_EPSILON);
  }
}

TEST(residual_vanishes_at_solutions_only) {
  const tf_real_t mu = 2, kappa = (tf_real_t)0.25;
  const tf_real_t eps = 8 * TF_REAL_EPSILON;
#define RESIDUAL(F, M, h, g)                                            \
  law_residual(mu, kappa, (tf_force_t){(tf_real_t)(F), (tf_real_t)(M)}, \
               (tf_real_t)(h), (tf_real_t)(g))
  CHECK(RESIDUAL(2, 0.5, 0.7, 1) == 0);    /* slip+, g > 0 */
  CHECK(RESIDUAL(-2, 0.5, -0.7, -1) == 0); /* slip-, g < 0 */
  CHECK(RESIDUAL(1, 0.25, 0, 1) == 0);     /* stick+ */
  CHECK(RESIDUAL(1, -0.25, 0, -1) == 0);   /* stick- */
  CHECK(RESIDUAL(1.5, 0.1, 0, 0) == 0);    /* pinned */
  CHECK(RESIDUAL(0, 0, 0, 0) == 0);
  CHECK_NEAR(RESIDUAL(1, 0.25, 0.1, 1), 0.1, eps);  /* drifts in stick */
  CHECK_NEAR(RESIDUAL(2, 0.5, -0.1, 1), 0.1, eps);  /* wrong side */
  CHECK_NEAR(RESIDUAL(2.5, 0.625, 0, 1), 0.5, eps); /* above mu */
  CHECK_NEAR(RESIDUAL(1, 0.25, 0, -1), 0.5, eps);   /* wrong sign of g */
  CHECK_NEAR(RESIDUAL(1, 0.5, 0, 0), 0.25, eps);    /* too much moment */
  CHECK(!(RESIDUAL(NAN, 0, 0, 1) <= 1));
#undef RESIDUAL
}
