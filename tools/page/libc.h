/// What sources that are written for a C library need of it in WebAssembly,
/// where there is none; page.mk puts this file before each of them, and empty
/// headers in the place of a library's. libc.c and port/arch/memory.c have the
/// functions on bytes, the browser those that read and print numbers
/// (libc.mjs). There are no files and no blocks of memory: what opens, prints
/// or takes one is declared, so that its source compiles, and the linker leaves
/// it out.
#pragma once

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

extern int errno;
#define ERANGE 34
#define PRIu64 "llu"
#define isfinite(value) __builtin_isfinite(value)

static inline double fabs(double value) { return __builtin_fabs(value); }
static inline int isspace(int byte) {
  return byte == ' ' || (byte >= '\t' && byte <= '\r');
}

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

#define OF_BROWSER(name) __attribute__((import_name(name)))
OF_BROWSER("print")
int snprintf(char *out, size_t room, const char *format, ...);
OF_BROWSER("print")
int vsnprintf(char *out, size_t room, const char *format, va_list arguments);
OF_BROWSER("strtod") double strtod(const char *text, char **end);

typedef struct file FILE;
FILE *fopen(const char *path, const char *how);
size_t fread(void *to, size_t size, size_t count, FILE *file);
int ferror(FILE *file);
int fclose(FILE *file);
int printf(const char *format, ...);
int putchar(int byte);
char *strerror(int error);
float strtof(const char *text, char **end);
void *realloc(void *block, size_t size);
void free(void *block);
