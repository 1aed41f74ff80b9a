// The table of the mechanisms. The units of size follow from what is perturbed:
// noise on h has the standard deviation size sqrt(t), smoothing and hysteresis
// have a width in h, a delay is a time.

#include "mechanism.h"

const cli_mechanism_info_t cli_mechanisms[CLI_MECHANISMS] = {
    {"random", "", 1e-2, 10, 1},       {"noise", "m/s^1.5", 1e-3, 64, 1},
    {"smoothing", "m/s", 1e-4, 16, 2}, {"hysteresis", "m/s", 1e-3, 16, 2},
    {"delay", "s", 1e-3, 16, 2},
};
