/// @file
/// Class (g): extreme machines whose end state is wrong with all steps OK,
/// among them those with a slip shorter than the step.
#include <math.h>

#include "classes.h"

static const runs_t runs = {1, 2, {1e-4, 1e-5}, "", NULL};

typedef struct {
  real_t last, shortest; ///< time of the last event, shortest slip [s]
  bool open;             ///< h = g = 0 was passed, or the start has a choice
} slips_t;

static void on_event(const ref_orbit_t *orbit, ref_event_t event) {
  slips_t *slips = orbit->context;
  if (event == REF_ENTERS || event == REF_CROSSES) {
    slips->shortest = fminl(slips->shortest, orbit->x.t - slips->last);
  }
  slips->open = slips->open || event == REF_CODIM2;
  slips->last = orbit->x.t;
}

static count_t *judged, *brief, *wrong[RUNS], *warned[RUNS], *impulsive[RUNS];

static void begin(void) {
  judged = count_add(false, "judged: the reference is sure of the end");
  brief = count_add(false, "of them a slip shorter than 1e-5 s");
  for (int k = 0; k < runs_count(&runs); ++k) {
    wrong[k] = count_run(&runs, k, true, "10 % off, all OK");
    warned[k] = count_run(&runs, k, false, "10 % off, some not OK or refused");
    impulsive[k] = count_run(&runs, k, false, "short slip: 10 % off, all OK");
  }
}

// End of the motion at two tolerances; false where they part, where the point
// h = g = 0 is passed or the motion is too fast for the smaller step.
static bool sure(const trial_t *trial, ref_machine_t *q, ref_orbit_t *orbit,
                 slips_t *slips) {
  const real_t end = (real_t)trial->t_end;
  *slips = (slips_t){.shortest = end};
  *orbit = class_orbit(&trial->machine, q, &lib_f64);
  slips->open = orbit->consistent.count > 1;
  orbit->watch = on_event;
  orbit->context = slips;
  orbit->limit = 300000;
  ref_stop_t coarse;
  const double doubt = class_doubt(orbit, end, &coarse);
  return orbit->stop == REF_REACHED && coarse == REF_REACHED && !slips->open &&
         q->k2 / q->m < 1e6L && doubt < 1e-3;
}

static void judge(trial_t *trial) {
  trial->draw = draw_begin(trial->options->seed, (uint64_t)trial->index);
  trial->machine = draw_machine(&trial->draw, DRAW_EXTREME);
  ref_machine_t q;
  ref_orbit_t orbit;
  slips_t slips;
  const bool is_sure = sure(trial, &q, &orbit, &slips);
  count_try(judged, trial, is_sure);
  if (!is_sure) {
    return;
  }
  const bool is_brief = slips.shortest < 1e-5L;
  count_try(brief, trial, is_brief);
  for (int k = 0; k < runs_count(&runs); ++k) {
    lib_row_t row;
    const long others = trial_run(trial, &runs, k, &row);
    const bool is_off = class_difference(&q, orbit.x, &row) > 0.1;
    count_try(wrong[k], trial, is_off && others == 0);
    count_try(warned[k], trial, is_off && others != 0);
    if (is_brief) {
      count_try(impulsive[k], trial, is_off && others == 0);
    }
  }
}

const class_t class_impulses = {
    "impulses", "(g) impulses shorter than the step", 2000, 0.1, begin, judge,
    NULL};
