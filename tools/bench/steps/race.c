// Time of a step against time of a smoothed Runge-Kutta step, in turns in the
// same run, so that a machine that slows down slows both. Prints
//   state BYTES / step NS / rk4 NS / ratio MEDIAN LOW HIGH / apart T METRES
// where `apart` says how far the two trajectories are from each other at T:
// they are the same motion up to the smoothing, or the race would be void.
#define _POSIX_C_SOURCE 200809L

#include "chaos.h"
#include "timing.h"

#define ROUNDS 41
#define BATCH 100000 // steps: 10 s of motion, all its phases
#define APART 10000  // steps: 1 s, before the two-fold ends the comparison

static volatile tf_real_t sink; // no result, no work

static double time_twofold(const chaos_t *c) {
  tf_state_t state = c->start;
  tf_report_t report;
  const double begin = timing_wall();
  for (int i = 0; i < BATCH; i++) {
    tf_step(&c->machine, &state, &c->input, &report);
  }
  sink = state.r;
  return (timing_wall() - begin) / BATCH;
}

static double time_rk4(const chaos_t *c) {
  rk4_state_t state = c->smooth_start;
  const double begin = timing_wall();
  for (int i = 0; i < BATCH; i++) rk4_smooth_step(&c->smooth, &state);
  sink = state.r;
  return (timing_wall() - begin) / BATCH;
}

static void print_apart(const chaos_t *c) {
  tf_state_t state = c->start;
  tf_report_t report;
  rk4_state_t smooth = c->smooth_start;
  for (int i = 0; i < APART; i++) {
    tf_step(&c->machine, &state, &c->input, &report);
    rk4_smooth_step(&c->smooth, &smooth);
  }
  const double t = APART * (double)c->machine.dt;
  const double apart = (double)state.r - (double)smooth.r;
  printf("apart %g %.2g\n", t, apart < 0 ? -apart : apart);
}

int main(void) {
  const chaos_t c = chaos_begin();
  double step[ROUNDS], rk4[ROUNDS], ratio[ROUNDS];
  time_twofold(&c); // warms up
  time_rk4(&c);
  for (int i = 0; i < ROUNDS; i++) {
    step[i] = time_twofold(&c);
    rk4[i] = time_rk4(&c);
    ratio[i] = rk4[i] / step[i];
  }
  timing_sort(step, ROUNDS);
  timing_sort(rk4, ROUNDS);
  timing_sort(ratio, ROUNDS);
  printf("state %zu\n", sizeof(tf_state_t));
  printf("step %.1f\n", 1e9 * step[ROUNDS / 2]);
  printf("rk4 %.1f\n", 1e9 * rk4[ROUNDS / 2]);
  printf("ratio %.2f %.2f %.2f\n", ratio[ROUNDS / 2], ratio[ROUNDS / 10],
         ratio[ROUNDS - 1 - ROUNDS / 10]);
  print_apart(&c);
  return 0;
}
