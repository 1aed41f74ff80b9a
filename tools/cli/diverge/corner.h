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

#define CLI_CORNER_REACH 2e5 ///< of a walk within a motion

/// The field at one r. [2]: of h > 0, of h < 0.
typedef struct {
  cli_slip_t smooth, of_F, of_M; ///< (h', g') without friction, of F and M / mu
  double kappa, share;           ///< of the law of slip
  double n_g, n_2, eps;          ///< of the noise; error of a step
  double h[2][2], g[2][2];       ///< h', g' at h -> 0; first index: g > 0, < 0
  double far;                    ///< |g| from which on stick- is averaged
  double b, s2;                  ///< |g| of stick-: drift, variance a time
} cli_corner_t;

/// Random numbers: number n under a key is the same whatever was drawn before.
typedef struct {
  uint64_t number;
  uint32_t key;
  bool has;
  double kept; ///< a normal one
} cli_random_t;
double cli_uniform(cli_random_t *random); ///< in (0, 1)
double cli_normal(cli_random_t *random);

/// machine: in, whose mu is not 0. n: in, n_g and n_2. eps: in, of the steps,
/// in (0, 0.5).
cli_corner_t cli_corner_at(const cli_wide_t *machine, double r,
                           const double n[2], double eps);

/// On the ray at g > 0 along which slip+ arrives, or slip- leaves (side 1, -1).
cli_slip_t cli_corner_ray(const cli_corner_t *corner, double side, double g);

/// Takes a step. Next to h = 0 it is the exact exit from a strip of a diffusion
/// with a constant drift on either side, elsewhere that of Euler and Maruyama.
cli_slip_t cli_corner_step(const cli_corner_t *corner, cli_random_t *random,
                           cli_slip_t x);

/// Whether it is in stick- far from the corner, where |g| is a Brownian motion
/// with drift b.
bool cli_corner_sticks(const cli_corner_t *corner, cli_slip_t x);

/// Whether stick- attracts slips; and |g| from where on noise does not turn it.
bool cli_corner_attracts(const cli_corner_t *corner);
double cli_corner_away(const cli_corner_t *corner);

/// Follows noise from anywhere near h = g = 0 until it is `reach` from it, or
/// at cli_corner_away in stick-. Where stick- does not leave it goes on in
/// slip- at once: its rest, of about 1e6 / |b| for `chaos`, is left out.
/// Returns: whether it came there within ten million steps.
bool cli_corner_walk(const cli_corner_t *corner, cli_random_t *random,
                     double reach, cli_slip_t *x);

/// Whether a motion that arrives in slip+ leaves in slip-, else in stick-. What
/// comes back from stick- is left out: 1 in 10000 for `chaos` (make corner).
bool cli_corner_selects(const cli_corner_t *corner, cli_random_t *random);
