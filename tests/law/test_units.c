/* Every kind of step, in other units of mass and time and seen from the other
 * side. All maps are sign changes and powers of two, which no rounding
 * disturbs, so what comes out agrees bit for bit, on random machines of any
 * mass and law: a quantity that is not of the unit that it has to be, or a
 * constant with a unit, shows here. */
#include "extremes.h"
#include "sample.h"

enum { MIRROR, REVERSAL, HALF_TURN, MASS, TIME, SHIFT, MAPS };
#define HEAVY 16384     /* a power of two */
#define LATER 987654321 /* steps */

/* What a map does to a machine, its inputs and a state:
 *   mirror     d, gamma, omega, torque -> -           h -> -h
 *   reversal   r, v, r0, d, force -> -                h, g -> -h, -g
 *   half turn  gamma + pi                             h, g -> -h, -g
 *   mass       16 t are the old kilogram
 *   time       half a second is the new unit
 *   shift      so many steps later */
static void map_params(int map, tf_params_t *p) {
  if (map < MASS && p->rule % 3 > 0) /* one of the two slips */
    p->rule = (tf_rule_t)(3 - p->rule);
  if (map == MIRROR) p->d = -p->d, p->gamma = -p->gamma, p->omega0 = -p->omega0;
  if (map == REVERSAL) p->d = -p->d, p->r0 = -p->r0;
  if (map == MASS)
    p->m *= HEAVY, p->k2 *= HEAVY, p->c1 *= HEAVY, p->c2 *= HEAVY,
        p->mu *= HEAVY;
  if (map == TIME) {
    p->dt /= 2, p->k2 *= 4, p->mu *= 4, p->c1 *= 2, p->c2 *= 2;
    p->omega0 *= 2, p->epsilon *= 2, p->rate *= 2;
  }
}

static void rotate_wheel(tf_machine_t *k) {
  k->sin_gamma = -k->sin_gamma;
  k->minus_sin_gamma = -k->minus_sin_gamma;
  k->cos_gamma = -k->cos_gamma;
  k->d_sin_gamma = -k->d_sin_gamma;
  k->mu_sin_gamma = -k->mu_sin_gamma;
  k->mu_d_sin_gamma = -k->mu_d_sin_gamma;
}

static tf_machine_t mapped_machine(int map, tf_params_t p) {
  map_params(map, &p);
  tf_machine_t k = prepared(&p);
  if (map == HALF_TURN) rotate_wheel(&k);
  return k;
}

static tf_input_t mapped_input(int map, tf_input_t u) {
  const tf_real_t mirror = map == MIRROR ? TF_R(-1.0) : TF_R(1.0);
  const tf_real_t back = map == REVERSAL ? TF_R(-1.0) : TF_R(1.0);
  const tf_real_t size = map == MASS   ? HEAVY
                         : map == TIME ? TF_R(4.0)
                                       : TF_R(1.0);
  const tf_real_t fast = map == TIME ? TF_R(2.0) : TF_R(1.0);
  return (tf_input_t){.omega0 = mirror * fast * u.omega0,
                      .r0 = back * u.r0,
                      .force = back * size * u.force,
                      .torque = mirror * size * u.torque,
                      .alpha = mirror * fast * fast * u.alpha};
}

static unsigned mapped_mode(int map, unsigned mode) {
  static const uint8_t to[MAPS][TF_MODES + 1] = {
      {1, 0, 2, 3, 4, 5}, {1, 0, 3, 2, 4, 5}, {1, 0, 3, 2, 4, 5},
      {0, 1, 2, 3, 4, 5}, {0, 1, 2, 3, 4, 5}, {0, 1, 2, 3, 4, 5}};
  return to[map][mode];
}

static unsigned mapped_set(int map, unsigned set) {
  unsigned out = 0;
  for (unsigned mode = 0; mode < TF_MODES; mode++)
    if (set >> mode & 1u) out |= (unsigned)TF_MODE_BIT(mapped_mode(map, mode));
  return out;
}

static tf_state_t mapped_state(int map, tf_state_t x) {
  if (map == MIRROR) x.w = -x.w, x.phi = -x.phi;
  if (map == REVERSAL) x.r = -x.r, x.v = -x.v;
  if (map == TIME) x.v *= 2, x.w *= 2;
  if (map == SHIFT) x.tick += LATER;
  x.mode = (uint8_t)mapped_mode(map, x.mode);
  return x;
}

/* Bits, but for the sign of 0 and of what is not a number. */
static int same(tf_real_t a, tf_real_t b) {
  return a == b || (isnan((double)a) && isnan((double)b));
}

static int same_state(const tf_state_t *a, const tf_state_t *b) {
  return same(a->r, b->r) && same(a->v, b->v) && same(a->w, b->w) &&
         same(a->phi, b->phi) && a->mode == b->mode && a->tick == b->tick;
}

static int same_report(int map, const tf_report_t *a, const tf_report_t *b) {
  const int seen_back = map == REVERSAL || map == HALF_TURN;
  const tf_real_t force = map == MASS ? HEAVY : map == TIME ? 4 : 1;
  const tf_real_t fast = map == TIME ? 2 : 1;
  const tf_real_t h = map == MIRROR || seen_back ? -fast : fast;
  const tf_real_t g = seen_back ? -fast : fast;
  const tf_real_t F = map == MIRROR || seen_back ? -force : force;
  const tf_real_t M = map == MIRROR ? -force : force;
  return mapped_mode(map, a->mode) == b->mode &&
         mapped_set(map, a->set) == b->set && a->choices == b->choices &&
         a->status == b->status && same(h * a->slip.h, b->slip.h) &&
         same(g * a->slip.g, b->slip.g) && same(F * a->force.F, b->force.F) &&
         same(M * a->force.M, b->force.M) &&
         ((map < MASS && a->slip.g == 0) || /* it is that of g > 0 there */
          same(a->delassus, map == MASS ? HEAVY * b->delassus : b->delassus));
}

typedef tf_status_t step_t(const tf_machine_t *, tf_state_t *,
                           const tf_input_t *, tf_report_t *);

typedef struct {
  step_t *step;
  const char *name;
  double longest;                         /* dt */
  bool of_any_law, of_any_size, anywhere; /* also at rest, on the axis */
} kind_t;

/* A machine, its inputs and a state from everywhere, in any mode: ordinary ones
 * and such with mu, kappa and inertias from many decades. What a map changes is
 * 0 now and then. */
static tf_params_t any_params(const kind_t *kind) {
  const bool extreme = kind->of_any_size && one_in(2);
  tf_params_t p = tf_scenes[0]->params;
  p.m = extreme ? log_uniform(3e-3, 300) : log_uniform(0.3, 3);
  p.d = one_in(20) ? 0 : uniform(-1.2, 1.2);
  p.beta = extreme ? log_uniform(5e-4, 5) : log_uniform(0.05, 0.5);
  p.k2 = one_in(20) ? 0 : log_uniform(0.5, extreme ? 5e3 : 50);
  p.c1 = one_in(5) ? 0 : log_uniform(1e-3, 0.3);
  p.c2 = one_in(5) ? 0 : log_uniform(1e-3, 0.3);
  p.r0 = one_in(10) ? 0 : uniform(-1, 1);
  p.omega0 = one_in(10) ? 0 : uniform(-3, 3);
  p.mu = extreme ? log_uniform(1e-3, 1e4) : log_uniform(0.1, 10);
  p.kappa = extreme ? log_uniform(1e-4, 100) : log_uniform(0.02, 1);
  p.gamma = one_in(10) ? draw_gamma() : uniform(-3.14, 3.14);
  p.dt = log_uniform(1e-5, kind->longest);
  p.theta = one_in(2) ? TF_R(0.5) : uniform(0.5, 1);
  p.rest = (tf_rest_law_t)(tap_bits() % TF_REST_LAWS);
  p.rule =
      (tf_rule_t)(tap_bits() % (kind->anywhere ? TF_RULES : TF_RULE_RANDOM));
  p.rate = TF_R(0.3) / p.dt;
  p.with_angle = true;
  if (one_in(20)) p.law = TF_TYRE_COULOMB;
  if (!kind->of_any_law) return p;
  p.law = (tf_tyre_law_t)(tap_bits() % TF_TYRE_LAWS);
  draw_law_constants(&p);
  return p;
}

/* Loads about the size of friction, within their range in any unit. */
static void draw_inputs(const tf_machine_t *k, tf_input_t *u) {
  const double mu = (double)k->contact.tyre.mu;
  const double size = one_in(3) ? 0 : mu * (double)log_uniform(0.01, 30);
  const double arm = one_in(3) ? 0 : (double)k->contact.tyre.kappa;
  u->force = (tf_real_t)(fmin(size, 3e4) * tap_uniform(-1, 1));
  u->torque = (tf_real_t)(fmin(size * arm, 3e4) * tap_uniform(-1, 1));
  u->alpha = one_in(2) ? 0 : of_any_sign(log_uniform(0.1, 100));
}

static tf_state_t any_state(const tf_machine_t *k, const tf_input_t *u,
                            bool anywhere) {
  const tf_real_t near = anywhere && one_in(2) ? log_uniform(1e-6, 1) : 1;
  tf_state_t x = {.r = anywhere && one_in(20) ? 0 : near * uniform(-0.5, 0.5),
                  .w = u->omega0,
                  .mode = TF_PINNED,
                  .seed = (uint32_t)tap_bits()};
  if (anywhere && one_in(2)) return x;
  x.mode = TF_NO_MODE;
  x.w += near * uniform(-2, 2);
  x.v = near * uniform(-1, 1);
  if (one_in(2)) (void)tf_speed_for_slip(k, x.r, x.w, u->omega0, 0, &x.v);
  tf_report_t report;
  CHECK(tf_begin(k, &x, u, &report) == TF_OK);
  return x;
}

/* Two slips beside the axis of a wheel along the slot have one g. The faster
 * one is faster by a share of h^2 / (2 g^2): eight roundings, 4 epsilon, hide
 * that, in float also some of a strong friction. Both machines take slip+. */
static int leaves_along_slot(const tf_report_t *end) {
  return tf_mode_is_slip(end->mode) &&
         fabs((double)end->slip.h) <=
             sqrt(8 * (double)TF_REAL_EPSILON) * fabs((double)end->slip.g);
}

static double size_of_force(const tf_params_t *p, const tf_report_t *end) {
  return hypot((double)end->force.F, (double)(end->force.M / p->kappa)) /
         (double)p->mu;
}

/* Whether rounding or convention decides: the forces at h = g = 0 are their own
 * mirror image, or none, so that of two futures each is the image of the other;
 * or there is no moment, and g = 0 gives the stick its name; or no stick, and
 * h = 0 gives the slip its side. */
static int is_symmetric(const tf_params_t *p, const tf_input_t *u,
                        const tf_state_t *x, const tf_report_t end[2]) {
  const int no_force = (u->r0 == 0 || p->k2 == 0) && u->force == 0;
  const int no_torque = u->torque == 0 && u->alpha == 0;
  const double tiny = (double)TF_REAL_EPSILON;
  const int ties = !tf_mode_is_slip(x->mode) && end[0].mode == end[1].mode &&
                   (!IS_DOUBLE || leaves_along_slot(&end[0]));
  return (hypot((double)x->r, (double)x->v) <= tiny && no_force) ||
         size_of_force(p, &end[0]) + size_of_force(p, &end[1]) <= tiny ||
         (fabs(sin((double)p->gamma)) < 1e-6 && (no_torque || ties)) ||
         (p->law == TF_TYRE_COULOMB && end->slip.g == 0) ||
         (!tf_tyre_is_set_valued(p->law) && end->slip.h == 0);
}

/* Units do count where squares are next to the smallest number. */
static int underflows(tf_real_t x) {
  return x != 0 && fabs((double)x) < 1e5 * sqrt((double)TF_REAL_MIN);
}

/* How far two ends of a step are apart, as a share of r and of the speeds. */
static double apart(const tf_state_t *a, const tf_state_t *b) {
  const double speed = fabs((double)a->v) + fabs((double)a->w);
  return fmax(
      fabs((double)(a->r - b->r)) / fabs((double)a->r),
      (fabs((double)(a->v - b->v)) + fabs((double)(a->w - b->w))) / speed);
}

/* Three things in a located step keep no bits in another unit of time: the end
 * of a rest is a root of a parabola over the sum of its coefficients, which are
 * of three units; the force at a two-fold follows from a trial by 1 m/s^2; and
 * terms of a series overflow in float. Rounded otherwise an end is off by 64
 * roundings, and by as much as where r, v or w at the start is off by two,
 * which is more behind a two-fold: there motions part. */
static int are_near(const tf_machine_t *k, const tf_input_t *u,
                    const tf_state_t *from, const tf_state_t *a,
                    const tf_state_t *b) {
  double most = 64 * (double)TF_REAL_EPSILON;
  for (int i = 0; i < 6; i++) {
    tf_state_t x = *from;
    tf_report_t report;
    *(i < 2   ? &x.r
      : i < 4 ? &x.v
              : &x.w) *= 1 + (i % 2 ? -2 : 2) * TF_REAL_EPSILON;
    if (tf_step_located(k, &x, u, &report) >= TF_OK) most += apart(a, &x);
  }
  return a->mode == b->mode && a->tick == b->tick && apart(a, b) <= most;
}

/* One constant has a unit: what moves by less than 1e-9 of its size in a second
 * rests, and does not stall. With half a second as the unit that is half. */
static int rests_in_a_unit(const tf_machine_t *k, const tf_input_t *u,
                           const tf_state_t *x) {
  const double reach = fabs((double)k->d) + fabs((double)x->r);
  const double v = fabs((double)x->v), w = fabs((double)x->w);
  const double terms = v + reach * (w + fabs((double)u->omega0));
  return v <= 16 * (double)TF_REAL_EPSILON * terms + 1e-9 * reach;
}

/* A machine and its image: 0 and 1. */
typedef struct {
  tf_machine_t k[2];
  tf_input_t u[2];
  tf_state_t x[2];
  tf_report_t report[2];
} images_t;

static images_t images_of(int map, const tf_params_t *p) {
  images_t m = {.k = {prepared(p), mapped_machine(map, *p)}};
  m.u[0] = tf_input_default(&m.k[0]);
  m.u[1] = mapped_input(map, m.u[0]);
  return m;
}

/* One step of both. Under rule `random` the image of a draw is the draw of
 * another seed, which is looked for. Returns: whether they agree. */
static int step_images(step_t *step, int map, images_t *m) {
  const tf_state_t start = m->x[1];
  const tf_status_t status = step(&m->k[0], &m->x[0], &m->u[0], &m->report[0]);
  const tf_state_t want = mapped_state(map, m->x[0]);
  const uint32_t seeds = m->k[0].contact.rule == TF_RULE_RANDOM ? 300 : 1;
  for (uint32_t n = 0; n < seeds; n++) {
    m->x[1] = start;
    if (n > 0) m->x[1].seed = n;
    const tf_status_t image = step(&m->k[1], &m->x[1], &m->u[1], &m->report[1]);
    m->x[1].seed = start.seed;
    if (status < TF_OK ? image == status
                       : same_state(&want, &m->x[1]) &&
                             same_report(map, &m->report[0], &m->report[1]))
      return 1;
  }
  return 0;
}

/* A motion whose loads jump now and then, and its image. Returns: the step at
 * which they part, or `most`. `ends`: grows where a rest ends in an OK step. */
static int agreeing_images(const kind_t *kind, int map, int most, long *ends) {
  const tf_params_t p = any_params(kind);
  images_t m = images_of(map, &p);
  m.x[0] = any_state(&m.k[0], &m.u[0], kind->anywhere);
  m.x[1] = mapped_state(map, m.x[0]);
  for (int n = 0; n < most; n++) {
    if (n == 0 || one_in(30)) draw_inputs(&m.k[0], &m.u[0]);
    m.u[0].omega0 += m.u[0].alpha * m.k[0].dt;
    if (fabs((double)m.x[0].r) + fabs((double)m.x[0].v) > 1e8) break;
    m.u[1] = mapped_input(map, m.u[0]);
    const tf_state_t from = m.x[0], start = m.x[1];
    const tf_slip_t now = tf_slip(&m.k[0], from.r, from.v, from.w,
                                  m.u[0].omega0 - m.u[0].alpha * m.k[0].dt);
    int agree = step_images(kind->step, map, &m);
    const tf_status_t status = m.report[0].status;
    if (status < TF_OK || underflows(m.report[0].slip.g)) break;
    /* Of several futures the located step takes one by convention. Next to a
     * singular point a series may fail in one unit of time and not in the
     * other, and terms overflow in float: its status says so. */
    if (kind->step == tf_step_located &&
        ((map < MASS && m.report[0].choices > 1) ||
         ((!IS_DOUBLE || map == TIME) &&
          m.report[0].status + m.report[1].status != TF_OK)))
      break;
    const tf_state_t image = mapped_state(map, m.x[0]);
    if (!agree && kind->step == tf_step_located &&
        (map == TIME || now.g == 0) && m.report[1].status == status &&
        are_near(&m.k[1], &m.u[1], &start, &image, &m.x[1])) {
      m.x[1] = image;
      continue;
    }
    if (!agree && map == TIME && same_state(&image, &m.x[1]) &&
        (underflows(m.report[0].slip.h * m.report[0].slip.h) ||
         rests_in_a_unit(&m.k[0], &m.u[0], &m.x[0]))) {
      m.report[1].status = status;
      agree = same_report(map, &m.report[0], &m.report[1]);
    }
    /* A step that is not TF_OK may end in a tie, and in other units other ends
     * violate the law least. */
    if (!agree)
      return (status == TF_OK || m.report[1].status == TF_OK) &&
                     !(map < MASS && is_symmetric(&p, &m.u[0], &from, m.report))
                 ? n
                 : most;
    *ends +=
        from.mode == TF_PINNED && m.x[0].mode != TF_PINNED && status == TF_OK;
  }
  return most;
}

TEST(mirror_symmetry) {
  static const kind_t kinds[] = {
      {tf_step, "step", 1, false, true, true},
      {tf_step, "step of any law", 0.05, true, false, true},
      {tf_step_located, "locate", 0.3, false, false, false}};
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
    for (int map = 0; map < MAPS; map++) {
      long ends = 0;
      for (int trial = 0; trial < samples(i > 0 ? 1500 : 6000); trial++) {
        const int n = agreeing_images(&kinds[i], map, i > 0 ? 12 : 60, &ends);
        if (!CHECK(n == (i > 0 ? 12 : 60)))
          printf("#   %s, map %d, trial %d: parts at step %d\n", kinds[i].name,
                 map, trial, n);
      }
      if (i == 0) CHECK_ABOVE(ends, samples(1000));
    }
}

/* The located step through a two-fold, which no random machine comes to. */
TEST(two_fold_is_located_in_all_images) {
  tf_params_t p = tf_scenes[0]->params;
  p.dt = TF_R(0x1p-10);
  for (int map = 0; map < SHIFT; map++) {
    const tf_machine_t a = prepared(&p), b = mapped_machine(map, p);
    const tf_input_t u = tf_input_default(&a), v = mapped_input(map, u);
    tf_state_t x = {.mode = TF_NO_MODE};
    tf_report_t first, second;
    CHECK(tf_scene_start(tf_scenes[0], &a, 0, &x, &first) == TF_OK);
    tf_state_t y = mapped_state(map, x);
    for (int n = 0; n < 2500; n++) {
      const tf_status_t s = tf_step_located(&a, &x, &u, &first);
      CHECK(s >= TF_OK && tf_step_located(&b, &y, &v, &second) == s);
      const tf_state_t want = mapped_state(map, x);
      if (!CHECK(same_state(&want, &y) && /* see are_near() of the force */
                 (map == TIME || same_report(map, &first, &second)))) {
        printf("#   map %d: differs at step %d\n", map, n);
        break;
      }
    }
  }
}
