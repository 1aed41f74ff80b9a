/// What sources that are written for a C library need of it in WebAssembly,
/// where there is none: port/arch/memory.c and libc.c have the functions.
#pragma once

#include <stddef.h>

void *memset(void *to, int value, size_t size);
void *memcpy(void *restrict to, const void *restrict from, size_t size);
void *memchr(const void *text, int byte, size_t size);
size_t strlen(const char *text);
int strcmp(const char *a, const char *b);
char *strchr(const char *text, int byte);
char *strrchr(const char *text, int byte);
char *strpbrk(const char *text, const char *bytes);
size_t strspn(const char *text, const char *bytes);
size_t strcspn(const char *text, const char *bytes);
char *strerror(int error);
