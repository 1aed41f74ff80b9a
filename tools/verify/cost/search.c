// A quarter of the trials are at random, the others mix two of the best or
// change one of them by a few genes, and go on from what is no better but not
// worse: the count is a staircase, and its plateaus are walked along.
#include "verify/cost/search.h"

#include <string.h>

#define BEST 32

uint32_t count_of(const call_t *call, unsigned units, const genes_t *genes) {
  subject_t s = subject_of(genes);
  s.units = units;
  return s.valid ? call->count(&s) : 0;
}

typedef struct {
  uint64_t state;
} dice_t;

// xorshift64*
static uint32_t roll(dice_t *dice) {
  uint64_t x = dice->state;
  x ^= x >> 12;
  x ^= x << 25;
  x ^= x >> 27;
  dice->state = x;
  return (uint32_t)(x * UINT64_C(2685821657736338717) >> 32);
}

static genes_t random_genes(dice_t *dice) {
  genes_t genes;
  for (unsigned i = 0; i < GENES; i++) genes.gene[i] = roll(dice);
  // Few parameters off a scene at once, or nothing would be near anything.
  const uint32_t tame = roll(dice);
  for (unsigned i = 0; i < DRAWN_PARAMETERS; i++)
    if (tame & 1u && roll(dice) & 3u) genes.gene[i] &= ~7u;
  return genes;
}

static genes_t changed(const found_t *best, dice_t *dice) {
  genes_t genes = best[roll(dice) % BEST].genes;
  const genes_t *other = &best[roll(dice) % BEST].genes;
  if (roll(dice) % 8 == 0)
    for (unsigned i = 0; i < GENES; i++)
      if (roll(dice) & 1u) genes.gene[i] = other->gene[i];
  for (unsigned n = 1 + roll(dice) % 4; n > 0; n--) {
    uint32_t *gene = &genes.gene[roll(dice) % GENES];
    switch (roll(dice) % 5) {
      case 0:
        *gene = roll(dice);
        break;
      case 1: // which way it is made
        *gene ^= 1u << roll(dice) % 8;
        break;
      case 2: // a small step
        *gene += (roll(dice) & 1u ? 1u : ~0u) << (8 + roll(dice) % 20);
        break;
      case 3: // a smaller one
        *gene ^= 1u << (8 + roll(dice) % 24);
        break;
      default:
        *gene = other->gene[gene - genes.gene];
    }
  }
  return genes;
}

// Takes the place of the worst of the best where it is as good.
static void keep(found_t *best, const found_t *one) {
  unsigned least = 0;
  for (unsigned i = 1; i < BEST; i++)
    if (best[i].count < best[least].count) least = i;
  if (one->count >= best[least].count) best[least] = *one;
}

static const found_t *most(const found_t *best) {
  const found_t *one = best;
  for (unsigned i = 1; i < BEST; i++)
    if (best[i].count > one->count) one = &best[i];
  return one;
}

// Genes that the count does not hang on become 0.
static void simplify(const call_t *call, unsigned units, found_t *one) {
  for (unsigned i = 0; i < GENES; i++) {
    genes_t simpler = one->genes;
    simpler.gene[i] = 0;
    const uint32_t count = count_of(call, units, &simpler);
    if (count < one->count) continue;
    one->count = count;
    one->genes = simpler;
  }
}

found_t search(const call_t *call, unsigned units, const genes_t *from,
               size_t count, long evaluations) {
  dice_t dice = {UINT64_C(0x9e3779b97f4a7c15)};
  found_t best[BEST];
  memset(best, 0, sizeof best);
  for (size_t i = 0; i < count; i++) {
    const found_t one = {count_of(call, units, &from[i]), from[i]};
    keep(best, &one);
  }
  const long all = evaluations * call->weight;
  for (long i = 0; i < all; i++) {
    found_t one;
    one.genes = 4 * i < all ? random_genes(&dice) : changed(best, &dice);
    one.count = count_of(call, units, &one.genes);
    keep(best, &one);
  }
  found_t found = *most(best);
  simplify(call, units, &found);
  return found;
}
