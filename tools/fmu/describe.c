// Prints what an FMU of a scene consists of as JSON: the variables with their
// values at the start, from which package.py makes the model description.
// Usage: describe SCENE

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "variables.h"

static const tf_scene_t *find_scene(const char *name, size_t *index) {
  for (size_t i = 0; i < TF_SCENES; i++) {
    if (strcmp(tf_scenes[i]->name, name) != 0) continue;
    *index = i;
    return tf_scenes[i];
  }
  return NULL;
}

// The shortest decimal that reads back to the same bits.
static void print_number(double value) {
  char text[40];
  for (int digits = 6; digits <= 17; digits++) {
    (void)snprintf(text, sizeof text, "%.*g", digits, value);
    if (strtod(text, NULL) == value) break;
  }
  printf("\"%s\"", text);
}

static void print_members(const fmu_variable_t *variable) {
  printf(", \"members\": [");
  for (int i = 0; variable->members[i] != NULL; i++)
    printf("%s\"%s\"", i > 0 ? ", " : "", variable->members[i]);
  printf("]");
}

static void print_variable(const fmu_variable_t *variable, unsigned reference,
                           double start) {
  static const char *const kinds[] = {"real",  "truth", "member",
                                      "small", "seed",  "count"};
  static const char *const roles[] = {"parameter", "input", "output"};
  static const char *comma = "";
  if (variable->kind == FMU_KIND_UNKNOWN) return;
  printf(
      "%s\n  {\"name\": \"%s\", \"reference\": %u, \"unit\": \"%s\",\n"
      "   \"about\": \"%s\",\n   \"kind\": \"%s\", \"role\": \"%s\", ",
      comma, variable->name, reference, variable->unit, variable->about,
      kinds[variable->kind], roles[variable->role]);
  comma = ",";
  printf("\"low\": ");
  print_number(variable->low);
  printf(", \"high\": ");
  print_number(variable->high);
  printf(", \"start\": ");
  print_number(start);
  if (variable->members != NULL) print_members(variable);
  printf("}");
}

int main(int argc, char *argv[]) {
  fmu_values_t values;
  size_t index = 0;
  const tf_scene_t *scene = argc == 2 ? find_scene(argv[1], &index) : NULL;
  if (scene == NULL) {
    (void)fprintf(stderr, "describe: SCENE must be one of");
    for (size_t i = 0; i < TF_SCENES; i++)
      (void)fprintf(stderr, " %s", tf_scenes[i]->name);
    (void)fprintf(stderr, "\n");
    return 2;
  }
  fmu_defaults(&values, scene);
  printf(
      "{\"scene\": \"%s\", \"index\": %zu, \"shows\": \"%s\",\n"
      " \"version\": \"%s\", \"t_end\": ",
      scene->name, index, scene->shows, TF_VERSION);
  print_number((double)scene->t_end);
  printf(", \"dt\": ");
  print_number((double)scene->params.dt);
  printf(",\n \"statuses\": [");
  for (int status = TF_STEP_TOO_LONG; status <= TF_COARSE; status++)
    printf("%s\"%s\"", status > TF_STEP_TOO_LONG ? ", " : "",
           tf_status_name((tf_status_t)status));
  printf("],\n \"variables\": [");
  for (size_t i = 0; i < FMU_REALS; i++) {
    const fmu_variable_t variable = fmu_real(i);
    print_variable(&variable, FMU_REAL_REFERENCE + (unsigned)i, values.real[i]);
  }
  for (size_t i = 0; i < FMU_WHOLES; i++) {
    const fmu_variable_t variable = fmu_whole(i);
    print_variable(&variable, FMU_WHOLE_REFERENCE + (unsigned)i,
                   (double)values.whole[i]);
  }
  printf("\n]}\n");
  return 0;
}
