/// @file
/// reference CLASS [--machines N] [--seed S] [--first I] [--t-end T]
/// [--show N]: counts steps that say OK and are wrong.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "classes.h"

static const class_t *const classes[] = {
    &class_validate, &class_second, &class_branch, &class_energy, &class_table};
enum { CLASSES = sizeof classes / sizeof classes[0] };

static int usage(void) {
  printf(
      "usage: reference CLASS [--machines N] [--seed S] [--first I]\n"
      "  [--t-end T] [--show N]\n"
      "       reference table [--class A|A8|A'|B|...|K|all] [--dt LIST]\n"
      "  [--jobs N] [--machines N] [--seed S] [--show N]; --first I --machines "
      "1\n"
      "  shows one case\n");
  for (int i = 0; i < CLASSES; ++i) {
    printf("  %-12s %s\n", classes[i]->name, classes[i]->about);
  }
  return 2;
}

static bool take(options_t *options, const char *name, const char *value) {
  if (strcmp(name, "--machines") == 0) {
    options->machines = atol(value);
  } else if (strcmp(name, "--seed") == 0) {
    options->seed = strtoull(value, NULL, 10);
  } else if (strcmp(name, "--first") == 0) {
    options->first = atol(value);
  } else if (strcmp(name, "--t-end") == 0) {
    options->t_end = atof(value);
  } else if (strcmp(name, "--show") == 0) {
    options->show = atol(value);
  } else if (strcmp(name, "--class") == 0) {
    options->row = value;
  } else if (strcmp(name, "--dt") == 0) {
    options->dts = value;
  } else if (strcmp(name, "--jobs") == 0) {
    options->jobs = atol(value);
  } else {
    return false;
  }
  return true;
}

int main(int argc, char **argv) {
  options_t options = {.seed = 1, .show = 2, .row = "all", .jobs = 2};
  setvbuf(stdout, NULL, _IOLBF, BUFSIZ);
  const class_t *class = NULL;
  for (int i = 0; argc >= 2 && i < CLASSES; ++i) {
    if (strcmp(argv[1], classes[i]->name) == 0) {
      class = classes[i];
      options.machines = class->machines;
    }
  }
  bool good = class && argc % 2 == 0;
  for (int i = 2; good && i < argc; i += 2) {
    good = take(&options, argv[i], argv[i + 1]);
    if (!good) {
      printf("unknown: %s %s\n", argv[i], argv[i + 1]);
    }
  }
  if (!good) {
    return usage();
  }
  if (class->judge) {
    printf("reference %s --machines %ld --seed %llu --first %ld\n", argv[1],
           options.machines, (unsigned long long)options.seed, options.first);
  }
  return class_run(class, &options);
}
