/// @file
/// The random numbers of one sample. The generator is counter based, so they do
/// not depend on the order in which samples are computed.
#ifndef TWOFOLD_CLI_DRAWS_H
#define TWOFOLD_CLI_DRAWS_H

#include <stdint.h>

typedef struct {
  uint32_t seed, sample, used;
} cli_draws_t;

double cli_draw_uniform(cli_draws_t *draws); ///< in (0, 1)
double cli_draw_normal(cli_draws_t *draws);  ///< mean 0, variance 1

#endif
