// The program that measures, one for each real type: `bench COMMAND ...`, as
// the file of each command says.
#include <stdio.h>
#include <string.h>

#include "own.h"

#define COMMAND(name) {#name, name##_main},

int main(int argc, char **argv) {
  static const struct {
    const char *name;
    int (*run)(int argc, char **argv);
  } commands[] = {BENCH_COMMANDS(COMMAND)};
  int code = 2;
  for (size_t i = 0; i < sizeof commands / sizeof *commands; i++)
    if (argc > 1 && strcmp(argv[1], commands[i].name) == 0)
      code = commands[i].run(argc - 1, argv + 1);
  if (code == 2)
    fputs(
        "bench: sweep time|count|problems [SOLVER], single, ensemble, "
        "stability; see tools/bench/*.c\n",
        stderr);
  return code;
}
