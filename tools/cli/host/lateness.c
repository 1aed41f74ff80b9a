// Histograms of lateness.

#include "lateness.h"

#include <inttypes.h>
#include <stdio.h>

// What is early, by the rounding of the clock, is on time.
static unsigned bin(double late) {
  const double us = late * 1e6;
  if (us >= CLI_LATENESS_BINS) {
    return CLI_LATENESS_BINS;
  }
  return us > 0 ? (unsigned)us : 0;
}

void cli_lateness_note(cli_lateness_t *lateness, double began, double ended) {
  lateness->began[bin(began)]++;
  lateness->ended[bin(ended)]++;
}

void cli_lateness_write(const cli_lateness_t *lateness, cli_output_t *output) {
  static const char header[] = "us,began,ended\n";
  (void)cli_output_lines(output, header, sizeof header - 1);
  for (unsigned us = 0; us <= CLI_LATENESS_BINS; us++) {
    char row[64];
    if (lateness->began[us] != 0 || lateness->ended[us] != 0) {
      const int length =
          snprintf(row, sizeof row, "%u,%" PRIu64 ",%" PRIu64 "\n", us,
                   lateness->began[us], lateness->ended[us]);
      (void)cli_output_lines(output, row, (size_t)length);
    }
  }
}
