/// @file
/// What libc.mjs reports of a number that is too small for its type; page.mk
/// exports the variable.
#ifndef TWOFOLD_PAGE_ERRNO_H
#define TWOFOLD_PAGE_ERRNO_H

extern int errno;
#define ERANGE 34

#endif
