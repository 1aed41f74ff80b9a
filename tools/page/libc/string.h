/// @file
/// What sources that are written for a C library need of it in WebAssembly,
/// where there is none; port/arch/memory.c has the functions.
#ifndef TWOFOLD_PAGE_STRING_H
#define TWOFOLD_PAGE_STRING_H

#include <stddef.h>

void *memset(void *to, int value, size_t size);
void *memcpy(void *restrict to, const void *restrict from, size_t size);

#endif
