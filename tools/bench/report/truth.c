// The reference: tests/data/reference.h (quadruple precision, two integrators)
// where it has a state, and the long double orbit of tests/support between its
// states of `chaos`.
#include "truth.h"

#include <math.h>
#include <string.h>

#include "../../../tests/data/reference.h"
#include "../../../tests/support/orbit.h"

// The orbit is as accurate as long double permits; its header says 1e-15.
#define ORBIT_UNCERTAINTY 1e-15
#define ORBIT_LAST 2.0462L // [s], before the two-fold

static const reference_t *find(const char *problem) {
  for (int i = 0; i < REFERENCES; i++)
    if (strcmp(references[i]->name, problem) == 0) return references[i];
  return NULL;
}

int truth_params(const char *problem, tf_params_t *params) {
  const reference_t *ref = find(problem);
  if (!ref || strcmp(ref->law, "jump") != 0) return 0;
  *params = tf_scenes[0]->params;
  const struct {
    tf_real_t *to;
    long double from;
  } list[] = {{&params->m, ref->m},         {&params->d, ref->d},
              {&params->beta, ref->beta},   {&params->k2, ref->k2},
              {&params->c1, ref->c1},       {&params->c2, ref->c2},
              {&params->r0, ref->r0},       {&params->omega0, ref->omega0},
              {&params->mu, ref->mu},       {&params->kappa, ref->kappa},
              {&params->gamma, ref->gamma}, {NULL, 0}};
  for (int i = 0; list[i].to; i++) *list[i].to = (tf_real_t)list[i].from;
  params->law = TF_TYRE_JUMP;
  params->rule = TF_RULE_PERSIST;
  return 1;
}

static int in_table(const reference_t *ref, long double t,
                    truth_state_t *state) {
  const reference_state_t *at = NULL;
  if (t == 0) at = &ref->start;
  for (int i = 0; i < ref->states; i++)
    if (fabsl(ref->state[i].t - t) < 1e-12L) at = &ref->state[i];
  if (!at) return 0;
  *state = (truth_state_t){{at->r, at->v, at->w}};
  return 1;
}

int truth_state(const char *problem, long double t, truth_state_t *state) {
  const reference_t *ref = find(problem);
  if (!ref) return 0;
  if (in_table(ref, t, state)) return 1;
  if (strcmp(problem, "chaos") != 0 || t < 0 || t > ORBIT_LAST) return 0;
  orbit_chaos_state(t, state->x);
  return 1;
}

long double truth_start_slip(const char *problem) {
  const reference_t *ref = find(problem);
  return ref ? ref->h : 0;
}

int truth_twofold(const char *problem, truth_state_t *state) {
  const reference_t *ref = find(problem);
  for (int i = 0; ref && i < ref->events; i++) {
    const reference_event_t *e = &ref->event[i];
    if (strcmp(e->how, "two-fold") != 0) continue;
    *state = (truth_state_t){{e->at.r, e->at.v, e->at.w}};
    return 1;
  }
  return 0;
}

static uint8_t mode_of(const char *name) {
  uint8_t mode = 0;
  while (mode < TF_MODES && strcmp(name, tf_mode_name(mode)) != 0) mode++;
  return mode;
}

uint8_t truth_mode(const char *problem, long double t) {
  const reference_t *ref = find(problem);
  if (!ref) return TF_NO_MODE;
  uint8_t mode = mode_of(ref->begins);
  for (int i = 0; i < ref->events && ref->event[i].at.t <= t; i++)
    mode = mode_of(ref->event[i].after);
  return mode;
}

int truth_events(const char *problem, long double from, long double to,
                 truth_event_t events[TRUTH_EVENTS]) {
  const reference_t *ref = find(problem);
  int n = 0;
  for (int i = 0; ref && i < ref->events && n < TRUTH_EVENTS; i++) {
    const reference_event_t *e = &ref->event[i];
    if (e->at.t <= from || e->at.t > to || !strcmp(e->before, e->after))
      continue;
    events[n++] = (truth_event_t){e->at.t, mode_of(e->after)};
  }
  return n;
}

double truth_uncertainty(const char *problem, long double t) {
  const reference_t *ref = find(problem);
  truth_state_t state;
  if (!ref) return HUGE_VAL;
  return in_table(ref, t, &state) ? ref->state_uncertainty : ORBIT_UNCERTAINTY;
}

const char *truth_source(const char *problem, long double t) {
  const reference_t *ref = find(problem);
  truth_state_t state;
  return ref && in_table(ref, t, &state)
             ? "tests/data/reference.h (quadruple precision)"
             : "tests/support/orbit.c (long double)";
}
