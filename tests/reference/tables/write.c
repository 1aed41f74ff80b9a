// Writes tests/data/reference.h and its parts.
#include <string.h>

#include "tables.h"

static const char *const mode_names[] = {"slip+",  "slip-",  "stick+",
                                         "stick-", "pinned", ""};
static const char *const event_names[REF_EVENTS] = {
    "cross", "enter", "leave", "roll", "h=g=0", "two-fold"};

// 25 digits: more than a long double holds.
static void number(FILE *out, const char *before, ref_real_t value,
                   const char *after) {
  char text[64];
  quadmath_snprintf(text, sizeof text, "%.24Qe", value);
  fprintf(out, "%s%sL%s", before, text, after);
}

static void row(FILE *out, const char *before, const row_t *x,
                const char *after) {
  number(out, before, x->t, ", ");
  number(out, "", x->r, ",\n");
  number(out, "   ", x->v, ", ");
  number(out, "", x->w, after);
}

void write_index(FILE *out) {
  fputs(
      "/* Reference solutions, made by `make oracle`, not by hand: by the"
      " solver of\n"
      " * tests/reference in quadruple precision, every switch located, from"
      " the\n"
      " * paper's equations without a line of the core. 25 digits; the"
      " uncertainty is\n"
      " * the largest difference from a computation at a tolerance 1000 times"
      " looser.\n"
      " * SI units; modes as the core names them. */\n"
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
  for (int i = 0; i < PROBLEMS; i++)
    fprintf(out, "#include \"reference_%s.h\"\n", problems[i].name);
  fprintf(out,
          "\n#define REFERENCES %d\n"
          "static const reference_t *const references[REFERENCES] = {\n",
          (int)PROBLEMS);
  for (int i = 0; i < PROBLEMS; i++)
    fprintf(out, "    &reference_%s,\n", problems[i].name);
  fputs("};\n\n#endif\n", out);
}

// Parameters as they are given, filled into lines.
static void parameters(FILE *out, const problem_t *problem) {
  int column = 80;
  for (int i = 0; i < PARAMETERS; i++) {
    const char *text = problem_parameter(problem, parameter_names[i]);
    if (!text) continue;
    char entry[96];
    const int length =
        snprintf(entry, sizeof entry, ".%s = %s%sL,", parameter_names[i], text,
                 strpbrk(text, ".e") ? "" : ".0");
    if (column + length >= 79) {
      fputs(i ? "\n    " : "    ", out);
      column = 3;
    }
    fprintf(out, " %s", entry);
    column += length + 1;
  }
  fputc('\n', out);
}

static void head(FILE *out, const problem_t *p, const course_t *c,
                 const uncertainty_t *looser) {
  fprintf(out,
          "static const reference_t reference_%s = {\n"
          "     .name = \"%s\", .law = \"%s\", .begins = \"%s\",\n"
          "     .ends = \"%s\",\n",
          p->name, p->name, p->law_name, mode_names[c->begins],
          c->stop == REF_REACHED ? "its length is over"
                                 : "two-fold: the future is not unique");
  parameters(out, p);
  number(out, "     .h = ", c->h, ",\n");
  row(out, "     .start = {", &c->start, "},\n");
  fprintf(out, "     .t_grid = %s%sL,", p->t_grid,
          strpbrk(p->t_grid, ".") ? "" : ".0");
  number(out, " .t_last = ", c->last.t, ",\n");
  fprintf(out, "     .state_uncertainty = %.1e, .time_uncertainty = %.1e,\n",
          (double)looser->state, (double)looser->time);
  for (int i = 0; i < p->knots; i++)
    fprintf(out, "%s{%s.0L, %s.0L}%s",
            i ? ",\n              " : "     .knot = {", p->knot[i][0],
            p->knot[i][1], i + 1 == p->knots ? "},\n" : "");
  fprintf(out, "     .knots = %d, .states = %d, .events = %d,\n", p->knots,
          c->states, c->events);
  fprintf(out, "     .state = %s_states, .event = %s_events};\n", p->name,
          p->name);
}

void write_problem(FILE *out, const problem_t *problem, const course_t *course,
                   const uncertainty_t *looser) {
  const char *name = problem->name;
  fputs(
      "/* Part of reference.h, which says what this is. */\n"
      "/* clang-format off */\n",
      out);
  fprintf(out, "static const reference_state_t %s_states[] = {\n", name);
  for (int i = 0; i < course->states; i++)
    row(out, "  {", &course->grid[i], "},\n");
  fprintf(out, "};\nstatic const reference_event_t %s_events[] = {\n", name);
  for (int i = 0; i < course->events; i++) {
    const switch_t *e = &course->event[i];
    fprintf(out, "  {\"%s\", \"%s\", \"%s\",\n", mode_names[e->before],
            mode_names[e->after], event_names[e->how]);
    row(out, "  {", &e->at, "}},\n");
  }
  if (course->events == 0)
    fputs("  {\"\", \"\", \"\", {0.0L, 0.0L, 0.0L, 0.0L}} /* none */\n", out);
  fputs("};\n", out);
  head(out, problem, course, looser);
}
