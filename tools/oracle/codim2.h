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

// A limit direction of slip: speed is d/dt of sqrt(g^2 + h^2) along it, pull
// the growth of a turn away from it per unit of the logarithmic time.
typedef struct {
  real angle, speed, pull; // atan2(h, g); [m/s^2]
} direction_t;

enum { DIRECTIONS = 16 };

int limit_directions(const machine_t *p, const ramp_t *ramp, real r, real t,
                     direction_t found[DIRECTIONS]);

// How the motion goes on under `persist`.
typedef struct {
  unsigned set;        // consistent modes, bits
  int mode;            // taken, or -1
  direction_t along;   // of a slip
  const char *unknown; // why the future is not known, or NULL
} future_t;

future_t future_at_codim2(const machine_t *p, const ramp_t *ramp, real r,
                          real t, int from);

#endif
