// The genes under which a function takes most instructions.
#ifndef COST_SEARCH_H
#define COST_SEARCH_H

#include <stddef.h>

#include "verify/cost/calls.h"

typedef struct {
  uint32_t count;
  genes_t genes;
} found_t;

// Instructions of one call; 0 where the genes spell no valid machine.
uint32_t count_of(const call_t *call, unsigned units, const genes_t *genes);

// Tries `evaluations` genes, times the call's weight: at random, then by
// changing the best of them, and the `count` of `from`. Genes that do not
// matter are 0 in the end.
found_t search(const call_t *call, unsigned units, const genes_t *from,
               size_t count, long evaluations);

#endif
