// What happens at h = g = 0, where the slip field depends on the angle alone.
#ifndef ORACLE_CODIM2_H
#define ORACLE_CODIM2_H

#include "leg.h"

// As the core's tf_mode_t, but no part of it.
typedef enum {
  SLIP_PLUS,
  SLIP_MINUS,
  STICK_PLUS,
  STICK_MINUS,
  IS_PINNED
} contact_t;

// A limit direction of slip, where the angle atan2(h, g) does not change.
typedef struct {
  real angle;  // [rad]
  real speed;  // d/dt sqrt(g^2 + h^2) along it [m/s^2]
  real growth; // of an orbit's angle to it; attracts where < 0 [m/s^2]
} direction_t;

enum { DIRECTIONS = 16 };

int limit_directions(const machine_t *p, const ramp_t *ramp, real r, real t,
                     direction_t found[DIRECTIONS]);

// How the motion goes on under `persist`.
typedef struct {
  unsigned set;        // consistent modes, bits
  int mode;            // taken, or -1
  direction_t along;   // of a slip
  const char *unknown; // why it is not known, or NULL
} continuation_t;

continuation_t continuation_at_codim2(const machine_t *p, const ramp_t *ramp,
                                      real r, real t, int from);

#endif
