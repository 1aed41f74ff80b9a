/* In float. */
#define TF_REAL_FLOAT
#include "lanes_f64.c"
