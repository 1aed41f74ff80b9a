// Soak: chaos under the rule `random` for very many steps, and a replay.
//   soak STEPS          (as 1e9 or 1000000000)
// A snapshot is taken halfway, as a plain copy of the state. The second half is
// then stepped again from it: the trail of all its bits must be the same. By
// tf_step, and in float by tf_step_compensated too: plain steps of a float come
// to stand where dt v is below the rounding of r (DESIGN.md, section 11).
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/host/host.h"
#include "cli/setup/setup.h"
#include "verify/fuzz/fuzz.h"

#define MIN_STEPS 1000.0
#define MAX_STEPS 1e15
#define RATE TF_R(10.0) // of leaving an open stick [1/s]
#define SEED 2014u
#define LONGEST_STAY 5.0 // in one mode [s]: it sticks for 2, rests for 0.1

typedef struct {
  tf_compensated_t machine;
  tf_input_t input;
  tf_state_t state;
  bool compensated;               // by tf_step_compensated
  tf_compensation_t compensation; // else 0
  uint64_t trail;                 // of the bits of all states so far
  // Steps that broke a promise.
  uint64_t refused, not_finite, drifted, miscounted;
  // What happened.
  uint64_t modes[TF_MODES], degraded, open;
  uint64_t changed, stay; // last change of the mode, most steps without one
  double drift;           // largest |h| in stick, in its rounding
} soak_t;

// What |h| is off by in stick: its terms are known to a rounding each.
static double rounding(const soak_t *s) {
  const tf_state_t *x = &s->state;
  const double z = fabs((double)x->w) + fabs((double)s->input.omega0);
  const double reach = fabs((double)s->machine.machine.d) + fabs((double)x->r);
  return (double)TF_REAL_EPSILON * (fabs((double)x->v) + reach * z);
}

static tf_status_t advance(soak_t *s, tf_report_t *report) {
  return s->compensated
             ? tf_step_compensated(&s->machine, &s->state, &s->compensation,
                                   &s->input, report)
             : tf_step(&s->machine.machine, &s->state, &s->input, report);
}

static uint64_t mix(uint64_t trail, tf_real_t x) {
  uint64_t bits = 0;
  memcpy(&bits, &x, sizeof x);
  trail = (trail ^ bits) * UINT64_C(0x9E3779B97F4A7C15);
  return trail ^ trail >> 29;
}

static void judge(soak_t *s, const tf_report_t *report, uint64_t step,
                  double before) {
  const tf_state_t *x = &s->state;
  if (!fuzz_finite(x->r) || !fuzz_finite(x->v) || !fuzz_finite(x->w) ||
      !fuzz_finite(report->force.F) || !fuzz_finite(report->force.M) ||
      !fuzz_finite(report->slip.h) || !fuzz_finite(report->slip.g) ||
      !fuzz_finite(report->delassus) || !fuzz_finite(report->residual))
    s->not_finite++;
  if (x->tick != step || report->choices != fuzz_popcount(report->set) ||
      x->mode >= TF_MODES || report->mode != x->mode || x->seed != SEED ||
      (report->status == TF_OK && !(report->set & TF_MODE_BIT(x->mode)))) {
    s->miscounted++;
    return;
  }
  s->modes[x->mode]++;
  s->degraded += report->status == TF_DEGRADED;
  s->open += report->choices > 1;
  if (tf_mode_is_slip(x->mode)) return;
  // The bound of `stick_is_exact`: rounding on both sides of the step.
  const double drift = fabs((double)report->slip.h) / (before + rounding(s));
  if (drift > s->drift) s->drift = drift;
  if (!(drift <= 1)) s->drifted++;
}

static void step_through(soak_t *s, uint64_t from, uint64_t to) {
  for (uint64_t step = from + 1; step <= to; step++) {
    tf_report_t report;
    const double before = rounding(s);
    const unsigned mode = s->state.mode;
    if (advance(s, &report) < 0) {
      s->refused++;
      return; // it would be refused again and again
    }
    judge(s, &report, step, before);
    if (s->state.mode != mode) s->changed = step;
    if (step - s->changed > s->stay) s->stay = step - s->changed;
    s->trail = mix(s->trail, s->state.r);
    s->trail = mix(s->trail, s->state.v);
    s->trail = mix(s->trail, s->state.w) + s->state.mode;
  }
}

static int start(soak_t *s, bool compensated) {
  const tf_scene_t *scene = tf_scenes[0];
  tf_params_t params = scene->params;
  tf_simulation_t simulation;
  params.rule = TF_RULE_RANDOM;
  params.rate = RATE;
  memset(s, 0, sizeof *s);
  s->compensated = compensated;
  if (tf_simulation_open(&simulation, scene, &params, SEED) != TF_OK ||
      tf_prepare_compensated(&s->machine, &params, NULL) != TF_OK)
    return 0;
  s->state = simulation.state;
  s->input = tf_simulation_input(&simulation, scene);
  return 1;
}

static int passed, failed;

static void tell(int ok, const char *what, double figure) {
  *(ok ? &passed : &failed) += 1;
  printf("%-6s %s: %.6g\n", ok ? "ok" : "FAILED", what, figure);
}

static int soak(uint64_t steps, bool compensated) {
  static soak_t s, again;
  const uint64_t half = steps / 2;
  const bool is_float = sizeof(tf_real_t) == 4;
  const double began = cli_now();
  if (!start(&s, compensated) || !start(&again, compensated)) return 0;
  step_through(&s, 0, half);
  memcpy(&again.state, &s.state, sizeof s.state);
  memcpy(&again.compensation, &s.compensation, sizeof s.compensation);
  again.trail = s.trail;
  step_through(&s, half, steps);
  step_through(&again, half, steps);

  printf("chaos, rule random, %s: %.6g steps in %.1f s, half of them twice\n",
         compensated ? "compensated"
         : is_float  ? "float"
                     : "double",
         (double)steps, cli_now() - began);
  printf("# with a choice: %.6g; degraded: %.6g\n", (double)s.open,
         (double)s.degraded);
  tell(s.refused == 0, "steps refused", (double)s.refused);
  tell(s.not_finite == 0, "steps with what is not finite",
       (double)s.not_finite);
  tell(s.drifted == 0, "largest |h| in stick over its rounding", s.drift);
  tell(s.miscounted == 0 && s.state.tick == steps,
       "steps whose counters disagree", (double)s.miscounted);
  tell(s.open > 0 && s.modes[TF_STICK_PLUS] > 0 && s.modes[TF_STICK_MINUS] > 0,
       "steps with a choice, of sticks of both signs", (double)s.open);
  const double stay = (double)s.stay * (double)s.machine.machine.dt;
  if (compensated || !is_float)
    tell(stay <= LONGEST_STAY, "longest stay in a mode [s]", stay);
  tell(again.trail == s.trail && again.state.tick == steps &&
           memcmp(&again.state, &s.state, sizeof s.state) == 0 &&
           memcmp(&again.compensation, &s.compensation,
                  sizeof s.compensation) == 0,
       "steps replayed from the snapshot, bit for bit", (double)(steps - half));
  return 1;
}

int main(int argc, char *argv[]) {
  char *end = NULL;
  const double number = argc == 2 ? strtod(argv[1], &end) : 0;
  if (!(number >= MIN_STEPS && number <= MAX_STEPS) || *end != '\0') {
    (void)fprintf(stderr, "usage: soak STEPS, 1e3 to 1e15\n");
    return 2;
  }
  const uint64_t steps = (uint64_t)number;
  if (!soak(steps, false)) return 3;
  if (sizeof(tf_real_t) == 4 && !soak(steps, true)) return 3;
  printf("%d passed, %d failed\n", passed, failed);
  return failed > 0;
}
