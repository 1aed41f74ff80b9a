// Instructions of every public function, the most that a search finds:
//
//   cost EVALUATIONS <SEEDS          lines "name units count genes"
//
// Genes are spelled "index:hex,..." ("-": all 0); SEEDS are lines as they are
// printed. EVALUATIONS are calls a function and number of units. Nothing is
// random that the arguments do not tell.
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "verify/cost/calls.h"
#include "verify/cost/search.h"

#define LINE 2048

static const call_t *call_named(const char *name) {
  for (unsigned i = 0; i < call_count; i++)
    if (strcmp(calls[i].name, name) == 0) return &calls[i];
  return NULL;
}

static void print_found(const call_t *call, unsigned units,
                        const found_t *found) {
  const char *separator = "";
  printf("tf_%s %u %" PRIu32 " ", call->name, units, found->count);
  for (unsigned i = 0; i < GENES; i++) {
    if (found->genes.gene[i] == 0) continue;
    printf("%s%u:%" PRIx32, separator, i, found->genes.gene[i]);
    separator = ",";
  }
  puts(*separator == '\0' ? "-" : "");
  fflush(stdout);
}

// One line of SEEDS; the count in it is left to be made again.
typedef struct {
  const call_t *call;
  unsigned units;
  genes_t genes;
} seed_t;

static seed_t *seeds;
static size_t seed_count;

static int parse_genes(const char *at, genes_t *genes) {
  memset(genes, 0, sizeof *genes);
  while (*at >= '0' && *at <= '9') {
    char *end;
    const unsigned long i = strtoul(at, &end, 10);
    if (i >= GENES || *end != ':') return 0;
    genes->gene[i] = (uint32_t)strtoul(end + 1, &end, 16);
    at = *end == ',' ? end + 1 : end;
  }
  return 1;
}

static int read_seeds(void) {
  char line[LINE], name[64], genes[LINE];
  while (fgets(line, sizeof line, stdin)) {
    unsigned units, count;
    if (sscanf(line, "tf_%63s %u %u %2047s", name, &units, &count, genes) != 4)
      continue;
    seed_t *more = realloc(seeds, (seed_count + 1) * sizeof *seeds);
    if (more == NULL) return 0;
    seeds = more;
    seeds[seed_count] = (seed_t){.call = call_named(name), .units = units};
    if (seeds[seed_count].call == NULL ||
        !parse_genes(genes, &seeds[seed_count].genes)) {
      fprintf(stderr, "cost: not understood: %s", line);
      return 0;
    }
    seed_count++;
  }
  return 1;
}

// The genes of all seeds: they mean the same machine and state to every
// function, and what is expensive for one may be so for another.
static genes_t *genes_of_seeds(void) {
  genes_t *of = malloc((seed_count + 1) * sizeof *of);
  for (size_t i = 0; of && i < seed_count; i++) of[i] = seeds[i].genes;
  return of;
}

static int search_units(const call_t *call, unsigned units, long evaluations) {
  genes_t *const from = genes_of_seeds();
  if (from == NULL) return 0;
  const found_t found = search(call, units, from, seed_count, evaluations);
  free(from);
  print_found(call, units, &found);
  return 1;
}

// None, one, half of the most, one less than the most, the most.
static int search_call(const call_t *call, long evaluations) {
  const unsigned most = call->most;
  const unsigned units[] = {0, 1, most / 2, most - 1, most};
  for (int i = 0; i < (call->unit ? 5 : 1); i++)
    if (!search_units(call, units[i], evaluations)) return 0;
  return 1;
}

int main(int argc, char **argv) {
  const long evaluations = argc == 2 ? strtol(argv[1], NULL, 10) : -1;
  if (evaluations < 0) {
    fputs("usage: cost EVALUATIONS <SEEDS\n", stderr);
    return 2;
  }
  int done = read_seeds();
  for (unsigned i = 0; i < call_count && done; i++)
    done = search_call(&calls[i], evaluations);
  free(seeds);
  return !done;
}
