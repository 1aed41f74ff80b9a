/* Reference solutions, made by `make oracle`, not by hand: by the solver of
 * tests/reference in quadruple precision, every switch located, from the
 * paper's equations without a line of the core. 25 digits; the uncertainty is
 * the largest difference from a computation at a tolerance 1000 times looser.
 * SI units; modes as the core names them. */
/* clang-format off */
#ifndef TESTS_DATA_REFERENCE_H
#define TESTS_DATA_REFERENCE_H

typedef struct {
  long double t, r, v, w; /* [s], [m], [m/s], [rad/s] */
} reference_state_t;

/* r, v and w are continuous: before is after. At h = g = 0 and at a two-fold
 * several modes may be consistent; `after` is "" where none is chosen. */
typedef struct {
  const char *before, *after;
  const char *how; /* cross enter leave roll h=g=0 two-fold */
  reference_state_t at;
} reference_event_t;

/* A parameter that the law does not need is 0. States stand at i/16 of t_grid,
 * i = 1 ... states; events up to t_last, where the reference ends because of
 * `ends`. */
typedef struct {
  const char *name, *law, *begins, *ends;
  long double m, d, beta, k2, c1, c2, r0, omega0, mu, kappa, gamma;
  long double epsilon, k, delta, sigma, rho, a;
  long double h; /* at the start; v follows from it */
  reference_state_t start;
  long double t_grid, t_last;
  double state_uncertainty, time_uncertainty;
  int knots; /* of the turntable's speed, linear in between */
  long double knot[8][2]; /* [s], [rad/s] */
  int states, events;
  const reference_state_t *state;
  const reference_event_t *event;
} reference_t;

#include "reference_chaos.h"
#include "reference_gamma_zero.h"
#include "reference_gamma_right.h"
#include "reference_coulomb.h"
#include "reference_frictionless.h"
#include "reference_smooth.h"
#include "reference_rolling.h"
#include "reference_string.h"
#include "reference_driven.h"
#include "reference_crossings.h"
#include "reference_stickslip.h"

#define REFERENCES 11
static const reference_t *const references[REFERENCES] = {
    &reference_chaos,
    &reference_gamma_zero,
    &reference_gamma_right,
    &reference_coulomb,
    &reference_frictionless,
    &reference_smooth,
    &reference_rolling,
    &reference_string,
    &reference_driven,
    &reference_crossings,
    &reference_stickslip,
};

#endif
