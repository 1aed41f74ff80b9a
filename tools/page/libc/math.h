/// Parts of a double; libc.c has frexp.
#pragma once

double frexp(double value, int *exponent);
static inline double fabs(double value) { return __builtin_fabs(value); }
