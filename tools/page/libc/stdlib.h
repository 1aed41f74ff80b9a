/// @file
/// Numbers from text; decimal.c has strtod.
#ifndef TWOFOLD_PAGE_STDLIB_H
#define TWOFOLD_PAGE_STDLIB_H

double strtod(const char *text, char **end);
float strtof(const char *text, char **end); // of builds in float alone

#endif
