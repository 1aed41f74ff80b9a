/* The core in float, and what the module calls. */
#define TF_REAL_FLOAT
#include "shared.h"
