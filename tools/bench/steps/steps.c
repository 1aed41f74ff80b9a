// Runs scene chaos for callgrind, which counts instructions.
//
//   steps all|rk4-all    every step once: the sum over the run is the figure
//   steps some|rk4-some  callgrind dumps its counter after every call of
//                        `sample`; one line "before after" (modes) for each
//
// Sampled are every 200th step, every change of mode, steps near g = 0, where
// both signs of g have to be looked at, and steps of slip, which are rare: the
// dear ones. So the median of a phase means something, that of all would not.
#include "chaos.h"

#define STEPS 100000
#define EVERY 200
#define NEAR TF_R(5e-4)
#define MOST 400 // samples near g = 0, and as many of slip

static tf_report_t reported;

__attribute__((noinline)) static void sample(const chaos_t *c,
                                             tf_state_t *state) {
  tf_step(&c->machine, state, &c->input, &reported);
  __asm__ volatile("" ::: "memory"); // a tail call would leave the frame
}

__attribute__((noinline)) static void sample_rk4(const chaos_t *c,
                                                 rk4_state_t *state) {
  rk4_smooth_step(&c->smooth, state);
  __asm__ volatile("" ::: "memory");
}

static void all_twofold(const chaos_t *c) {
  tf_state_t state = c->start;
  for (int i = 0; i < STEPS; i++) {
    tf_step(&c->machine, &state, &c->input, &reported);
  }
}

static void some_twofold(const chaos_t *c) {
  tf_state_t state = c->start;
  int near = 0, slips = 0;
  for (int i = 0; i < STEPS; i++) {
    const tf_state_t before = state;
    tf_step(&c->machine, &state, &c->input, &reported);
    const tf_real_t g = reported.slip.g;
    const int close = g < NEAR && g > -NEAR && near < MOST;
    const int changed = before.mode != state.mode;
    const int slip = before.mode <= TF_SLIP_MINUS && slips < MOST;
    if (i % EVERY != 0 && !changed && !close && !slip) continue;
    near += close;
    slips += slip;
    state = before;
    sample(c, &state);
    printf("%s %s\n", tf_mode_name(before.mode), tf_mode_name(state.mode));
  }
}

static void all_rk4(const chaos_t *c) {
  rk4_state_t state = c->smooth_start;
  for (int i = 0; i < STEPS; i++) rk4_smooth_step(&c->smooth, &state);
}

static void some_rk4(const chaos_t *c) {
  rk4_state_t state = c->smooth_start;
  for (int i = 0; i < STEPS; i++) {
    if (i % EVERY != 0) {
      rk4_smooth_step(&c->smooth, &state);
      continue;
    }
    sample_rk4(c, &state);
    puts("rk4 rk4");
  }
}

int main(int argc, char **argv) {
  static const struct {
    const char *name;
    void (*run)(const chaos_t *c);
  } runs[] = {{"all", all_twofold},
              {"some", some_twofold},
              {"rk4-all", all_rk4},
              {"rk4-some", some_rk4}};
  const chaos_t c = chaos_begin();
  for (size_t i = 0; i < sizeof runs / sizeof *runs; i++) {
    if (argc == 2 && strcmp(argv[1], runs[i].name) == 0) {
      runs[i].run(&c);
      return 0;
    }
  }
  fputs("usage: steps all|some|rk4-all|rk4-some\n", stderr);
  return 2;
}
