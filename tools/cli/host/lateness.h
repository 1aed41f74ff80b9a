/// How late a loop in real time is: a histogram with bins of 1 us, as
/// cyclictest of rt-tests prints one, of each step's beginning and end.
#pragma once

#include <stdint.h>

#include "output.h"

#define CLI_LATENESS_BINS 10000u ///< [us]; the last one counts what is later

typedef struct {
  uint64_t began[CLI_LATENESS_BINS + 1];
  uint64_t ended[CLI_LATENESS_BINS + 1];
} cli_lateness_t;

/// Counts a step: how long after its time it began and ended [s].
void cli_lateness_note(cli_lateness_t *lateness, double began, double ended);

/// Writes `us,began,ended`, a row for each bin in which something is.
void cli_lateness_write(const cli_lateness_t *lateness, cli_output_t *output);
