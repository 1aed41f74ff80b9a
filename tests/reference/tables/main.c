// Computes the reference problems in quadruple precision and writes
// tests/data/reference.h to standard output, in minutes.
#include <stdio.h>
#include <stdlib.h>

#include "problems.h"

enum { EVENTS = 400 };

typedef struct {
  ref_real_t t, r, v, w;
} row_t;

typedef struct {
  row_t kept[REF_KEPT];
  ref_mode_t begins;
  int states, events;
  ref_real_t time[EVENTS];
  ref_mode_t after[EVENTS]; // REF_MODES: the motion is not unique any more
} course_t;

static row_t row_of(const ref_machine_t *q, ref_state_t x) {
  return (row_t){x.t, x.r, ref_v(q, x), ref_w(q, x)};
}

static void note(const ref_orbit_t *orbit, ref_event_t event) {
  course_t *out = orbit->context;
  if (out->events == EVENTS) exit(EXIT_FAILURE);
  out->time[out->events] = event == REF_CODIM2 ? orbit->at.t : orbit->x.t;
  out->after[out->events++] =
      orbit->stop == REF_REACHED ? orbit->mode : REF_MODES;
}

// Each sixteenth is a stop, kept or not: the digits hang on it.
static void follow(const ref_problem_t *problem, course_t *out) {
  static const int quarters[REF_KEPT] = {4, 8, 12, 16};
  const int *kept = problem->kept[0] ? problem->kept : quarters;
  ref_machine_t q = problem->machine;
  ref_orbit_t orbit = {.tolerance = (ref_real_t)1e-30L,
                       .law = REF_HEXAGON,
                       .limit = 2000000000,
                       .watch = note,
                       .context = out};
  ref_prepare(&q);
  ref_begin(&orbit, &q, ref_problem_start(problem, &q), REF_MODES);
  out->begins = orbit.mode;
  for (int i = 1; i <= REF_SIXTEENTHS; i++) {
    ref_run(&orbit, problem->t_grid * i / REF_SIXTEENTHS);
    if (out->states < REF_KEPT && kept[out->states] == i)
      out->kept[out->states++] = row_of(&q, orbit.x);
  }
  if (problem->t_events > 0) ref_run(&orbit, problem->t_events);
}

static const char *const mode_names[] = {"slip+",  "slip-",  "stick+",
                                         "stick-", "pinned", ""};

// 25 digits: more than a long double holds.
static void number(const char *before, ref_real_t value, const char *after) {
  char text[64];
  quadmath_snprintf(text, sizeof text, "%.24Qe", value);
  printf("%s%sL%s", before, text, after);
}

static void row(const char *before, const row_t *x, const char *after) {
  number(before, x->t, ", ");
  number("", x->r, ",\n");
  number("   ", x->v, ", ");
  number("", x->w, after);
}

static void write_rows(const char *name, const course_t *course) {
  printf("\nstatic const reference_state_t %s_states[] = {\n", name);
  for (int i = 0; i < course->states; i++) row("  {", &course->kept[i], "},\n");
  printf("};\nstatic const reference_event_t %s_events[] = {\n", name);
  for (int i = 0; i < course->events; i++) {
    printf("  {\"%s\", ", mode_names[course->after[i]]);
    number("", course->time[i], "},\n");
  }
  if (course->events == 0) puts("  {\"\", 0.0L} /* none */");
  puts("};");
}

int main(void) {
  static course_t course[REF_PROBLEMS];
  puts(
      "/* Reference solutions, made by `make oracle`, not by hand: by the"
      " solver of\n"
      " * tests/reference in quadruple precision, every switch located, from"
      " the\n"
      " * paper's equations without a line of the core. 25 digits. SI units;"
      " modes as\n"
      " * the core names them. */\n"
      "/* clang-format off */\n"
      "#ifndef TESTS_DATA_REFERENCE_H\n"
      "#define TESTS_DATA_REFERENCE_H\n\n"
      "#include \"../reference/problems.h\"");
  for (int i = 0; i < REF_PROBLEMS; i++) {
    follow(&ref_problems[i], &course[i]);
    write_rows(ref_problems[i].name, &course[i]);
  }
  puts("\nstatic const reference_t references[REF_PROBLEMS] = {");
  for (int i = 0; i < REF_PROBLEMS; i++) {
    const char *name = ref_problems[i].name;
    printf("  {&ref_problems[%d], \"%s\", %d, %d, %s_states, %s_events},\n", i,
           mode_names[course[i].begins], course[i].states, course[i].events,
           name, name);
  }
  puts("};\n\n#endif");
  return fflush(stdout) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
