/// @file
/// The loop of `run --realtime` without a step, for what of its lateness is the
/// machine's: empty_loop DT STEPS FILE.
#include <stdio.h>
#include <stdlib.h>

#include "cli/host/host.h"
#include "cli/host/lateness.h"
#include "cli/text/message.h"

int main(int argc, char *argv[]) {
  static cli_lateness_t lateness;
  const double dt = argc == 4 ? strtod(argv[1], NULL) : 0;
  const long steps = argc == 4 ? strtol(argv[2], NULL, 10) : 0;
  if (!(dt > 0) || steps < 1) {
    fputs("usage: empty_loop DT STEPS FILE\n", stderr);
    return 2;
  }
  static cli_output_t output;
  const int code = cli_output_begin(&output, "FILE", argv[3], false);
  if (code != CLI_DONE) return code;
  const char *why = cli_take_priority();
  if (why != NULL) fprintf(stderr, "empty_loop: no priority: %s\n", why);
  const double start = cli_now();
  for (long n = 1; n <= steps && !cli_stop_asked(); n++) {
    const double time = start + (double)n * dt;
    cli_wait_until(time);
    const double began = cli_now() - time;
    cli_lateness_note(&lateness, began, cli_now() - time);
  }
  cli_lateness_write(&lateness, &output);
  return cli_output_end(&output, CLI_DONE);
}
