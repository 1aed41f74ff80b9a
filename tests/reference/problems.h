/// @file
/// The reference problems: the scenes of the core and two benchmarks, in
/// decimals of their own, of which the maker of tests/data takes all digits.
/// gamma is -3 pi/4 or pi/2 to as many. `smooth` and `string` are stiff: they
/// are followed for 2.5 s, which takes minutes; `chaos` reaches its two-fold at
/// 2.05 s.
#ifndef REFERENCE_PROBLEMS_H
#define REFERENCE_PROBLEMS_H

#include "reference.h"

enum { REF_SIXTEENTHS = 16, REF_KEPT = 5 };

/// tests/data has states at sixteenths of t_grid, where the tests' steps may
/// end, and events up to there, or up to t_events.
typedef struct {
  ref_machine_t machine;
  ref_real_t r, omega;
  ref_real_t h, v;             ///< v or 0: from h
  ref_real_t t_grid, t_events; ///< or 0
  const char *name;
  int kept[REF_KEPT]; ///< the sixteenths, ascending; none: the quarters
} ref_problem_t;

#define N REF_NUMBER
#define COMMON \
  .m = 1, .d = 1, .c1 = N(0.001), .c2 = N(0.001), .r0 = N(0.1), .omega0 = -1
#define BODY .beta = N(0.05), .k2 = N(2.2270992253886014441), .mu = 1
#define KAPPA .kappa = N(0.27241153714062027818)
#define GAMMA .gamma = N(-2.3561944901923449288469825374596271631479)
#define START .r = N(0.18), .omega = N(-1.037), .h = N(1e-10)

static const ref_problem_t ref_problems[] = {
    {.name = "chaos",
     .machine = {COMMON, BODY, KAPPA, GAMMA},
     START,
     .t_grid = 2,
     .t_events = 10},
    {.name = "gamma_zero",
     .machine = {COMMON, BODY, KAPPA},
     .r = N(0.3),
     .omega = N(-0.8),
     .v = N(0.1),
     .t_grid = 10},
    {.name = "gamma_right",
     .machine = {COMMON, BODY, KAPPA,
                 .gamma = N(1.5707963267948966192313216916397514420986)},
     .r = N(0.3),
     .omega = N(-0.8),
     .v = N(0.1),
     .t_grid = 10},
    {.name = "coulomb",
     .machine = {COMMON, BODY, GAMMA, .law = REF_COULOMB},
     .r = N(0.18),
     .omega = N(-0.6),
     .h = N(0.3),
     .t_grid = 10},
    {.name = "frictionless",
     .machine = {COMMON, BODY, GAMMA, .law = REF_FREE},
     START,
     .t_grid = 10},
    {.name = "smooth",
     .machine = {COMMON, BODY, KAPPA, GAMMA, .epsilon = N(0.0001),
                 .law = REF_SMOOTH},
     START,
     .t_grid = N(2.5),
     .kept = {4, 8, 13, 16}},
    {.name = "rolling",
     .machine = {COMMON, BODY, KAPPA, GAMMA},
     .r = N(0.95),
     .omega = N(1.3),
     .t_grid = 10},
    {.name = "string",
     .machine = {COMMON, BODY, GAMMA, .k = 1, .delta = 1, .sigma = 1,
                 .rho = N(0.66666666666666666667), .a = 1, .law = REF_STRING},
     START,
     .t_grid = N(2.5)},
    {.name = "driven",
     .machine = {COMMON, BODY, KAPPA, GAMMA, .knots = 5,
                 .knot = {{.t = 0, .omega0 = -1},
                          {.t = 2, .omega0 = -2},
                          {.t = 4, .omega0 = -2},
                          {.t = 8, .omega0 = 1},
                          {.t = 10, .omega0 = 0}}},
     START,
     .t_grid = 12},
    {.name = "crossings",
     .machine = {COMMON, .beta = N(0.3), .k2 = 30, .mu = N(0.2), KAPPA, GAMMA},
     .r = N(0.6),
     .omega = N(0.5),
     .h = N(-0.01),
     .t_grid = 2,
     .kept = {4, 5, 8, 12, 16}},
    {.name = "stickslip",
     .machine = {COMMON, .beta = N(0.2), .k2 = 20, .mu = 3, KAPPA, GAMMA},
     .r = N(0.5),
     .omega = N(-0.8),
     .h = N(-0.01),
     .t_grid = 2,
     .kept = {4, 8, 11, 13, 16}}};
enum { REF_PROBLEMS = sizeof ref_problems / sizeof *ref_problems };

/// The start; of q all else is prepared.
static inline ref_state_t ref_problem_start(const ref_problem_t *problem,
                                            const ref_machine_t *q) {
  const ref_state_t x = ref_state(q, problem->r, problem->v, problem->omega);
  return problem->v != 0 ? x : ref_with_h(q, x, problem->h);
}

/// What tests/data/reference.h has of each problem: the mode at its start,
/// states and events, up to the end of its length or a two-fold. `after` is ""
/// where several modes are consistent and none is chosen.
typedef struct {
  long double t, r, v, w; ///< [s], [m], [m/s], [rad/s]
} reference_state_t;

typedef struct {
  const char *after;
  long double t; ///< [s]
} reference_event_t;

typedef struct {
  const ref_problem_t *problem;
  const char *begins;
  int states, events;
  const reference_state_t *state;
  const reference_event_t *event;
} reference_t;

/// When it ends [s].
static inline long double reference_end(const reference_t *ref) {
  const reference_event_t *last = ref->event + ref->events - 1;
  const bool folds = ref->events > 0 && last->after[0] == '\0';
  return folds ? last->t : (long double)ref->problem->t_grid;
}

#undef N
#undef COMMON
#undef BODY
#undef KAPPA
#undef GAMMA
#undef START

#endif
