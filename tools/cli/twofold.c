// The program `twofold`. It links libc, libm and the core; everything else is
// under tools/cli. tools/cli/commands.c has the table of the commands and
// lists the folders.

#include <stdio.h>

#include "cli/command.h"
#include "cli/host/host.h"
#include "cli/text/message.h"

// What a command reports is part of what it was asked for: where it could not
// be written, on a full disk, the command was not done. Standard output is
// looked after by each command, which names it.
int main(int argc, char *argv[]) {
  cli_guard_descriptors();
  const int code = cli_command(argc - 1, argv + 1);
  return code == CLI_DONE && ferror(stderr) ? CLI_STOPPED : code;
}
