/// @file
/// The rows of the table; see rows.h.
#include "rows.h"

#include <math.h>

#include "classes.h"

static double longest(const row_t *row) { return row->dt[0]; }

static void move(draw_t *draw, lib_machine_t *q, const row_t *row,
                 moving_shape_t shape) {
  const double grid = fmax(row->t_end / 90, longest(row));
  moving_draw(draw, q, shape, row->t_end, grid);
}

static void any_move(draw_t *draw, lib_machine_t *q, const row_t *row) {
  const double shape = draw_uniform(draw, 0, MOVING_SHAPES);
  move(draw, q, row, (moving_shape_t)(int)shape);
}

static double around(draw_t *draw, double size) {
  return (float)(size * draw_uniform(draw, -1, 1));
}

// The scene `chaos` in every second draw, from where it comes to h = g = 0.
static void near_chaos(draw_t *draw, lib_machine_t *q) {
  if (draw_uniform(draw, 0, 2) < 1) {
    *q = replay_machine;
    q->r = (float)draw_uniform(draw, 0.05, 0.3);
    q->omega = q->omega0 + around(draw, 0.1);
    q->v = around(draw, 0.1);
    q->on_surface = draw_uniform(draw, 0, 3) < 1;
  }
}

static void draw_ramps(draw_t *draw, lib_machine_t *q, const row_t *row,
                       bool moves) {
  (void)moves;
  near_chaos(draw, q);
  move(draw, q, row, MOVING_RAMP);
}

static void draw_shapes(draw_t *draw, lib_machine_t *q, const row_t *row,
                        bool moves) {
  (void)moves;
  near_chaos(draw, q);
  any_move(draw, q, row);
}

// Far from h = 0.
static void draw_smooth(draw_t *draw, lib_machine_t *q, const row_t *row,
                        bool moves) {
  (void)moves;
  q->on_surface = false;
  q->v = q->d * (q->omega - q->omega0) + around(draw, 4);
  move(draw, q, row, MOVING_RAMP);
}

// At rest where the spring and the turning balance but for a force that friction
// may hold; or about to come to rest there.
static void at_rest(draw_t *draw, lib_machine_t *q) {
  const double stiffness = q->k2 - q->m * q->omega0 * q->omega0;
  const double share = 1 - draw_log(draw, 1e-3, 1);
  const double side = draw_uniform(draw, 0, 2) < 1 ? -1 : 1;
  const double hold = side * share * q->mu * sin(q->gamma);
  q->on_surface = q->coulomb = false;
  q->r = (float)fmax(-2, fmin(2, (q->k2 * q->r0 + hold) / stiffness));
  q->v = 0;
  q->omega = q->omega0;
  if (draw_uniform(draw, 0, 4) < 1) {
    q->v = around(draw, 0.05);
    q->omega = (float)(q->omega0 * (1 + around(draw, 0.05)));
  }
}

static void draw_rest(draw_t *draw, lib_machine_t *q, const row_t *row,
                      bool moves) {
  (void)moves;
  at_rest(draw, q);
  move(draw, q, row, MOVING_RAMP);
}

static void draw_through_zero(draw_t *draw, lib_machine_t *q, const row_t *row,
                              bool moves) {
  (void)moves;
  at_rest(draw, q);
  move(draw, q, row, MOVING_THROUGH_ZERO);
}

static void near_codim2(draw_t *draw, lib_machine_t *q, double low,
                        double high) {
  const double z = around(draw, draw_log(draw, low, high));
  q->on_surface = false;
  q->omega = q->omega0 + z;
  q->v = q->d * z + around(draw, draw_log(draw, low, high));
}

static void maybe_move(draw_t *draw, lib_machine_t *q, const row_t *row,
                       bool moves) {
  if (moves) {
    any_move(draw, q, row);
  }
}

// A slip just above h = 0 that comes there before g changes its sign.
static void draw_short_stick(draw_t *draw, lib_machine_t *q, const row_t *row,
                             bool moves) {
  q->coulomb = q->on_surface = false;
  const double g = around(draw, draw_log(draw, 1e-5, 1e-2));
  const double h = g * around(draw, 1);
  const double s = sin(q->gamma), c = cos(q->gamma);
  const double z = (-h * c + g * s) / q->r;
  q->omega = q->omega0 + z;
  q->v = q->d * z - h * s - g * c;
  maybe_move(draw, q, row, moves);
}

static void draw_axis(draw_t *draw, lib_machine_t *q, const row_t *row,
                      bool moves) {
  q->beta = (float)draw_log(draw, 1e-4, 5e-2);
  q->on_surface = false;
  q->v = around(draw, 2);
  q->r = (float)(-q->v * draw_uniform(draw, 0, row->t_end / 2));
  maybe_move(draw, q, row, moves);
}

static void draw_impulses(draw_t *draw, lib_machine_t *q, const row_t *row,
                          bool moves) {
  q->mu = (float)draw_log(draw, 1e2, 1e5);
  maybe_move(draw, q, row, moves);
}

static void draw_near(draw_t *draw, lib_machine_t *q, const row_t *row,
                      bool moves) {
  near_codim2(draw, q, 1e-5, 3e-2);
  maybe_move(draw, q, row, moves);
}

static void draw_extreme(draw_t *draw, lib_machine_t *q, const row_t *row,
                         bool moves) {
  double low = 0, high = 0;
  *q = draw_machine(draw, true);
  lib_range("kappa", &low, &high);
  if (draw_uniform(draw, 0, 3) < 1) {
    q->kappa = (float)draw_log(draw, fmax(low, 1e-9), high);
  }
  maybe_move(draw, q, row, moves);
}

static void draw_stiff(draw_t *draw, lib_machine_t *q, const row_t *row,
                       bool moves) {
  q->coulomb = false;
  q->kappa = (float)draw_log(draw, 1, 100);
  maybe_move(draw, q, row, moves);
}

static bool comes_through(const met_t *met) { return met->through > 0; }
static bool is_smooth(const met_t *met) { return met->events == 0; }
static bool rested(const met_t *met) { return met->rested; }
static bool left_rest(const met_t *met) { return met->left_rest; }
static bool short_stick(const met_t *met) { return met->stuck < 1e-3; }
static bool passes_axis(const met_t *met) { return met->passed_r; }

#define F64 &lib_f64
#define F32 &lib_f32
static const model_t all[] = {
    {LIB_STEP, F64, 1, 0},        {LIB_STEP, F32, 1, 0},
    {LIB_COMPENSATED, F64, 1, 0}, {LIB_COMPENSATED, F32, 1, 0},
    {LIB_LANES, F64, 1, 9e-5},    {LIB_LOCATED, F64, 10, 9e-5}};
static const model_t rounding[] = {
    {LIB_STEP, F64, 1, 0}, {LIB_STEP, F32, 1, 0}, {LIB_COMPENSATED, F32, 1, 0}};
static const model_t slow[] = {
    {LIB_STEP, F64, 1, 0},        {LIB_STEP, F32, 1, 0},
    {LIB_COMPENSATED, F64, 1, 0}, {LIB_COMPENSATED, F32, 1, 0},
    {LIB_LANES, F64, 1, 0},       {LIB_LOCATED, F64, 1, 0}};
static const model_t short_steps[] = {
    {LIB_STEP, F64, 1, 0},        {LIB_STEP, F32, 1, 0},
    {LIB_COMPENSATED, F64, 1, 0}, {LIB_COMPENSATED, F32, 1, 0},
    {LIB_LANES, F64, 1, 0},       {LIB_LOCATED, F64, 10, 0}};

#define MODELS(list) .models = list, .model_count = sizeof list / sizeof *list
#define USUAL .t_end = 0.5, .dt = {1e-3, 1e-4, 1e-5}, MODELS(all)
#define LONG .t_end = 2, .dt = {1e-3, 1e-4}, MODELS(all)

const row_t rows[ROWS] = {
    {"A", "ramps of omega0, through h = g = 0", USUAL, .draw = draw_ramps,
     .takes = comes_through},
    {"A8", "inputs of eight shapes, through h = g = 0", USUAL,
     .draw = draw_shapes, .takes = comes_through},
    {"A'", "smooth slip on ramps: order below 1.5", .t_end = 0.48,
     .dt = {8e-3, 4e-3, 2e-3}, MODELS(slow), .order = true, .draw = draw_smooth,
     .takes = is_smooth},
    {"B", "a rest that ends, on ramps", LONG, .draw = draw_rest,
     .takes = left_rest},
    {"C", "rest while omega0 passes 0", LONG, .draw = draw_through_zero,
     .takes = rested},
    {"D", "a stick of less than 1 ms before h = g = 0", USUAL,
     .draw = draw_short_stick, .takes = short_stick},
    {"E", "across r = 0 with a small beta", USUAL, .draw = draw_axis,
     .takes = passes_axis},
    {"F", "impulses shorter than the step", .t_end = 0.1, .dt = {1e-4, 1e-5},
     MODELS(short_steps), .draw = draw_impulses},
    {"G", "rounding at 1 us", .t_end = 0.5, .dt = {1e-6}, MODELS(rounding),
     .draw = maybe_move},
    {"H", "near h = g = 0", USUAL, .draw = draw_near},
    {"I", "extreme k2, beta, mu, m, kappa", USUAL, .draw = draw_extreme},
    {"J", "kappa 1 to 100", USUAL, .draw = draw_stiff},
    {"K", "dt 0.1 s and 1 s", .t_end = 10, .dt = {1, 0.1}, MODELS(slow),
     .draw = maybe_move}};
