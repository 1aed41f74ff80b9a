// The generator is Philox: draw n of sample i under a seed is the same number
// whatever was drawn before, so that any worker may compute any sample.

#include "draws.h"

#include <math.h>

#include "twofold.h"

#define TWO_PI 6.283185307179586

static void draw(cli_draws_t *draws, uint32_t word[2]) {
  tf_philox((uint64_t)draws->sample << 32 | draws->used, draws->seed, word);
  draws->used++;
}

// A word as a number in (0, 1).
static double fraction(uint32_t word) {
  return ((double)word + 0.5) * (1.0 / 4294967296.0);
}

double cli_draw_uniform(cli_draws_t *draws) {
  uint32_t word[2];
  draw(draws, word);
  return fraction(word[0]);
}

double cli_draw_normal(cli_draws_t *draws) {
  uint32_t word[2];
  draw(draws, word);
  return sqrt(-2 * log(fraction(word[0]))) * cos(TWO_PI * fraction(word[1]));
}
