// Prints what an FMU of a scene consists of as JSON: the variables with their
// values at the start, from which package.py makes the model description.
// Usage: describe SCENE, a name or a file

#include <stdio.h>

#include "cli/setup/scene_file.h"
#include "cli/setup/setup.h"
#include "cli/text/text.h"
#include "fmu.h"

static void print_number(const char *name, double value) {
  char text[CLI_REAL_ROOM];
  (void)decimal_write(text, value, false);
  printf(", \"%s\": \"%s\"", name, text);
}

static void print_members(const fmu_variable_t *variable) {
  printf(", \"members\": [");
  const unsigned last = (unsigned)(variable->high - variable->low);
  for (unsigned i = 0; i <= last; i++)
    printf("%s\"%s\"", i > 0 ? ", " : "", variable->member(i));
  printf("]");
}

static void print_variable(unsigned reference, double start) {
  static const char *const kinds[] = {"real",  "truth", "member",
                                      "small", "seed",  "count"};
  static const char *const roles[] = {"parameter", "input", "output"};
  const fmu_variable_t variable = fmu_variable(reference);
  const bool is_told = variable.about[0] != '\0';
  printf(
      "%s\n  {\"name\": \"%s\", \"reference\": %u, \"unit\": \"%s\",\n"
      "   \"about\": \"%s\",\n   \"kind\": \"%s\", \"role\": \"%s\"",
      reference > 1 ? "," : "", variable.name, reference, variable.unit,
      is_told ? variable.about : cli_parameter_about[reference - 1],
      kinds[variable.kind], roles[variable.role]);
  print_number("low", variable.low);
  print_number("high", variable.high);
  print_number("start", start);
  if (variable.member != NULL) print_members(&variable);
  printf("}");
}

int main(int argc, char *argv[]) {
  double values[FMU_VARIABLES];
  const tf_scene_t *scene = NULL;
  if (argc != 2) {
    (void)fprintf(stderr, "usage: describe SCENE\n");
    return 2;
  }
  const int code = cli_take_scene(&scene, argv[1]);
  if (code != 0) return code;
  fmu_defaults(values, scene);
  printf(
      "{\"scene\": \"%s\", \"shows\": \"%s\",\n"
      " \"version\": \"%s\"",
      scene->name, scene->shows, TF_VERSION);
  print_number("t_end", (double)scene->t_end);
  print_number("dt", (double)scene->params.dt);
  printf(",\n \"statuses\": [");
  for (int status = TF_STEP_TOO_LONG; status <= TF_STALLED; status++)
    printf("%s\"%s\"", status > TF_STEP_TOO_LONG ? ", " : "",
           tf_status_name((tf_status_t)status));
  printf("],\n \"variables\": [");
  for (unsigned i = 1; i < FMU_VARIABLES; i++) print_variable(i, values[i]);
  printf("\n]}\n");
  return 0;
}
