// Work and precision of every scheme in every part of the motion: one row of
// CSV a setting (`sweep parts`: the parts). The settings are a grid of equal
// ratios, each shifted at random, so that no grid lands on a switch; dials:
//   dt         the step; of LOCATED at the tolerance 1e-8
//   order      the step of LOCATED at a tolerance that never splits it
//   tolerance@1s, @100ms, @20ms, @5ms   of LOCATED, at that step
#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/steps/timing.h"
#include "part.h"

#define RUNS 25 // at most, for the time of one
#define LEAST 3
#define ENOUGH 4e-3 // [s] of runs in a row
#define BISECTIONS 60

typedef struct {
  const char *dial;
  scheme_t scheme;
  long n;
  double tolerance;
} setting_t;

typedef struct {
  double final, worst, event, drift;
  long degraded, fell_back, coarse;
  const char *mark; // ok flagged branch refused
} result_t;

// The reference at the ends of the pieces of a part, and its events.
typedef struct {
  const part_t *part;
  truth_state_t at[17];
  truth_event_t event[TRUTH_EVENTS];
  int events;
} course_t;

static course_t course_of(const part_t *part) {
  course_t c = {.part = part};
  const long double piece = (part->to - part->from) / part->pieces;
  for (int i = 0; i <= part->pieces; i++) {
    if (truth_state(part->problem, part->from + piece * i, &c.at[i])) continue;
    fprintf(stderr, "%s: no reference\n", part->name);
    exit(1);
  }
  c.events = truth_events(part->problem, part->from, part->to, c.event);
  return c;
}

// Changes of mode as a run shows them, at the ends of steps.
typedef struct {
  double t[2 * TRUTH_EVENTS];
  uint8_t after[2 * TRUTH_EVENTS];
  int n;
} changes_t;

// When, in the step that begins at a state, the mode changes: the shortest step
// from there that ends in another mode.
static double located_change(const run_t *before, const part_t *part,
                             uint8_t mode) {
  tf_params_t params;
  truth_params(part->problem, &params);
  double low = 0, high = (double)before->machine.machine.dt;
  for (int i = 0; i < BISECTIONS; i++) {
    run_t run = *before;
    const double dt = 0.5 * (low + high);
    params.dt = (tf_real_t)dt;
    if (tf_prepare(&run.machine.machine, &params, NULL) != TF_OK) break;
    run.machine.machine.tolerance = before->machine.machine.tolerance;
    if (part_step(&run) < 0 || run.state.mode == mode)
      low = dt;
    else
      high = dt;
  }
  return high;
}

static void note_change(changes_t *c, double t, uint8_t before, uint8_t after,
                        double dt) {
  // One step of stick or pinned inside a crossing is the crossing.
  const int last = c->n - 1;
  if (last >= 0 && t - c->t[last] < 1.5 * dt && c->after[last] == before &&
      before > TF_SLIP_MINUS) {
    c->after[last] = after;
    return;
  }
  if (c->n >= 2 * TRUTH_EVENTS) return;
  c->t[c->n] = t;
  c->after[c->n++] = after;
}

// Largest error of the times of events, NaN where their order differs.
static double event_error(const course_t *course, const changes_t *c) {
  double worst = 0;
  if (c->n != course->events) return (double)NAN;
  for (int i = 0; i < c->n; i++) {
    const long double from = course->part->from;
    const double want = (double)(course->event[i].t - from);
    if (c->after[i] != course->event[i].after) return (double)NAN;
    worst = fmax(worst, fabs(c->t[i] - want));
  }
  return c->n ? worst : (double)NAN;
}

// One run, looked at after every step.
static result_t watch(const course_t *course, const setting_t *set) {
  const part_t *part = course->part;
  const double length = (double)(part->to - part->from);
  const double dt = length / (double)set->n;
  result_t out = {.mark = "refused", .final = HUGE_VAL, .event = (double)NAN};
  changes_t changes = {.n = 0};
  run_t run;
  if (part_begin(&run, part, &course->at[0], set->scheme, set->n,
                 set->tolerance) < 0)
    return out;
  for (long i = 0; i < set->n; i++) {
    const run_t before = run;
    const tf_status_t status = part_step(&run);
    if (status < 0) return out;
    out.degraded += status == TF_DEGRADED;
    out.fell_back += status == TF_FELL_BACK;
    out.coarse += status == TF_COARSE;
    const uint8_t mode = run.state.mode;
    if (mode != before.state.mode) {
      const double after =
          set->scheme == LOCATED
              ? located_change(&before, part, before.state.mode)
              : dt;
      note_change(&changes, (double)i * dt + after, before.state.mode, mode,
                  dt);
    }
    if (mode > TF_SLIP_MINUS)
      out.drift = fmax(out.drift, fabs((double)run.report.slip.h));
    if ((i + 1) * part->pieces % set->n == 0)
      out.worst =
          fmax(out.worst,
               part_error(&run, &course->at[(i + 1) * part->pieces / set->n]));
  }
  out.final = part_error(&run, &course->at[part->pieces]);
  out.event = event_error(course, &changes);
  const int flagged = out.degraded + out.fell_back + out.coarse > 0;
  const int lost = !(out.final <= part->border) ||
                   run.state.mode != truth_mode(part->problem, part->to);
  out.mark = lost ? "branch" : flagged ? "flagged" : "ok";
  return out;
}

static volatile tf_real_t sink; // no result, no work

// Median time of a run from nothing: preparation, begin, all steps [ns].
static double time_of(const course_t *course, const setting_t *set) {
  double time[RUNS];
  const double begin = timing_wall();
  double now = begin;
  int n = 0;
  while (n < LEAST || (n < RUNS && now - begin < ENOUGH)) {
    const double start = timing_wall();
    run_t run;
    tf_status_t status = part_begin(&run, course->part, &course->at[0],
                                    set->scheme, set->n, set->tolerance);
    for (long i = 0; i < set->n && status >= 0; i++) status = part_step(&run);
    sink = run.state.r;
    now = timing_wall();
    time[n++] = now - start;
  }
  timing_sort(time, (size_t)n);
  return 1e9 * time[n / 2];
}

static void print_row(const course_t *course, const setting_t *set) {
  const part_t *part = course->part;
  const result_t r = watch(course, set);
  printf("%s,%s,%s,%s,%.4e,%.4e,%ld,%.4e,%.4e,%.4e,%.4e,%.0f,%ld,%ld,%ld,%s\n",
         part->name, scheme_names[set->scheme], REAL, set->dial,
         (double)(part->to - part->from) / (double)set->n, set->tolerance,
         set->n, r.final, r.worst, r.event, r.drift, time_of(course, set),
         r.degraded, r.fell_back, r.coarse, r.mark);
}

// The number of steps nearest to n that has the ends of all pieces on it.
static long whole(const part_t *part, double n) {
  if (n < 4 * part->pieces) return lrint(fmax(n, 1));
  return lrint(n / part->pieces) * part->pieces;
}

// Settings from coarse to fine: numbers of steps, factor `ratio` apart.
static void sweep_steps(const course_t *course, setting_t set, double first,
                        double last, double ratio, unsigned stream) {
  const int settings = 1 + (int)(log(last / first) / log(ratio));
  for (int i = 0; i < settings; i++) {
    const double shift = part_random(stream, (unsigned)i) - 0.5;
    set.n = whole(course->part, first * pow(ratio, i + shift));
    print_row(course, &set);
  }
}

static void sweep_tolerance(const course_t *course, const char *dial, double dt,
                            unsigned stream) {
  const double finest = sizeof(tf_real_t) == 8 ? 2e-14 : 1e-5;
  const double ratio = sizeof(tf_real_t) == 8 ? 2 : 1.4;
  const double length = (double)(course->part->to - course->part->from);
  setting_t set = {dial, LOCATED, 0, 0};
  if (dt > length) return; // the same single step as at a shorter one
  set.n = whole(course->part, length / dt);
  for (int i = 0;; i++) {
    const double shift = part_random(stream, (unsigned)i);
    set.tolerance = 1e-3 * pow(ratio, -i - shift);
    if (set.tolerance < finest) return;
    print_row(course, &set);
  }
}

// The parts: name,text,problem,from,to,border,uncertainty of the reference,its
// source
static void print_parts(void) {
  for (int i = 0; i < PARTS; i++) {
    const part_t *p = &parts[i];
    printf("%s,%s,%s,%g,%g,%g,%.1e,%s\n", p->name, p->text, p->problem,
           (double)p->from, (double)p->to, p->border,
           fmax(truth_uncertainty(p->problem, p->from),
                truth_uncertainty(p->problem, p->to)),
           truth_source(p->problem, p->to));
  }
}

int main(int argc, char **argv) {
  if (argc == 2 && strcmp(argv[1], "parts") == 0) {
    print_parts();
    return 0;
  }
  const int digits = sizeof(tf_real_t) == 8;
  printf(
      "part,scheme,real,dial,dt,tolerance,steps,final,worst,event,drift,ns,"
      "degraded,fell_back,coarse,mark\n");
  for (unsigned i = 0; i < PARTS; i++) {
    const course_t course = course_of(&parts[i]);
    const double length = (double)(parts[i].to - parts[i].from);
    // Steps of 0.1 s and less; Moreau's down to 1e-6 s or 1e-5 of the part.
    const double coarse = fmax(3, length / 0.05);
    const double fine = digits ? fmin(6e5, length / 1e-6) : 1e5;
    sweep_steps(&course, (setting_t){"dt", MOREAU, 0, 1e-8}, coarse, fine, 1.3,
                10 * i);
    sweep_steps(&course, (setting_t){"dt", COMPENSATED, 0, 1e-8}, coarse, fine,
                1.8, 10 * i + 1);
    sweep_steps(&course, (setting_t){"dt", LOCATED, 0, 1e-8},
                fmax(1, length / 0.2), 3000 * sqrt(length), 1.2, 10 * i + 2);
    sweep_steps(&course, (setting_t){"order", LOCATED, 0, 0.1},
                fmax(2, length / 0.1), 1500 * sqrt(length), 1.2, 10 * i + 3);
    sweep_tolerance(&course, "tolerance@1s", 1, 10 * i + 6);
    sweep_tolerance(&course, "tolerance@100ms", 0.1, 10 * i + 4);
    sweep_tolerance(&course, "tolerance@20ms", 0.02, 10 * i + 7);
    sweep_tolerance(&course, "tolerance@5ms", 0.005, 10 * i + 5);
  }
  return 0;
}
