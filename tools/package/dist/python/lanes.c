/* The lanes of an ensemble once more, for the vectors of AVX2. */
#if defined(__GNUC__) && defined(__x86_64__)
#pragma GCC target("avx2")
#define LANES_FOR_AVX2
#include "shared.c"
#endif
