/* The core in double, and what the module calls. */
#include "shared.h"
