// Four problems near scene `chaos`: one passes h = g = 0, where the motion is
// not unique, one crosses h = 0 again and again from slip to slip, one sticks
// again and again, and one does so on a turntable whose speed moves.
//
// A wheel that stays pinned at h = g = 0 ends 0.0126 away from the reference of
// the first: an error above half of it counts as another branch. The other
// branches were not followed to the end. The other problems have one solution;
// a run that is 0.5 off has met other switches.
#include "problem.h"

#include <math.h>
#include <string.h>

#include "solutions.h"

static tf_params_t chaos_params(void) {
  int i = 0;
  while (i < TF_SCENES - 1 && strcmp(tf_scenes[i]->name, "chaos") != 0) i++;
  return tf_scenes[i]->params;
}

problem_t problem_number(int i) {
  problem_t p = {.name = "chaos",
                 .params = chaos_params(),
                 .r = 0.18,
                 .omega = -1.037,
                 .h = 1e-10,
                 .side = 1,
                 .t_end = 1,
                 .end = REFERENCE_CHAOS,
                 .branch_error = 6e-3};
  if (i == 0) return p;
  p.branch_error = 0.5;
  p.side = -1;
  p.h = -0.01;
  p.t_end = 2;
  if (i >= 2) {
    p.name = "stickslip";
    p.params.beta = 0.2;
    p.params.k2 = 20;
    p.params.mu = 3;
    p.r = 0.5;
    p.omega = -0.8;
    memcpy(p.end, (const double[3])REFERENCE_STICKSLIP, sizeof p.end);
  }
  if (i == 3) {
    p.name = "driven";
    p.alpha = 1; // it reverses
    memcpy(p.end, (const double[3])REFERENCE_DRIVEN, sizeof p.end);
  }
  if (i >= 2) return p;
  p.name = "crossings";
  p.params.beta = 0.3;
  p.params.k2 = 30;
  p.params.mu = 0.2;
  p.r = 0.6;
  p.omega = 0.5;
  memcpy(p.end, (const double[3])REFERENCE_CROSSINGS, sizeof p.end);
  return p;
}

double problem_speed(const problem_t *problem) {
  const tf_params_t *p = &problem->params;
  const double z = problem->omega - p->omega0;
  return p->d * z -
         (problem->h + problem->r * z * cos(p->gamma)) / sin(p->gamma);
}

double problem_error(const problem_t *problem, const double x[3]) {
  double error = 0;
  for (int i = 0; i < 3; i++) {
    const double e = fabs(x[i] - problem->end[i]);
    if (!(e <= error)) error = e; // takes what is not a number, too
    if (isnan(error)) return HUGE_VAL;
  }
  return error;
}
