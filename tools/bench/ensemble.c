// Throughput of tf_ensemble_run against a loop of tf_step over the same
// states, in turns in the same run. Prints for each ensemble and round a line
//   NAME,step [ns],ensemble [ns],alone
// both times for one step of one state, `alone` the share of lanes that left
// the common path. The ensembles:
//   spread   one motion of scene chaos at N times of its 10 s, shuffled: every
//            block has all phases of the motion in it
//   seeds    N seeds of rule `random`, 3 s after one common start
// `ensemble N`: instead, for each round the time of N states of the first kind.
// The two ways have to end in the same bits, or the race would be void.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "harness.h"

#define N 256 // states and reports of both ways stay within 64 KiB
#define MOST 1000000
#define STEPS 100 // a round, short enough that few are interrupted
#define ROUNDS 201
#define LONG 10000       // steps for the share of lanes
#define STRIDE 97        // prime to N
#define SPREAD_STEPS 390 // N times that is 10 s
#define SEEDS_STEPS 30000

typedef struct {
  tf_machine_t machine;
  tf_input_t input;
  tf_state_t begin;
  tf_state_t start[N], states[N];
  tf_report_t reports[N];
  tf_state_block_t blocks[TF_BLOCKS(MOST)];
  tf_report_block_t report_blocks[TF_BLOCKS(MOST)];
} ensemble_t;

static ensemble_t ensemble;

static void advance(ensemble_t *e, tf_state_t *x, int steps) {
  tf_report_t report;
  for (int i = 0; i < steps; i++) tf_step(&e->machine, x, &e->input, &report);
}

static void begin_spread(ensemble_t *e) {
  tf_state_t x = e->begin;
  for (size_t i = 0; i < N; i++) {
    e->start[i * STRIDE % N] = x;
    advance(e, &x, SPREAD_STEPS);
  }
}

static void begin_seeds(ensemble_t *e) {
  e->machine.contact.rule = TF_RULE_RANDOM;
  for (size_t i = 0; i < N; i++) {
    e->start[i] = e->begin;
    e->start[i].seed = (uint32_t)i;
    advance(e, &e->start[i], SEEDS_STEPS);
  }
}

// [ns] of a step of a state of n, since a time of the processor.
static double since(clock_t begin, size_t n) {
  return 1e9 * (double)(clock() - begin) / CLOCKS_PER_SEC / STEPS / (double)n;
}

static double time_steps(ensemble_t *e) {
  memcpy(e->states, e->start, sizeof e->states);
  const clock_t begin = clock();
  for (int n = 0; n < STEPS; n++)
    for (size_t i = 0; i < N; i++)
      tf_step(&e->machine, &e->states[i], &e->input, &e->reports[i]);
  return since(begin, N);
}

// Of n states, copies of those. alone: out, the share of lanes that left the
// common path.
static double time_ensemble(ensemble_t *e, size_t n, uint32_t steps,
                            double *alone) {
  for (size_t i = 0; i < n; i++)
    tf_ensemble_put(e->blocks, i, &e->start[i % N]);
  const clock_t begin = clock();
  const size_t lanes = tf_ensemble_run(&e->machine, e->blocks, n, &e->input,
                                       steps, e->report_blocks);
  const double time = since(begin, n);
  *alone = (double)lanes / steps / (double)n;
  return time;
}

static void compare(const ensemble_t *e) {
  for (size_t i = 0; i < N; i++) {
    const tf_state_t x = tf_ensemble_get(e->blocks, i);
    const tf_state_t *y = &e->states[i];
    const tf_real_t a[3] = {x.r, x.v, x.w}, b[3] = {y->r, y->v, y->w};
    if (memcmp(a, b, sizeof a) == 0 && x.mode == y->mode && x.tick == y->tick)
      continue;
    fputs("ensemble and single steps end in different states\n", stderr);
    exit(1);
  }
}

static void race(const char *name, ensemble_t *e) {
  double alone, other;
  time_steps(e); // warms up
  time_ensemble(e, N, STEPS, &alone);
  compare(e);
  time_ensemble(e, N, LONG, &alone);
  for (int i = 0; i < ROUNDS; i++) {
    const double step = time_steps(e);
    printf("%s,%.2f,%.2f,%.6f\n", name, step,
           time_ensemble(e, N, STEPS, &other), alone);
  }
}

int ensemble_main(size_t many) {
  const tf_scene_t *chaos = tf_scenes[0];
  ensemble_t *e = &ensemble;
  if (many > MOST || tf_prepare(&e->machine, &chaos->params, NULL) != TF_OK)
    return 2;
  e->input = tf_input_default(&e->machine);
  e->machine.contact.rule = TF_RULE_PERSIST;
  tf_scene_start(chaos, &e->machine, 0, &e->begin, e->reports);
  begin_spread(e);
  double alone;
  for (size_t i = 0; many > 0 && i < 5 + (size_t)ROUNDS * N / many; i++)
    printf("%.2f\n", time_ensemble(e, many, STEPS, &alone));
  if (many > 0) return 0;
  race("spread", e);
  begin_seeds(e);
  race("seeds", e);
  return 0;
}
