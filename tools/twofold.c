// The program `twofold`. It links libc, libm and the core; everything else is
// under tools/cli. tools/cli/command.c has the table of the commands and
// lists the folders.

#include "cli/command.h"
#include "cli/host/host.h"

int main(int argc, char *argv[]) {
  cli_guard_descriptors();
  return cli_command(argc - 1, argv + 1);
}
