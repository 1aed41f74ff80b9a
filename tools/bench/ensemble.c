// Throughput of tf_ensemble_step against a loop of tf_step over the same
// states, in turns in the same run. Prints for each ensemble and round a line
//   NAME,step [ns],ensemble [ns],alone
// both times for one step of one state, `alone` the share of lanes that left
// the common path. The ensembles:
//   spread   one motion of scene chaos at N times of its 10 s, shuffled: every
//            block has all phases of the motion in it
//   seeds    N seeds of rule `random`, 3 s after one common start
// The two ways have to end in the same bits, or the race would be void.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "own.h"

#define N 256     // states and reports of both ways stay within 64 KiB
#define STEPS 100 // a round, short enough that few are interrupted
#define ROUNDS 201
#define LONG 10000       // steps for the share of lanes
#define STRIDE 97        // prime to N
#define SPREAD_STEPS 390 // N times that is 10 s
#define SEEDS_STEPS 30000

typedef struct {
  run_t chaos;
  tf_machine_t machine;
  tf_state_t start[N], states[N];
  tf_report_t reports[N];
  tf_state_block_t state_blocks[TF_BLOCKS(N)];
  tf_report_block_t report_blocks[TF_BLOCKS(N)];
} ensemble_t;

static ensemble_t ensemble;

static void advance(ensemble_t *e, tf_state_t *x, int steps) {
  tf_report_t report;
  for (int i = 0; i < steps; i++)
    tf_step(&e->machine, x, &e->chaos.input, &report);
}

static void begin_spread(ensemble_t *e) {
  tf_state_t x = e->chaos.motion.state;
  for (size_t i = 0; i < N; i++) {
    e->start[i * STRIDE % N] = x;
    advance(e, &x, SPREAD_STEPS);
  }
}

static void begin_seeds(ensemble_t *e) {
  e->machine.contact.rule = TF_RULE_RANDOM;
  for (size_t i = 0; i < N; i++) {
    e->start[i] = e->chaos.motion.state;
    e->start[i].seed = (uint32_t)i;
    advance(e, &e->start[i], SEEDS_STEPS);
  }
}

// [ns] of a step of a state, since a time of the processor.
static double since(clock_t begin) {
  return 1e9 * (double)(clock() - begin) / CLOCKS_PER_SEC / STEPS / N;
}

static double time_steps(ensemble_t *e) {
  memcpy(e->states, e->start, sizeof e->states);
  const clock_t begin = clock();
  for (int n = 0; n < STEPS; n++)
    for (size_t i = 0; i < N; i++)
      tf_step(&e->machine, &e->states[i], &e->chaos.input, &e->reports[i]);
  return since(begin);
}

// Returns how many lanes left the common path.
static size_t run_ensemble(ensemble_t *e, int steps) {
  size_t alone = 0;
  for (int n = 0; n < steps; n++)
    alone += tf_ensemble_step(&e->machine, e->state_blocks, N, &e->chaos.input,
                              e->report_blocks);
  return alone;
}

static void begin_ensemble(ensemble_t *e) {
  for (size_t i = 0; i < N; i++)
    tf_ensemble_put(e->state_blocks, i, &e->start[i]);
}

static double time_ensemble(ensemble_t *e) {
  begin_ensemble(e);
  const clock_t begin = clock();
  run_ensemble(e, STEPS);
  return since(begin);
}

static double share_alone(ensemble_t *e) {
  begin_ensemble(e);
  const size_t alone = run_ensemble(e, LONG);
  return (double)alone / LONG / N;
}

static void compare(const ensemble_t *e) {
  for (size_t i = 0; i < N; i++) {
    const tf_state_t x = tf_ensemble_get(e->state_blocks, i);
    const tf_state_t *y = &e->states[i];
    const tf_real_t a[3] = {x.r, x.v, x.w}, b[3] = {y->r, y->v, y->w};
    if (memcmp(a, b, sizeof a) == 0 && x.mode == y->mode && x.tick == y->tick)
      continue;
    fputs("ensemble and single steps end in different states\n", stderr);
    exit(1);
  }
}

static void race(const char *name, ensemble_t *e) {
  time_steps(e); // warms up
  time_ensemble(e);
  compare(e);
  const double alone = share_alone(e);
  for (int i = 0; i < ROUNDS; i++) {
    const double step = time_steps(e);
    printf("%s,%.2f,%.2f,%.6f\n", name, step, time_ensemble(e), alone);
  }
}

int ensemble_main(void) {
  const problem_t problem = problem_number(0);
  run_t *chaos = &ensemble.chaos;
  if (run_begin(chaos, &problem, MOTION_MOREAU, 10000, 0, 0) != TF_OK) return 1;
  ensemble.machine = chaos->motion.machine.machine;
  begin_spread(&ensemble);
  race("spread", &ensemble);
  begin_seeds(&ensemble);
  race("seeds", &ensemble);
  return 0;
}
