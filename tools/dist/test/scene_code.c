#define TWOFOLD_CHAOS_CODE
#include "twofold_chaos.h"
