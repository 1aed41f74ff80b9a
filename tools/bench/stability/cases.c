// The sweeps, as data: which parameter or start is driven to its extreme. SI.
#include <math.h>

#include "cell.h"

static void set_k2(case_t *c, tf_real_t y) { c->params.k2 = y; }

// The stiff spring alone, without the violent start of 0.08 m of stretch.
static void set_k2_rest(case_t *c, tf_real_t y) {
  c->params.k2 = y;
  c->params.r0 = c->r;
}
static void set_c1(case_t *c, tf_real_t y) { c->params.c1 = y; }
static void set_c2(case_t *c, tf_real_t y) { c->params.c2 = y; }
static void set_beta(case_t *c, tf_real_t y) { c->params.beta = y; }
static void set_kappa(case_t *c, tf_real_t y) { c->params.kappa = y; }
static void set_mu(case_t *c, tf_real_t y) { c->params.mu = y; }
static void set_m(case_t *c, tf_real_t y) { c->params.m = y; }
static void set_d(case_t *c, tf_real_t y) { c->params.d = y; }

// The disc turns a little faster than the turntable, as in `chaos`.
static void set_omega0(case_t *c, tf_real_t y) {
  c->params.omega0 = -y;
  c->w = TF_R(-1.037) * y;
}

// Degrees, so that the exact corners are in the grid.
static void set_gamma(case_t *c, tf_real_t degrees) {
  const double pi = 3.14159265358979323846;
  c->params.gamma = (tf_real_t)((double)degrees / 180 * pi);
}

// A start that does not say h.
static void start(case_t *c, tf_real_t r, tf_real_t v, tf_real_t w) {
  c->r = r;
  c->v = v;
  c->w = w;
  c->v_from_h = false;
}

// A disc of nearly no inertia, and a slider that runs through the axis.
static void set_through(case_t *c, tf_real_t y) {
  c->params.beta = TF_R(1e-3);
  c->params.c2 = 0;
  start(c, TF_R(0.1), -y, c->w);
}

static void set_far_r(case_t *c, tf_real_t y) { start(c, y, 0, c->w); }
static void set_far_v(case_t *c, tf_real_t y) { start(c, c->r, y, c->w); }
static void set_far_w(case_t *c, tf_real_t y) { start(c, c->r, 0, y); }
static void set_far(case_t *c, tf_real_t y) { start(c, y, y, y); }

// In units of the least normal number: below 1 lie the subnormal ones.
static void set_tiny_state(case_t *c, tf_real_t y) {
  const tf_real_t unit = y * TF_REAL_MIN;
  start(c, TF_R(0.18) * unit, TF_R(0.02) * unit, TF_R(-1.037) * unit);
  c->params.r0 = TF_R(0.1) * unit;
  c->params.omega0 = -unit;
}
static void set_tiny_params(case_t *c, tf_real_t y) {
  const tf_real_t unit = y * TF_REAL_MIN;
  c->params.mu = unit;
  c->params.k2 = unit;
  c->params.c1 = unit;
  c->params.c2 = unit;
}

// Nothing takes or gives energy.
static void set_conservative(case_t *c, tf_real_t y) {
  c->params.law = TF_TYRE_NONE;
  c->params.c1 = 0;
  c->params.c2 = 0;
  c->params.k2 = y;
}

// The spring against the centrifugal force: a heavy disc keeps its speed, so
// r grows as exp(sqrt(w^2 - k2/m) t) where the ratio is below 1.
static void set_centrifugal(case_t *c, tf_real_t ratio) {
  set_conservative(c, ratio * 100);
  c->params.beta = 1000;
  c->params.d = 0;
  start(c, c->r, 0, 10);
}

static void set_smooth(case_t *c, tf_real_t y) {
  c->params.law = TF_TYRE_SMOOTH;
  c->params.epsilon = y;
}
static void set_string(case_t *c, tf_real_t y) {
  c->params.law = TF_TYRE_STRING;
  c->params.delta = c->params.sigma = c->params.a = 1;
  c->params.rho = TF_R(0.66666666666666666667);
  c->params.k = y;
}
static void set_two_piece(case_t *c, tf_real_t y) {
  c->params.law = TF_TYRE_TWO_PIECE;
  c->params.k = y;
}

static void set_spinning(case_t *c, tf_real_t y) {
  set_conservative(c, 1);
  start(c, c->r, 0, y);
}

static void set_from_scene(case_t *c, const tf_scene_t *scene) {
  c->params = scene->params;
  c->r = scene->r;
  c->w = scene->omega;
  c->h = scene->h;
  c->v = scene->v;
  c->v_from_h = !scene->v_is_given;
  c->scene = scene;
}
static void set_scene(case_t *c, tf_real_t index) {
  set_from_scene(c, tf_scenes[(int)index]);
}

const sweep_t sweeps[SWEEPS] = {
    {"k2", 16, -2, 1, true, set_k2},
    {"k2_rest", 16, -2, 1, true, set_k2_rest},
    {"c1", 14, -3, 1, true, set_c1},
    {"c2", 14, -3, 1, true, set_c2},
    {"beta", 13, -6, 2, false, set_beta},
    {"m", 19, -9, 1, false, set_m},
    {"d", 14, -6, 1, true, set_d},
    {"mu", 14, -6, 1, true, set_mu},
    {"kappa", 10, -6, 1, false, set_kappa},
    {"gamma", 24, 0, 0, false, set_gamma},
    {"omega0", 14, -2, 2, true, set_omega0},
    {"through", 15, -3, 2, false, set_through},
    {"far_r", 14, 0, 2, true, set_far_r},
    {"far_v", 13, 0, 2, false, set_far_v},
    {"far_w", 13, 0, 2, false, set_far_w},
    {"far", 14, 0, 2, true, set_far},
    {"tiny_state", 24, -16, 1, true, set_tiny_state},
    {"tiny_params", 24, -16, 1, true, set_tiny_params},
    {"centrifugal", 12, 0, 0, false, set_centrifugal},
    {"smooth", 15, -12, 1, false, set_smooth},
    {"string", 15, -3, 1, false, set_string},
    {"two_piece", 15, -3, 1, false, set_two_piece},
    {"conservative", 16, -2, 1, true, set_conservative},
    {"spinning", 14, -2, 2, true, set_spinning},
    {"scenes", TF_SCENES, 0, 0, false, set_scene}};

double sweep_value(const sweep_t *sweep, int i) {
  static const double ratio[] = {0,    1e-3, 0.5, 0.9, 0.99, 1,
                                 1.01, 1.1,  2,   10,  1e3,  1e6};
  if (sweep->per_decade > 0) {
    if (sweep->from_zero && i == 0) return 0;
    const int n = sweep->from_zero ? i - 1 : i;
    return pow(10, sweep->low + (double)n / sweep->per_decade);
  }
  if (sweep->set == set_gamma) return 15.0 * (i - 11);
  if (sweep->set == set_centrifugal) return ratio[i];
  return i;
}

void sweep_case(const sweep_t *sweep, int i, case_t *c) {
  set_from_scene(c, tf_scenes[0]);
  c->scene = NULL;
  c->v = TF_R(0.1);
  sweep->set(c, (tf_real_t)sweep_value(sweep, i));
}
