/* orbit.h - the reference orbit: the `chaos` scene from its start to the
 * two-fold, by the solver of tests/reference in long double.
 *
 *   slip+   from r = 0.18, w = -1.037, h = 1e-10 into h = g = 0;
 *   stick-  on h = 0, g < 0, until the spring brings it back to g = 0;
 *   slip-   along the one direction that leaves that point, down to h = 0;
 *   stick+  in the lower sliding region, into the two-fold. */
#ifndef TESTS_SUPPORT_ORBIT_H
#define TESTS_SUPPORT_ORBIT_H

#include "paper.h"
#include "reference.h"

#define ORBIT_R_START 0.18L
#define ORBIT_W_START (-1.037L)
#define ORBIT_H_START 1e-10L

typedef struct {
  long double t;         /* [s] */
  long double x[3];      /* r, v, w */
  ref_consistent_t ways; /* at h = g = 0 */
} orbit_point_t;

typedef struct {
  orbit_point_t fall;      /* slip+ arrives at h = g = 0 */
  orbit_point_t leave;     /* stick- arrives at h = g = 0 */
  orbit_point_t land;      /* slip- arrives at the lower sliding region */
  orbit_point_t near;      /* stick+ some 1e-10 m before the two-fold */
  orbit_point_t twofold;   /* stick+ arrives there */
  long double fall_angle;  /* of arrival, atan2(h, g) [rad] */
  long double leave_angle; /* of departure, the same */
} orbit_events_t;

/* The reference's machine with the paper's parameters. */
ref_machine_t orbit_machine(const paper_t *p);

/* The whole orbit of the default machine. An event not reached is zeros. */
void orbit_chaos(orbit_events_t *ev);

/* The state at time t in [0, arrival at the two-fold], to about 1e-15. Later
 * times give the two-fold. */
void orbit_chaos_state(long double t, long double x[3]);

#endif
