// The host program: dispatch to its commands. It links libc and libm and the
// core; all that a command needs of the host is under tools/cli. A command
// gets what stands behind its name and returns the exit code.

#include <string.h>

#include "cli/analysis.h"
#include "cli/diverge.h"
#include "cli/help.h"
#include "cli/host.h"
#include "cli/monitor.h"
#include "cli/run.h"
#include "cli/text.h"

static const struct {
  const char *name;
  int (*perform)(int argc, char *const argv[]);
} commands[] = {
    {"scenes", cli_scenes},   {"run", cli_run},
    {"monitor", cli_monitor}, {"singularities", cli_singularities},
    {"regions", cli_regions}, {"design", cli_design},
    {"atlas", cli_atlas},     {"diverge", cli_diverge},
    {"help", cli_help},
};
#define COMMANDS (sizeof commands / sizeof commands[0])

// The reports build several variants of the core, so they belong to make.
static int unknown_command(const char *name) {
  if (strcmp(name, "bench") == 0 || strcmp(name, "stability") == 0) {
    return cli_complain(CLI_USAGE, "%s is a target of make: 'make %s'", name,
                        name);
  }
  cli_closest_t closest = cli_closest_to(name);
  for (size_t i = 0; i < COMMANDS; i++) {
    cli_closest_offer(&closest, commands[i].name);
  }
  const cli_hint_t hint = cli_closest_hint(&closest);
  return cli_complain(CLI_USAGE,
                      "unknown command '%s'%s%s%s ('twofold help' lists them)",
                      name, hint.before, hint.name, hint.after);
}

// Whether --help or -h stands among the arguments of a command.
static int asks_for_help(int argc, char *const argv[]) {
  for (int i = 0; i < argc; i++) {
    if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
      return 1;
    }
  }
  return 0;
}

int main(int argc, char *argv[]) {
  cli_guard_descriptors();
  if (argc < 2) {
    return cli_complain(CLI_USAGE,
                        "which command? ('twofold help' lists them)");
  }
  const char *name = argv[1];
  if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0) {
    return cli_help(argc - 2, argv + 2);
  }
  if (strcmp(name, "--version") == 0) {
    return cli_version();
  }
  if (asks_for_help(argc - 2, argv + 2)) {
    return cli_help(cli_has_page(name) ? 1 : 0, argv + 1);
  }
  for (size_t i = 0; i < COMMANDS; i++) {
    if (strcmp(commands[i].name, name) == 0) {
      return commands[i].perform(argc - 2, argv + 2);
    }
  }
  return unknown_command(name);
}
