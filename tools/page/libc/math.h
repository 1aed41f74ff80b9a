/// @file
/// Parts of a double; libc.c has frexp.
#ifndef TWOFOLD_PAGE_MATH_H
#define TWOFOLD_PAGE_MATH_H

double frexp(double value, int *exponent);
static inline double fabs(double value) { return __builtin_fabs(value); }

#endif
