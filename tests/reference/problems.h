/// The reference problems: the scenes of the core and two benchmarks, in
/// decimals of their own. gamma is -3 pi/4 or pi/2. `smooth` and `string` are
/// stiff: they are followed for 2.5 s; `chaos` reaches its two-fold at 2.05 s.
#ifndef REFERENCE_PROBLEMS_H
#define REFERENCE_PROBLEMS_H

#include "reference.h"

enum { REF_SIXTEENTHS = 16, REF_KEPT = 5, REF_EVENTS = 40 };

/// A course has states at sixteenths of t_grid, where the tests' steps may end,
/// and events up to there, or up to t_events.
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

/// Modes after events: REF_MODES where several modes are consistent and none is
/// chosen.
typedef struct {
  ref_real_t t, r, v, w; ///< [s], [m], [m/s], [rad/s]
} reference_state_t;

typedef struct {
  ref_mode_t after;
  ref_real_t t; ///< [s]
} reference_event_t;

typedef struct {
  const ref_problem_t *problem;
  ref_mode_t begins;
  ref_real_t t_last; ///< end of its length, or a two-fold
  int states, events;
  reference_state_t state[REF_KEPT];
  reference_event_t event[REF_EVENTS];
} reference_t;

/// The course of a problem, 0 <= i < REF_PROBLEMS, to 1e-13 as a rule. It is
/// followed once.
const reference_t *reference_course(int i);
/// At another relative tolerance of its steps.
void reference_follow(int i, ref_real_t tolerance, reference_t *course);

#undef N
#undef COMMON
#undef BODY
#undef KAPPA
#undef GAMMA
#undef START

#endif
