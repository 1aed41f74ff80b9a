/* The code of the prepared scene: one file of a program holds it. */
#define TWOFOLD_CHAOS_CODE
#include <twofold_chaos.h>
