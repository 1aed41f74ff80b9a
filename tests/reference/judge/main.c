/// reference COMMAND [OPTION VALUE]...: the options.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "judge.h"

static const command_t *const commands[] = {&command_validate, &command_second,
                                            &command_table};
enum { COMMANDS = sizeof commands / sizeof commands[0] };

static int usage(void) {
  printf(
      "usage: reference second [--machines N] [--seed S] [--first I]\n"
      "  [--t-end T]\n"
      "       reference table [--class A|A8|A'|B|...|L|all] [--dt LIST]\n"
      "  [--machines N] [--seed S] [--show N]; --first I --machines 1 shows "
      "one "
      "case\n");
  for (int i = 0; i < COMMANDS; ++i)
    printf("  %-12s %s\n", commands[i]->name, commands[i]->about);
  return 2;
}

static bool take(options_t *options, const char *name, const char *value) {
  if (strcmp(name, "--machines") == 0)
    options->machines = atol(value);
  else if (strcmp(name, "--seed") == 0)
    options->seed = strtoull(value, NULL, 10);
  else if (strcmp(name, "--first") == 0)
    options->first = atol(value);
  else if (strcmp(name, "--t-end") == 0)
    options->t_end = atof(value);
  else if (strcmp(name, "--show") == 0)
    options->show = atol(value);
  else if (strcmp(name, "--class") == 0)
    options->row = value;
  else if (strcmp(name, "--dt") == 0)
    options->dts = value;
  else
    return false;
  return true;
}

int main(int argc, char **argv) {
  options_t options = {.seed = 1, .show = 2, .row = "all"};
  setvbuf(stdout, NULL, _IOLBF, BUFSIZ);
  const command_t *command = NULL;
  for (int i = 0; argc >= 2 && i < COMMANDS; ++i) {
    if (strcmp(argv[1], commands[i]->name) == 0) {
      command = commands[i];
      options.machines = command->machines;
      options.t_end = command->t_end;
    }
  }
  bool good = command && argc % 2 == 0;
  for (int i = 2; good && i < argc; i += 2) {
    good = take(&options, argv[i], argv[i + 1]);
    if (!good) printf("unknown: %s %s\n", argv[i], argv[i + 1]);
  }
  if (!good) return usage();
  if (command->machines > 0)
    printf("reference %s --machines %ld --seed %llu --first %ld\n", argv[1],
           options.machines, (unsigned long long)options.seed, options.first);
  return command->run(&options);
}
