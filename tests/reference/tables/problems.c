// The problems: the scenes of the core, in decimals of their own, and two
// benchmarks. gamma is -3 pi/4 or pi/2 to all digits. `smooth` and `string` are
// stiff: they are followed for 2.5 s, which takes minutes; `chaos` reaches its
// two-fold at 2.05 s.
#include <string.h>

#include "tables.h"

const char *const parameter_names[PARAMETERS] = {
    "m",     "d",     "beta",    "k2", "c1",    "c2",    "r0",  "omega0", "mu",
    "kappa", "gamma", "epsilon", "k",  "delta", "sigma", "rho", "a"};

static const parameter_t common[] = {
    {"m", "1"},       {"d", "1"},
    {"beta", "0.05"}, {"k2", "2.2270992253886014441"},
    {"c1", "0.001"},  {"c2", "0.001"},
    {"r0", "0.1"},    {"omega0", "-1"},
    {"mu", "1"},      {"gamma", "-2.3561944901923449288469825374596271631479"}};

#define KAPPA \
  { "kappa", "0.27241153714062027818" }
#define PAPER_START .r = "0.18", .omega = "-1.037", .h = "1e-10"

const problem_t problems[PROBLEMS] = {
    {.name = "chaos",
     .law_name = "jump",
     .law = REF_JUMP,
     .parameter = {KAPPA},
     PAPER_START,
     .t_end = "10",
     .t_grid = "2"},
    {.name = "gamma_zero",
     .law_name = "jump",
     .law = REF_JUMP,
     .parameter = {KAPPA, {"gamma", "0"}},
     .r = "0.3",
     .omega = "-0.8",
     .v = "0.1",
     .t_end = "10",
     .t_grid = "10"},
    {.name = "gamma_right",
     .law_name = "jump",
     .law = REF_JUMP,
     .parameter = {KAPPA,
                   {"gamma", "1.5707963267948966192313216916397514420986"}},
     .r = "0.3",
     .omega = "-0.8",
     .v = "0.1",
     .t_end = "10",
     .t_grid = "10"},
    {.name = "coulomb",
     .law_name = "coulomb",
     .law = REF_COULOMB,
     .r = "0.18",
     .omega = "-0.6",
     .h = "0.3",
     .t_end = "10",
     .t_grid = "10"},
    {.name = "frictionless",
     .law_name = "none",
     .law = REF_FREE,
     PAPER_START,
     .t_end = "10",
     .t_grid = "10"},
    {.name = "smooth",
     .law_name = "smooth",
     .law = REF_SMOOTH,
     .parameter = {KAPPA, {"epsilon", "0.0001"}},
     PAPER_START,
     .t_end = "2.5",
     .t_grid = "2.5"},
    {.name = "rolling",
     .law_name = "jump",
     .law = REF_JUMP,
     .parameter = {KAPPA},
     .r = "0.95",
     .omega = "1.3",
     .h = "0",
     .t_end = "10",
     .t_grid = "10"},
    {.name = "string",
     .law_name = "string",
     .law = REF_STRING,
     .parameter = {{"k", "1"},
                   {"delta", "1"},
                   {"sigma", "1"},
                   {"rho", "0.66666666666666666667"},
                   {"a", "1"}},
     PAPER_START,
     .t_end = "2.5",
     .t_grid = "2.5"},
    {.name = "driven",
     .law_name = "jump",
     .law = REF_JUMP,
     .parameter = {KAPPA},
     PAPER_START,
     .t_end = "12",
     .t_grid = "12",
     .knots = 5,
     .knot = {{"0", "-1"}, {"2", "-2"}, {"4", "-2"}, {"8", "1"}, {"10", "0"}}},
    {.name = "crossings",
     .law_name = "jump",
     .law = REF_JUMP,
     .parameter = {KAPPA, {"beta", "0.3"}, {"k2", "30"}, {"mu", "0.2"}},
     .r = "0.6",
     .omega = "0.5",
     .h = "-0.01",
     .t_end = "2",
     .t_grid = "2"},
    {.name = "stickslip",
     .law_name = "jump",
     .law = REF_JUMP,
     .parameter = {KAPPA, {"beta", "0.2"}, {"k2", "20"}, {"mu", "3"}},
     .r = "0.5",
     .omega = "-0.8",
     .h = "-0.01",
     .t_end = "2",
     .t_grid = "2"}};

const char *problem_parameter(const problem_t *problem, const char *name) {
  for (int i = 0; i < PARAMETERS && problem->parameter[i].name; i++)
    if (!strcmp(problem->parameter[i].name, name))
      return problem->parameter[i].value;
  for (size_t i = 0; i < sizeof common / sizeof common[0]; i++)
    if (!strcmp(common[i].name, name)) return common[i].value;
  return NULL;
}

ref_real_t quad_of(const char *text) {
  return text ? strtoflt128(text, NULL) : 0;
}

static ref_real_t number(const problem_t *problem, const char *name) {
  return quad_of(problem_parameter(problem, name));
}

void problem_machine(const problem_t *problem, ref_machine_t *q,
                     ref_ramps_t *ramps) {
  ref_real_t *const member[PARAMETERS] = {
      &q->m,  &q->d,      &q->beta,  &q->k2,    &q->c1,    &q->c2,
      &q->r0, &q->omega0, &q->mu,    &q->kappa, &q->gamma, &q->epsilon,
      &q->k,  &q->delta,  &q->sigma, &q->rho,   &q->a};
  ref_knot_t knots[KNOTS];
  for (int i = 0; i < PARAMETERS; i++)
    *member[i] = number(problem, parameter_names[i]);
  for (int i = 0; i < problem->knots; i++)
    knots[i] = (ref_knot_t){.t = quad_of(problem->knot[i][0]),
                            .omega0 = quad_of(problem->knot[i][1])};
  ref_ramps(ramps, knots, problem->knots);
  q->law = problem->law;
  q->inputs = problem->knots ? &ramps->inputs : NULL;
  ref_prepare(q);
}
