// See write.h. One value a line: 80 columns do not hold two.
#include "write.h"

#include <string.h>

// 31 digits and the suffix of a long double.
static void number(FILE *out, const char *before, real value,
                   const char *after) {
  char text[64];
  quadmath_snprintf(text, sizeof text, "%.30Qe", value);
  fprintf(out, "%s%sL%s", before, text, after);
}

static void exact(FILE *out, const char *name, const char *text) {
  const int whole = !strpbrk(text, ".e");
  fprintf(out, "     .%s = %s%sL,\n", name, text, whole ? ".0" : "");
}

static void state(FILE *out, const state_t *x, const char *before,
                  const char *after) {
  number(out, before, x->t, ",\n");
  number(out, "      ", x->r, ",\n");
  number(out, "      ", x->v, ",\n");
  number(out, "      ", x->w, after);
}

void write_index(FILE *out, const problem_t list[], int n) {
  fputs(
      "/* Reference solutions. Made by `make oracle` (tests/reference/oracle), "
      "not by"
      " hand: in\n"
      " * quadruple precision, every switch located, under the rule"
      " `persist`, from the\n"
      " * paper's equations without a line of the core. Numbers have 31"
      " digits; the\n"
      " * uncertainties are the largest differences from two more computations,"
      " one with the\n"
      " * same extrapolation at a tolerance 1000 times looser, one by"
      " Gauss-Legendre\n"
      " * collocation. SI units; modes as the core names them. */\n"
      "/* clang-format off */\n"
      "#ifndef TESTS_DATA_REFERENCE_H\n"
      "#define TESTS_DATA_REFERENCE_H\n\n"
      "typedef struct {\n"
      "  long double t, r, v, w; /* [s], [m], [m/s], [rad/s] */\n"
      "} reference_state_t;\n\n"
      "/* r, v and w are continuous: before is after. At h = g = 0 and at a"
      " two-fold\n"
      " * several modes may be consistent; `after` is \"\" where none is"
      " chosen. */\n"
      "typedef struct {\n"
      "  const char *before, *after;\n"
      "  const char *how; /* cross enter leave roll h=g=0 two-fold */\n"
      "  reference_state_t at;\n"
      "} reference_event_t;\n\n"
      "/* A parameter that the law does not need is 0. States stand at i/16"
      " of t_grid,\n"
      " * i = 1 ... states; events up to t_last, where the reference ends"
      " because of\n"
      " * `ends`. */\n"
      "typedef struct {\n"
      "  const char *name, *law, *begins, *ends;\n"
      "  long double m, d, beta, k2, c1, c2, r0, omega0, mu, kappa, gamma;\n"
      "  long double epsilon, k, delta, sigma, rho, a;\n"
      "  long double h; /* at the start; v follows from it */\n"
      "  reference_state_t start;\n"
      "  long double t_grid, t_last;\n"
      "  double state_uncertainty, time_uncertainty;\n"
      "  int knots; /* of the turntable's speed, linear in between */\n"
      "  long double knot[8][2]; /* [s], [rad/s] */\n"
      "  int states, events;\n"
      "  const reference_state_t *state;\n"
      "  const reference_event_t *event;\n"
      "} reference_t;\n\n",
      out);
  for (int i = 0; i < n; i++)
    fprintf(out, "#include \"reference_%s.h\"\n", list[i].name);
  fprintf(out, "\n#define REFERENCES %d\n", n);
  fputs("static const reference_t *const references[REFERENCES] = {\n", out);
  for (int i = 0; i < n; i++)
    fprintf(out, "    &reference_%s,\n", list[i].name);
  fputs("};\n\n#endif\n", out);
}

static void write_states(FILE *out, const result_t *result) {
  const course_t *c = &result->course;
  fprintf(out, "static const reference_state_t %s_states[] = {\n",
          result->problem->name);
  for (int i = 0; i < c->states; i++) state(out, &c->grid[i], "    {", "},\n");
  fputs("};\n", out);
}

static void write_events(FILE *out, const result_t *result) {
  const course_t *c = &result->course;
  fprintf(out, "static const reference_event_t %s_events[] = {\n",
          result->problem->name);
  for (int i = 0; i < c->events; i++) {
    const event_t *e = &c->event[i];
    fprintf(out, "    {\"%s\", \"%s\", \"%s\",\n", contact_names[e->before],
            e->after < 0 ? "" : contact_names[e->after], e->how);
    state(out, &e->at, "     {", "}},\n");
  }
  if (c->events == 0)
    fputs("    {\"\", \"\", \"\", {0.0L, 0.0L, 0.0L, 0.0L}} /* none */\n", out);
  fputs("};\n", out);
}

static void write_uncertainty(FILE *out, const char *what,
                              const uncertainty_t *d) {
  fprintf(out, " *   %s: states %.1e, times of events %.1e s%s\n", what,
          (double)d->state, (double)d->time, d->agree ? "" : ", OTHER EVENTS");
}

static void write_row(FILE *out, const result_t *result) {
  const problem_t *p = result->problem;
  const course_t *c = &result->course;
  real h = 0;
  fprintf(out, "static const reference_t reference_%s = {\n", p->name);
  fprintf(out, "     .name = \"%s\", .law = \"%s\", .begins = \"%s\",\n",
          p->name, p->law_name, contact_names[c->begins]);
  fprintf(out, "     .ends = \"%s\",\n", c->ends);
  for (int i = 0; i < PARAMETERS; i++) {
    const char *text = problem_parameter(p, parameter_names[i]);
    if (text) exact(out, parameter_names[i], text);
  }
  if (p->h) {
    h = strtoflt128(p->h, NULL);
  } else {
    machine_t k;
    problem_machine(p, &k);
    const real z = c->start.w - k.omega0;
    h = -(c->start.v - k.d * z) * k.s - c->start.r * z * k.c;
  }
  number(out, "     .h = ", h, ",\n");
  state(out, &c->start, "     .start = {", "},\n");
  exact(out, "t_grid", p->t_grid);
  number(out, "     .t_last = ", c->last.t, ",\n");
  fprintf(out, "     .state_uncertainty = %.1e, .time_uncertainty = %.1e,\n",
          (double)bigger(result->looser.state, result->other.state),
          (double)bigger(result->looser.time, result->other.time));
  if (p->knots) fprintf(out, "     .knots = %d, .knot = {", p->knots);
  for (int i = 0; i < p->knots; i++)
    fprintf(out, "%s{%s.0L, %s.0L}", i ? ",\n      " : "", p->knot[i][0],
            p->knot[i][1]);
  if (p->knots) fputs("},\n", out);
  fprintf(out, "     .states = %d, .state = %s_states,\n", c->states, p->name);
  fprintf(out, "     .events = %d, .event = %s_events};\n", c->events, p->name);
}

void write_problem(FILE *out, const result_t *result) {
  const char *name = result->problem->name;
  fputs(
      "/* Made by `make oracle`; part of reference.h, which says what this"
      " is.\n"
      " * Differences from\n",
      out);
  write_uncertainty(out, "a looser tolerance", &result->looser);
  write_uncertainty(out, "collocation", &result->other);
  fputs(" */\n/* clang-format off */\n", out);
  fprintf(out, "#ifndef TESTS_DATA_REFERENCE_%s_H\n", name);
  fprintf(out, "#define TESTS_DATA_REFERENCE_%s_H\n\n", name);
  write_states(out, result);
  write_events(out, result);
  write_row(out, result);
  fputs("\n#endif\n", out);
}
