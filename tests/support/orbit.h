/* orbit.h - the reference orbit: the `chaos` scene followed in long double
 * from its start to the two-fold, every event located by a root finder.
 *
 *   slip+   from r = 0.18, w = -1.037, h = 1e-10 into h = g = 0;
 *   stick-  on h = 0, g < 0, until the spring brings it back to g = 0;
 *   slip-   along the one direction that leaves that point, down to h = 0;
 *   stick+  in the lower sliding region, into the two-fold.
 *
 * Two points of it are h = g = 0, where the slip field depends on the angle
 * alone and an ordinary solver stalls or guesses. Here slip is integrated in
 * polar coordinates of (g, h) with the logarithm of the radius: the point is
 * an equilibrium at minus infinity, reached and left along its limit
 * directions to any accuracy. The two-fold is treated the same way: the
 * sliding field times A(r, s) is smooth through it. */
#ifndef TESTS_SUPPORT_ORBIT_H
#define TESTS_SUPPORT_ORBIT_H

#include "paper.h"

#define ORBIT_R_START 0.18L
#define ORBIT_W_START (-1.037L)
#define ORBIT_H_START 1e-10L

/* A direction along which slip orbits enter or leave h = g = 0 at some r.
 * `speed` is d/dt of the distance sqrt(g^2 + h^2) along it: negative enters.
 * `pull` is the growth of a small angle off it, per unit of
 * logarithmic time dt / distance: negative attracts as time runs on. */
typedef struct {
  long double angle; /* atan2(h, g) [rad], in (-pi, pi), h != 0 */
  long double speed; /* [m/s^2] */
  long double pull;  /* [m/s^2] */
} orbit_direction_t;

/* All limit directions of slip at h = g = 0, by angle; returns how many (at
 * most `room` are written). */
int orbit_limit_directions(const paper_t *p, long double r, int room,
                           orbit_direction_t *found);

typedef struct {
  long double t;    /* [s] */
  long double x[3]; /* r, v, w */
} orbit_point_t;

typedef struct {
  orbit_point_t fall;         /* slip+ arrives at h = g = 0 */
  orbit_point_t leave;        /* stick- arrives at h = g = 0 */
  orbit_point_t land;         /* slip- arrives at the lower sliding region */
  orbit_point_t twofold;      /* stick+ arrives at the two-fold */
  long double fall_angle;     /* of arrival, atan2(h, g) [rad] */
  long double leave_angle;    /* of departure, atan2(h, g) [rad] */
  long double twofold_slope;  /* dw/dr 3e-9 m before arrival [1/(m s)] */
  long double twofold_lambda; /* lambda there [N] */
  long double stick_lambda;   /* largest |lambda| met in stick- [N] */
} orbit_events_t;

/* The whole orbit of the default machine; about 0.1 s. An event not reached
 * is all zeros. */
void orbit_chaos(orbit_events_t *ev);

/* The state at time t in [0, arrival at the two-fold], to about 1e-15;
 * about 0.02 s. Later times give the state 3e-9 m before the two-fold. */
void orbit_chaos_state(long double t, long double x[3]);

#endif
