// A leg is a stretch of motion on one smooth field, in the coordinates that
// are regular there, with guards that are positive along it.
#ifndef ORACLE_LEG_H
#define ORACLE_LEG_H

#include "physics.h"

typedef enum {
  SLIP,  // y = (r, p, z, t), dt = dsigma
  POLAR, // y = (r, atan2(h, g), ln radius, t), dt = radius dsigma
  STICK, // y = (r, g, 0, t) on h = 0, dt = J |A| dsigma
  PINNED // y = (r, 0, 0, t), dt = dsigma
} kind_t;

enum { DIM = 4, AT_T = 3, GUARDS = 6 };

typedef struct {
  const machine_t *p;
  ramp_t ramp;
  kind_t kind;
  piece_t piece; // side is the sign of A in stick
} leg_t;

// What ended a leg.
typedef enum {
  END_H,       // h = 0
  END_G,       // g = 0
  END_ZONE,    // another zone of the string
  END_PLUS,    // h' of slip+ turns its sign
  END_MINUS,   // h' of slip- does
  END_FALL,    // into h = g = 0
  END_CHART,   // other coordinates are better
  END_TWOFOLD, // A = 0 with h' = 0
  END_TIME
} end_t;

typedef struct {
  end_t end;
  real value; // > 0 along the leg
} guard_t;

void leg_rates(const leg_t *leg, const real y[DIM], real dy[DIM]);
int leg_guards(const leg_t *leg, const real y[DIM], guard_t guard[GUARDS]);
real leg_longest(const leg_t *leg, const real y[DIM]);
void leg_start(const leg_t *leg, const motion_t *x, real h, real g,
               real y[DIM]);
motion_t leg_motion(const leg_t *leg, const real y[DIM], real *h, real *g);
// Whether polar coordinates suit this radius.
int leg_is_near(const machine_t *p, real r, real h, real g);

// Below exp(LN_TINY) = 6e-19 m/s the rest of a fall is one straight line: its
// error is of second order in that radius.
#define LN_TINY (-42)

#endif
