// Instructions of every public function, the most that a search finds:
//
//   cost EVALUATIONS <SEEDS   lines "name units count genes"
//   cost constants <SEEDS     steps, by class or budget, as board.c takes them
//
// Genes are spelled "index:hex,..." ("-": all 0); SEEDS are lines as they are
// printed, read for their genes. EVALUATIONS are calls a function and number of
// units. Nothing is random that the arguments do not tell.
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "board/constants/constants.h"
#include "verify/cost/subject.h"

#define LINE 2048
#define BEST 32

typedef struct {
  uint32_t count;
  genes_t genes;
} found_t;

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

// Those of every seed mean the same machine and state to every function, and
// what is expensive for one may be so for another.
static genes_t *seeds;
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
  char line[LINE], genes[LINE];
  while (fgets(line, sizeof line, stdin)) {
    genes_t *more = realloc(seeds, (seed_count + 1) * sizeof *seeds);
    if (more == NULL) return 0;
    seeds = more;
    if (sscanf(line, "tf_%*s %*u %*u %2047s", genes) != 1 ||
        !parse_genes(genes, &seeds[seed_count++])) {
      fprintf(stderr, "cost: not understood: %s", line);
      return 0;
    }
  }
  return 1;
}

// Instructions of one call; 0 where the genes spell no valid machine.
static uint32_t count_of(const call_t *call, unsigned units,
                         const genes_t *genes) {
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

// Tries `evaluations` genes, times the call's weight: at random, then by
// changing the best of them, and the seeds. Genes that do not matter are 0 in
// the end. A quarter of the trials are at random, the others mix two of the
// best or change one of them by a few genes, and go on from what is no better
// but not worse: the count is a staircase, and its plateaus are walked along.
static found_t search(const call_t *call, unsigned units, long evaluations) {
  dice_t dice = {UINT64_C(0x9e3779b97f4a7c15)};
  found_t best[BEST];
  memset(best, 0, sizeof best);
  for (size_t i = 0; i < seed_count; i++) {
    const found_t one = {count_of(call, units, &seeds[i]), seeds[i]};
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

static void search_call(const call_t *call, long evaluations) {
  for (unsigned i = 0; i < call->kinds; i++) {
    const unsigned units = call->units[i];
    const found_t found = search(call, units, evaluations);
    print_found(call, units, &found);
  }
}

static void print_state(const char *name, const tf_state_t *x) {
  printf("  .%s = {.r = %a, .v = %a, .w = %a, .seed = %" PRIu32
         "u, .tick = %" PRIu64 "u, .mode = %d},\n",
         name, (double)x->r, (double)x->v, (double)x->w, x->seed, x->tick,
         x->mode);
}

// A call and what it ends with.
static void print_constants(const call_t *call, unsigned units,
                            const genes_t *genes) {
  const bool located = strcmp(call->name, "step_located") == 0;
  subject_t s = subject_of(genes);
  tf_machine_t *k = &s.machine.machine;
  const tf_input_t *u = &s.input;
  tf_report_t report = {0};
  if (located) k->segments = (uint16_t)units;
  printf("{ // tf_%s %u\n  .step = tf_%s,\n  .machine = {\n", call->name, units,
         call->name);
  constants_of_machine(stdout, k);
  printf("},\n  .input = {%a, %a, %a, %a, %a},\n", (double)u->omega0,
         (double)u->r0, (double)u->force, (double)u->torque, (double)u->alpha);
  print_state("state", &s.state);
  (void)(located ? tf_step_located : tf_step)(k, &s.state, u, &report);
  print_state("end", &s.state);
  puts("},");
}

// What all seeds are to a function of several kinds.
static void print_kinds(const call_t *call) {
  for (size_t i = 0; i < seed_count; i++)
    for (unsigned j = 0; j < call->kinds && call->kinds > 1; j++)
      if (count_of(call, call->units[j], &seeds[i]) > 0)
        print_constants(call, call->units[j], &seeds[i]);
}

int main(int argc, char **argv) {
  const bool constants = argc == 2 && strcmp(argv[1], "constants") == 0;
  const long evaluations = argc == 2 ? strtol(argv[1], NULL, 10) : -1;
  if (evaluations < 0) {
    fputs("usage: cost EVALUATIONS|constants <SEEDS\n", stderr);
    return 2;
  }
  const int done = read_seeds();
  for (unsigned i = 0; i < call_count && done; i++) {
    if (constants)
      print_kinds(&calls[i]);
    else
      search_call(&calls[i], evaluations);
  }
  free(seeds);
  return !done;
}
