// The table of the mechanisms. The units of size follow from what is perturbed:
// noise on h has the standard deviation size sqrt(t), smoothing and hysteresis
// have a width in h, a delay is a time.

#include "mechanism.h"

const cli_mechanism_info_t cli_mechanisms[CLI_MECHANISMS] = {
    [CLI_BY_RANDOM] = {"random", "", 1e-2, 10, 1},
    [CLI_BY_NOISE] = {"noise", "m/s^1.5", 1e-3, 64, 1},
    [CLI_BY_SMOOTHING] = {"smoothing", "m/s", 1e-4, 16, 2},
    [CLI_BY_HYSTERESIS] = {"hysteresis", "m/s", 1e-3, 16, 2},
    [CLI_BY_DELAY] = {"delay", "s", 1e-3, 16, 2},
};
