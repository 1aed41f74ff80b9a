/// @file
/// reference CLASS [--machines N] [--seed S] [--first I] [--range R]
/// [--t-end T] [--show N]: counts steps that say OK and are wrong.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "classes.h"

static const class_t *const classes[] = {
    &class_validate, &class_second,     &class_signs,    &class_grid,
    &class_rest_law, &class_false_rest, &class_branch,   &class_path,
    &class_rounding, &class_energy,     &class_impulses, &class_standing,
    &class_replay};
enum { CLASSES = sizeof classes / sizeof *classes };

static int usage(void) {
  printf(
      "usage: reference CLASS [--machines N] [--seed S] [--first I]\n"
      "  [--range wide|edge|extreme] [--t-end T] [--show N]\n"
      "       reference replay --t-end T --set NAME=VALUE...\n"
      "  (what `twofold run chaos` takes to replay an offender)\n");
  for (int i = 0; i < CLASSES; ++i) {
    if (classes[i]->about) {
      printf("  %-12s %s\n", classes[i]->name, classes[i]->about);
    }
  }
  return 2;
}

static bool parse(options_t *options, int argc, char **argv) {
  for (int i = 2; i + 1 < argc; i += 2) {
    const char *name = argv[i], *value = argv[i + 1];
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
    } else if (strcmp(name, "--range") == 0) {
      options->range = value[0] == 'w'                      ? DRAW_WIDE
                       : value[0] == 'e' && value[1] == 'd' ? DRAW_EDGE
                                                            : DRAW_EXTREME;
    } else if (strcmp(name, "--set") == 0) {
      if (!draw_set(&options->machine, value)) {
        printf("unknown: %s\n", value);
        exit(2);
      }
    } else if (strcmp(name, "--scheme") != 0) {
      return false;
    }
  }
  return argc % 2 == 0;
}

int main(int argc, char **argv) {
  options_t options = {.seed = 1, .show = 2, .machine = replay_machine};
  setvbuf(stdout, NULL, _IOLBF, BUFSIZ);
  const class_t *class = NULL;
  for (int i = 0; argc >= 2 && i < CLASSES; ++i) {
    if (strcmp(argv[1], classes[i]->name) == 0) {
      class = classes[i];
      options.machines = class->machines;
    }
  }
  if (!class || !parse(&options, argc, argv)) {
    return usage();
  }
  if (class->about) {
    printf("reference %s --machines %ld --seed %llu --first %ld\n", argv[1],
           options.machines, (unsigned long long)options.seed, options.first);
  }
  return class_run(class, &options);
}
