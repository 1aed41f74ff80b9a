/// @file
/// What decimal.c reports of a number that has no room in its type.
#ifndef TWOFOLD_PAGE_ERRNO_H
#define TWOFOLD_PAGE_ERRNO_H

extern int errno;
#define ERANGE 34

#endif
