// What every single step of a run costs.
//
//   cost time SCHEME PART STEPS     one line a step: ns, the least of several
//                                   batches of the same step from a saved state
//   cost count SCHEME PART STEPS    for callgrind, which dumps its counter
//                                   after every call of `sample`; a line a step
//   cost end SCHEME PART STEPS      bits of the end state
//   cost machine SCHEME PART STEPS  the prepared machine as C, for a build that
//                                   has it as a constant (specialised)
//
// One step is far shorter than a clock resolves, so it is taken many times over
// from a copy of its state: caches and branch prediction are warm.
#define _POSIX_C_SOURCE 200809L

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/report/part.h"
#include "bench/steps/timing.h"
#include "board/constants/constants.h"

#define BATCHES 9
#define BATCH 60

// In a specialised build the sources of the core precede this file, in one
// translation unit, with the machine as a constant; REPORT_SPECIAL is the
// function that steps.
#ifdef REPORT_SPECIAL
__attribute__((noinline, flatten)) static tf_status_t sample(run_t *run) {
  const tf_status_t status = REPORT_SPECIAL(
      &special_machine, SPECIAL_STATE(run), &run->input, &run->report);
#else
__attribute__((noinline)) static tf_status_t sample(run_t *run) {
  const tf_status_t status = part_step(run);
#endif
  __asm__ volatile("" ::: "memory"); // a tail call would leave the frame
  return status;
}

static void time_step(const run_t *before, run_t *run) {
  double least = 1;
  for (int i = 0; i < BATCHES; i++) {
    const double begin = timing_wall();
    for (int j = 0; j < BATCH; j++) {
      run->state = before->state;
      run->compensation = before->compensation;
      sample(run);
    }
    const double time = (timing_wall() - begin) / BATCH;
    if (time < least) least = time;
  }
  printf("%.1f\n", 1e9 * least);
}

static int follow(run_t *run, long steps, int times) {
  for (long i = 0; i < steps; i++) {
    const run_t before = *run;
    if (times) time_step(&before, run);
    if (!times && sample(run) < 0) return 1;
    if (!times)
      printf("%s %s\n", tf_mode_name(before.state.mode),
             tf_mode_name(run->state.mode));
  }
  return 0;
}

static int print_end(run_t *run, long steps) {
  for (long i = 0; i < steps; i++)
    if (sample(run) < 0) return 1;
  printf("%a %a %a %s, %a %a %a\n", (double)run->state.r, (double)run->state.v,
         (double)run->state.w, tf_mode_name(run->state.mode),
         (double)run->compensation.r, (double)run->compensation.v,
         (double)run->compensation.w);
  return 0;
}

static void print_machine(const run_t *run) {
  const tf_compensated_t *k = &run->machine;
  if (run->scheme != COMPENSATED) {
    puts("#define SPECIAL_STATE(run) &run->state");
    puts("static const tf_machine_t special_machine = {");
    constants_of_machine(stdout, &k->machine);
    puts("};");
    return;
  }
  puts("#define SPECIAL_STATE(run) &run->state, &run->compensation");
  puts("static const tf_compensated_t special_machine = {.machine = {");
  constants_of_machine(stdout, &k->machine);
  printf("},\n  .low_sin_gamma = (tf_real_t)%a,\n", (double)k->low_sin_gamma);
  printf("  .low_cos_gamma = (tf_real_t)%a,\n", (double)k->low_cos_gamma);
  printf("  .low_inertia = (tf_real_t)%a};\n", (double)k->low_inertia);
}

static int begin_run(run_t *run, char **argv) {
  const long steps = strtol(argv[4], NULL, 10);
  int scheme = 0, part = 0;
  truth_state_t start;
  while (scheme < SCHEMES && strcmp(argv[2], scheme_names[scheme]) != 0)
    scheme++;
  while (part < PARTS && strcmp(argv[3], parts[part].name) != 0) part++;
  return scheme < SCHEMES && part < PARTS && steps > 0 &&
         truth_state(parts[part].problem, parts[part].from, &start) &&
         part_begin(run, &parts[part], &start, (scheme_t)scheme, steps, 1e-8) ==
             TF_OK;
}

int main(int argc, char **argv) {
  run_t run;
  const char *const what = argc == 5 ? argv[1] : "";
  if (argc != 5 || !begin_run(&run, argv)) {
    fputs("usage: cost time|count|end|machine SCHEME PART STEPS\n", stderr);
    return 2;
  }
  const long steps = strtol(argv[4], NULL, 10);
  if (strcmp(what, "time") == 0) return follow(&run, steps, 1);
  if (strcmp(what, "count") == 0) return follow(&run, steps, 0);
  if (strcmp(what, "end") == 0) return print_end(&run, steps);
  if (strcmp(what, "machine") == 0) {
    print_machine(&run);
    return 0;
  }
  return 2;
}
