/// @file
/// reference CLASS [--machines N] [--seed S] [--first I] [--range R]
/// [--t-end T] [--show N]: counts steps that say OK and are wrong.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "classes.h"

static const struct {
  const char *name;
  int (*run)(const options_t *options);
  long machines;
  const char *about;
} classes[] = {
    {"validate", class_validate, 1,
     "the reference against the paper and tests/data"},
    {"second", class_second, 10, "random machines by a second integration"},
    {"signs", class_signs, 2000, "(a) mode and signs of h and g"},
    {"grid", class_grid, 2000, "(a) the enumeration against a search"},
    {"rest-law", class_rest_law, 2000, "(b) laws of rest that leave no future"},
    {"false-rest", class_false_rest, 2000, "(c) rest where the motion goes on"},
    {"branch", class_branch, 2000, "(d) the future taken at h = g = 0"},
    {"path", class_path, 2000, "(d) ends of motions with one future"},
    {"rounding", class_rounding, 2000, "(e) rest that rounding ends"},
    {"energy", class_energy, 2000, "(f) energy from nothing"},
    {"impulses", class_impulses, 2000, "(g) impulses shorter than the step"},
    {"standing", class_standing, 2000, "(h) standing still"},
};

static int usage(void) {
  printf(
      "usage: reference CLASS [--machines N] [--seed S] [--first I]\n"
      "  [--range wide|edge|extreme] [--t-end T] [--show N]\n"
      "       reference replay --t-end T --set NAME=VALUE...\n"
      "  (what `twofold run chaos` takes to replay an offender)\n");
  for (size_t i = 0; i < sizeof classes / sizeof *classes; ++i) {
    printf("  %-12s %s\n", classes[i].name, classes[i].about);
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
    } else if (strcmp(name, "--set") != 0 && strcmp(name, "--scheme") != 0) {
      return false;
    }
  }
  return argc % 2 == 0;
}

int main(int argc, char **argv) {
  options_t options = {.seed = 1, .show = 2};
  setvbuf(stdout, NULL, _IOLBF, BUFSIZ);
  if (argc < 2) {
    return usage();
  }
  if (strcmp(argv[1], "replay") == 0) {
    return parse(&options, argc, argv) ? class_replay(&options, argc, argv)
                                       : usage();
  }
  for (size_t i = 0; i < sizeof classes / sizeof *classes; ++i) {
    if (strcmp(argv[1], classes[i].name) == 0) {
      options.machines = classes[i].machines;
      if (!parse(&options, argc, argv)) {
        return usage();
      }
      printf("reference %s --machines %ld --seed %llu --first %ld\n", argv[1],
             options.machines, (unsigned long long)options.seed, options.first);
      return classes[i].run(&options);
    }
  }
  return usage();
}
