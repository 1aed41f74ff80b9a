// The probability that small noise has a motion leave h = g = 0 of `chaos` in
// slip-, where it arrives in slip+ (tools/cli/diverge/corner.h):
//
//   P = P0 + (1 - P0) q (1 - e) / (q + e - q e)
//
// P0 leave in slip- before they first are in stick-. Of those in stick- a share
// e never comes back, and q leaves in slip- after coming back and before it is
// in stick- again. q is small: it is a product over levels of g - n_g h, which
// no noise moves. Each starts from states in which the last one was reached.
//
// usage: corner R N_G N_2 EPS SAMPLES SEED
// Prints P0, q, e and P, and b; behind P0, q and P their standard errors.

#include "../cli/diverge/corner.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define RISE 0.25  // far apart are two levels, up to far,
#define FACTOR 2.0 // and beyond that the ratio of two

#define NEAR 0.8    // of far, what comes back from stick-
#define REACH 300.0 // h'^2 |g| where a motion begins, and where it has left

static cli_random_t numbers;

// |g| where slip+ begins (side 0), or slip- has left.
static double reach_of(const cli_corner_t *c, int side) {
  return REACH / (c->h[0][side] * c->h[0][side]);
}

static bool left_in_slip(const cli_corner_t *c, cli_slip_t x) {
  return x.g > reach_of(c, 1) && -x.h > 4 * sqrt(x.g);
}

// The probability that stick- never comes back; and where it does, which does
// not depend on what was before: h is in its stationary law.
static double gone_of(const cli_corner_t *c) {
  return c->b > 0 ? -expm1(-2 * c->b * (1 - NEAR) * c->far / c->s2) : 0;
}

static cli_slip_t back(const cli_corner_t *c) {
  const double *h = c->h[1];
  const bool up = cli_uniform(&numbers) < h[1] / (h[1] - h[0]);
  return (cli_slip_t){.h = log(cli_uniform(&numbers)) / (2 * h[up ? 0 : 1]),
                      .g = -NEAR * c->far};
}

// q, and its relative variance.
static double splits(const cli_corner_t *c, int n, double *variance) {
  cli_slip_t *now = malloc((size_t)n * sizeof *now);
  cli_slip_t *next = malloc((size_t)n * sizeof *next);
  double q = 1, left = 0, level = -c->far / 2;
  int have = n;
  if (now == NULL || next == NULL) exit(1);
  *variance = 0;
  for (int i = 0; i < n; i++) now[i] = back(c);
  while (have > 0 && level < 4 * reach_of(c, 1)) {
    int reached = 0, gone = 0;
    for (int i = 0; i < n; i++) {
      cli_slip_t x =
          have == n ? now[i] : now[(int)(cli_uniform(&numbers) * have)];
      while (!cli_corner_sticks(c, x) && x.g - c->n_g * x.h < level &&
             !left_in_slip(c, x))
        x = cli_corner_step(c, &numbers, x);
      if (left_in_slip(c, x))
        gone++;
      else if (!cli_corner_sticks(c, x))
        next[reached++] = x;
    }
    const double p = (double)(reached + gone) / n;
    *variance += (1 - p) / (p * n);
    left += q * gone / n;
    q *= (double)reached / n;
    cli_slip_t *const was = now;
    now = next;
    next = was;
    have = reached;
    level = level < c->far ? level + RISE * c->far : level * FACTOR;
  }
  free(now);
  free(next);
  return left + q;
}

int main(int argc, char **argv) {
  if (argc != 7) return 2;
  tf_machine_t chaos;
  (void)tf_prepare(&chaos, &tf_scenes[0]->params, NULL);
  const cli_wide_t wide = cli_widen(&chaos);
  const double noise[2] = {strtod(argv[2], NULL), strtod(argv[3], NULL)};
  const cli_corner_t c =
      cli_corner_at(&wide, strtod(argv[1], NULL), noise, strtod(argv[4], NULL));
  const int n = atoi(argv[5]);
  numbers.key = (uint32_t)strtoul(argv[6], NULL, 10);
  int first = 0;
  for (int i = 0; i < n; i++) {
    cli_slip_t x = cli_corner_ray(&c, 1, reach_of(&c, 0));
    while (!cli_corner_sticks(&c, x) && !left_in_slip(&c, x))
      x = cli_corner_step(&c, &numbers, x);
    first += left_in_slip(&c, x);
  }
  double variance;
  const double P0 = (double)first / n, error = sqrt(P0 * (1 - P0) / n);
  const double q = splits(&c, n, &variance), e = gone_of(&c);
  if (!(q > 0)) variance = 0; // none came so far
  const double R = q > 0 ? q * (1 - e) / (q + e - q * e) : 0;
  printf("%.6g,%.3g,%.6g,%.3g,%.6g,%.6g,%.3g,%.6g\n", P0, error, q,
         q * sqrt(variance), e, P0 + (1 - P0) * R,
         hypot(error * (1 - R), (1 - P0) * R * (1 - R) * sqrt(variance)), c.b);
  return 0;
}
