/// Small white noise at h = g = 0: what it selects, by a step that resolves the
/// layer in which it decides.
///
/// The field depends on the angle of (g, h) alone, so length and time in units
/// of the noise on h leave no parameter but the covariance of that on g with
/// it: dx = f(angle) dt + (n_g, 1) dW + (n_2, 0) dW2. All is in these units.
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "canard.h"

typedef struct {
  double h, g, t;
} cli_slip_t;

#define CLI_CORNER_REACH 2e5 ///< distance at which a walk ends

/// The field at one r. [2]: of h > 0, of h < 0.
typedef struct {
  cli_slip_t smooth, of_F, of_M; ///< (h', g') without friction, of F and M / mu
  double kappa, share;           ///< of the law of slip
  double n_g, n_2, eps;          ///< of the noise; error of a step
  double h[2][2], g[2][2];       ///< h', g' at h -> 0; first index: g > 0, < 0
  double far;                    ///< |g| from which on stick- is averaged
  double b, s2;                  ///< |g| of stick-: drift, variance a time
  double in, out;                ///< g where slip+ begins, and slip- has left
} cli_corner_t;

/// Random numbers: xoshiro256++ (Blackman and Vigna), seeded by splitmix64.
typedef struct {
  uint64_t word[4];
  double kept; ///< a normal one
  bool has;
} cli_random_t;
cli_random_t cli_random_of(uint64_t seed);
double cli_uniform(cli_random_t *random); ///< in (0, 1)

/// machine: in, whose mu is not 0. n: in, n_g and n_2. eps: in, of the steps,
/// in (0, 0.5).
cli_corner_t cli_corner_at(const cli_wide_t *machine, double r,
                           const double n[2], double eps);

/// The ray along which slip+ arrives, far from the corner.
cli_slip_t cli_corner_arrives(const cli_corner_t *corner);

/// Takes a step. Next to h = 0 it is the exact exit from a strip of a diffusion
/// with a constant drift on either side, elsewhere that of Euler and Maruyama.
cli_slip_t cli_corner_step(const cli_corner_t *corner, cli_random_t *random,
                           cli_slip_t x);

/// Whether it is in stick- far from the corner, where |g| is a Brownian motion
/// with drift b; or has left in slip-.
bool cli_corner_sticks(const cli_corner_t *corner, cli_slip_t x);
bool cli_corner_left(const cli_corner_t *corner, cli_slip_t x);

/// The probability that stick- then never comes back; and where it comes back,
/// which does not depend on what was before.
double cli_corner_gone(const cli_corner_t *corner);
cli_slip_t cli_corner_back(const cli_corner_t *corner, cli_random_t *random);

/// Whether a motion that arrives in slip+ leaves in slip-, else in stick-. It
/// does where stick- does not leave. What comes back from stick- and leaves in
/// slip- then is left out: 1 in 10000 for `chaos` (make corner).
bool cli_corner_selects(const cli_corner_t *corner, cli_random_t *random);

/// Whether stick- attracts slips; and |g| from where on noise does not turn it.
bool cli_corner_attracts(const cli_corner_t *corner);
double cli_corner_away(const cli_corner_t *corner);

/// Follows noise from anywhere near h = g = 0 until it is CLI_CORNER_REACH from
/// it, or at cli_corner_away in stick-. Stick- that does not leave goes on in
/// slip- at once: its rest takes about 1e9 units of time at most (`chaos`).
/// Returns: whether it came there within ten million steps.
bool cli_corner_walk(const cli_corner_t *corner, cli_random_t *random,
                     cli_slip_t *x);
