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
#include "verify/cost/calls.h"
#include "verify/cost/search.h"

#define LINE 2048

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

static void search_call(const call_t *call, long evaluations) {
  for (unsigned i = 0; i < call->kinds; i++) {
    const unsigned units = call->units[i];
    const found_t found = search(call, units, seeds, seed_count, evaluations);
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
