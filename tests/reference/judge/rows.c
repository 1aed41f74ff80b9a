/// The rows of the table: how the machines of a class are drawn, and which of
/// them belong to it.
#include <math.h>

#include "judge.h"
#include "twofold.h"

static double around(draw_t *draw, double size) {
  return (float)(size * draw_uniform(draw, -1, 1));
}

// The scene `chaos` in every second draw, from where it comes to h = g = 0.
static void near_chaos(draw_t *draw, lib_machine_t *q) {
  if (draw_uniform(draw, 0, 2) < 1) {
    *q = (lib_machine_t){PARAMETERS_OF(double, &tf_scenes[0]->params),
                         .dt = 1e-4};
    q->r = (float)draw_uniform(draw, 0.05, 0.3);
    q->omega = q->omega0 + around(draw, 0.1);
    q->v = around(draw, 0.1);
    q->on_surface = draw_uniform(draw, 0, 3) < 1;
  }
}

// Far from h = 0.
static void in_slip(draw_t *draw, lib_machine_t *q) {
  q->on_surface = false;
  q->v = q->d * (q->omega - q->omega0) + around(draw, 4);
}

// At rest where the spring and the turning balance but for a force that
// friction may hold; or about to come to rest there.
static void at_rest(draw_t *draw, lib_machine_t *q) {
  const double stiffness = q->k2 - q->m * q->omega0 * q->omega0;
  const double share = 1 - draw_log(draw, 1e-3, 1);
  const double hold = -draw_sign(draw) * share * q->mu * sin(q->gamma);
  q->on_surface = q->coulomb = false;
  q->r = (float)fmax(-2, fmin(2, (q->k2 * q->r0 + hold) / stiffness));
  q->v = 0;
  q->omega = q->omega0;
  if (draw_uniform(draw, 0, 4) < 1) {
    q->v = around(draw, 0.05);
    q->omega = (float)(q->omega0 * (1 + around(draw, 0.05)));
  }
}

static void near_codim2(draw_t *draw, lib_machine_t *q) {
  const double low = 1e-5, high = 3e-2;
  const double z = around(draw, draw_log(draw, low, high));
  q->on_surface = false;
  q->omega = q->omega0 + z;
  q->v = q->d * z + around(draw, draw_log(draw, low, high));
}

// A slip just above h = 0 that comes there before g changes its sign.
static void above_surface(draw_t *draw, lib_machine_t *q) {
  q->coulomb = q->on_surface = false;
  const double g = around(draw, draw_log(draw, 1e-5, 1e-2));
  const double h = g * around(draw, 1);
  const double s = sin(q->gamma), c = cos(q->gamma);
  const double z = (-h * c + g * s) / q->r;
  q->omega = q->omega0 + z;
  q->v = q->d * z - h * s - g * c;
}

static void across_axis(draw_t *draw, lib_machine_t *q) {
  q->beta = (float)draw_log(draw, 1e-4, 5e-2);
  q->on_surface = false;
  q->v = around(draw, 2);
  q->r = (float)(-q->v * draw_uniform(draw, 0, 0.25));
}

static void hard_tyre(draw_t *draw, lib_machine_t *q) {
  q->mu = (float)draw_log(draw, 1e2, 1e5);
}

static void extreme(draw_t *draw, lib_machine_t *q) {
  double low = 0, high = 0;
  *q = draw_machine(draw, true);
  lib_range("kappa", &low, &high);
  if (draw_uniform(draw, 0, 3) < 1)
    q->kappa = (float)draw_log(draw, fmax(low, 1e-9), high);
}

static void large_kappa(draw_t *draw, lib_machine_t *q) {
  q->coulomb = false;
  q->kappa = (float)draw_log(draw, 1, 100);
}

static void strong_friction(draw_t *draw, lib_machine_t *q) {
  near_codim2(draw, q);
  q->coulomb = false;
  q->kappa = (float)draw_log(draw, 10, 100);
  q->mu = (float)draw_log(draw, 1e2, 1e4);
}

static bool comes_through(const met_t *met) { return met->through > 0; }
static bool is_smooth(const met_t *met) { return met->events == 0; }
static bool rested(const met_t *met) { return met->rested; }
static bool left_rest(const met_t *met) { return met->left_rest; }
static bool short_stick(const met_t *met) { return met->stuck < 1e-3; }
static bool passes_axis(const met_t *met) { return met->passed_r; }

lib_machine_t row_machine(draw_t *draw, const row_t *row, bool moves) {
  lib_machine_t q = draw_machine(draw, false);
  const double rest = draw_uniform(draw, 0, 8);
  if (row->place) row->place(draw, &q);
  if (moves || row->moves != MOVE_HALF) {
    const double shape = row->moves == MOVE_RAMP ? MOVING_RAMP
                         : row->moves == MOVE_THROUGH_ZERO
                             ? MOVING_THROUGH_ZERO
                             : draw_uniform(draw, 0, MOVING_SHAPES);
    moving_draw(draw, &q, (moving_shape_t)(int)shape, row->t_end,
                fmax(row->t_end / 90, row->dt[0]));
  }
  q.rest = rest < 6 ? 0 : rest < 7 ? 1 : 2;
  return q;
}

const model_t row_models[ROW_MODELS] = {
    {LIB_STEP, &lib_f64},        {LIB_STEP, &lib_f32},
    {LIB_COMPENSATED, &lib_f64}, {LIB_COMPENSATED, &lib_f32},
    {LIB_LANES, &lib_f64},       {LIB_LOCATED, &lib_f64},
    {LIB_LOCATED, &lib_f32}};

#define USUAL \
  .t_end = 0.5, .dt = {1e-3, 1e-4, 1e-5}, .located = 10, .least = 9e-5
#define LONG .t_end = 2, .dt = {1e-3, 1e-4}, .located = 10, .least = 9e-5

const row_t rows[ROWS] = {
    {"A", "ramps of omega0, through h = g = 0", USUAL, .place = near_chaos,
     .moves = MOVE_RAMP, .takes = comes_through},
    {"A8", "inputs of eight shapes, through h = g = 0", USUAL,
     .place = near_chaos, .moves = MOVE_ALL, .takes = comes_through},
    {"A'", "smooth slip on ramps: order below 1.5", .t_end = 0.48,
     .dt = {8e-3, 4e-3, 2e-3}, .located = 1, .order = true, .place = in_slip,
     .moves = MOVE_RAMP, .takes = is_smooth},
    {"B", "a rest that ends, on ramps", LONG, .rests = true, .place = at_rest,
     .moves = MOVE_RAMP, .takes = left_rest},
    {"C", "rest while omega0 passes 0", LONG, .rests = true, .place = at_rest,
     .moves = MOVE_THROUGH_ZERO, .takes = rested},
    {"D", "a stick of less than 1 ms before h = g = 0", USUAL,
     .place = above_surface, .takes = short_stick},
    {"E", "across r = 0 with a small beta", USUAL, .place = across_axis,
     .takes = passes_axis},
    {"F", "impulses shorter than the step", .t_end = 0.1, .dt = {1e-4, 1e-5},
     .located = 10, .place = hard_tyre},
    {"G", "rounding at 1 us", .t_end = 0.5, .dt = {1e-6}, .plain = true},
    {"H", "near h = g = 0, and through it", USUAL, .place = near_codim2,
     .takes = comes_through},
    {"I", "extreme k2, beta, mu, m, kappa", USUAL, .place = extreme},
    {"J", "kappa 1 to 100", USUAL, .place = large_kappa},
    {"K", "dt 0.1 s and 1 s", .t_end = 2, .dt = {1, 0.1}, .located = 1},
    {"L", "kappa from 10, mu from 100, through h = g = 0", .t_end = 0.1,
     .dt = {1e-2, 1e-3, 1e-4}, .located = 1, .least = 9e-5,
     .place = strong_friction, .takes = comes_through}};
