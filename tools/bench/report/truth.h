/// @file
/// What the report calls true. The only file that knows where the reference
/// comes from is truth.c.
#ifndef TWOFOLD_REPORT_TRUTH_H
#define TWOFOLD_REPORT_TRUTH_H

#include "twofold.h"

typedef struct {
  long double x[3]; // r [m], v [m/s], w [rad/s]
} truth_state_t;

typedef struct {
  long double t; // [s]
  uint8_t after; // tf_mode_t
} truth_event_t;

#define TRUTH_EVENTS 64

/// Parameters of a reference problem; what it does not say (scheme, rule) is
/// that of scene `chaos`. Returns 0 where there is no such problem.
int truth_params(const char *problem, tf_params_t *params);

/// State of the reference at a time it knows; 0 where it does not know it.
int truth_state(const char *problem, long double t, truth_state_t *state);

/// State at the first two-fold of the reference; 0 where it meets none.
int truth_twofold(const char *problem, truth_state_t *state);

/// Slip speed h [m/s] at t = 0.
long double truth_start_slip(const char *problem);

/// Mode just after a time.
uint8_t truth_mode(const char *problem, long double t);

/// Changes of mode in (from, to]; returns how many, at most TRUTH_EVENTS.
int truth_events(const char *problem, long double from, long double to,
                 truth_event_t events[TRUTH_EVENTS]);

/// How far the reference may be off at a time, and one line on what it is.
double truth_uncertainty(const char *problem, long double t);
const char *truth_source(const char *problem, long double t);

#endif
