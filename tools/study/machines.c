// How many two-folds machines have: random parameters, each two-fold in closed
// form and its type, counted.
//
//   machines [COUNT [SEED]]     default 1000000 1
//
// m = 1 (the unit of mass). Drawn evenly in the logarithm: d, beta, r0, kappa
// in [0.01, 1] m, mu in [0.01, 1] N, k2 in [0.1, 10] N/m, c1 and c2 in [1e-4,
// 0.1], |omega0| in [0.1, 10] rad/s of either sign; gamma evenly in [-pi, pi].
// Shares hang on these ranges; that a count occurs does not.

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "twofold.h"

#define PI 3.14159265358979323846

typedef struct {
  uint64_t counter;
  uint32_t seed;
} draws_t;

static double uniform(draws_t *draws) {
  uint32_t word[2];
  tf_philox(draws->counter++, draws->seed, word);
  return ((double)word[0] + 0.5) / 4294967296.0;
}

static tf_real_t between(draws_t *draws, double low, double high) {
  return (tf_real_t)(low * pow(high / low, uniform(draws)));
}

static tf_params_t machine_of(draws_t *draws) {
  tf_params_t params = tf_scenes[0]->params;
  params.m = 1;
  params.d = between(draws, 0.01, 1);
  params.beta = between(draws, 0.01, 1);
  params.r0 = between(draws, 0.01, 1);
  params.kappa = between(draws, 0.01, 1);
  params.mu = between(draws, 0.01, 1);
  params.k2 = between(draws, 0.1, 10);
  params.c1 = between(draws, 1e-4, 0.1);
  params.c2 = between(draws, 1e-4, 0.1);
  params.omega0 = between(draws, 0.1, 10);
  if (uniform(draws) < 0.5) {
    params.omega0 = -params.omega0;
  }
  params.gamma = (tf_real_t)(PI * (2 * uniform(draws) - 1));
  return params;
}

int main(int argc, char *argv[]) {
  const unsigned long count = argc > 1 ? strtoul(argv[1], NULL, 10) : 1000000;
  draws_t draws = {0, argc > 2 ? (uint32_t)strtoul(argv[2], NULL, 10) : 1};
  unsigned long folds[TF_TWO_FOLDS + 1] = {0};
  unsigned long first[TF_TWO_FOLDS + 1] = {0};
  for (unsigned long i = 0; i < count; i++) {
    const tf_params_t params = machine_of(&draws);
    tf_machine_t machine;
    tf_surface_point_t places[TF_TWO_FOLDS];
    int found = 0, of_case_1 = 0;
    if (tf_prepare(&machine, &params, NULL) != TF_OK) {
      continue;
    }
    const tf_input_t input = tf_input_default(&machine);
    if (tf_two_folds(&machine, &input, places, &found, NULL) != TF_OK) {
      continue;
    }
    for (int j = 0; j < found; j++) {
      tf_two_fold_t form;
      of_case_1 +=
          tf_normal_form(&machine, &input, &places[j], &form) == TF_OK &&
          form.paper_case == 1;
    }
    folds[found]++;
    first[of_case_1]++;
  }
  (void)printf("%lu machines\nnumber  have so many two-folds  of case 1\n",
               count);
  for (int i = 0; i <= TF_TWO_FOLDS; i++) {
    (void)printf("%6d  %22lu  %9lu\n", i, folds[i], first[i]);
  }
  return 0;
}
