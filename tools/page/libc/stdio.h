/// Of C's text output, what the reader of scenes calls, done by the browser
/// (libc.mjs). There are no files: what opens or prints one is declared, so
/// that its source compiles, and the linker leaves it out.
#pragma once

#include <stdarg.h>
#include <stddef.h>

typedef struct file FILE;

__attribute__((import_name("print"))) int snprintf(char *out, size_t room,
                                                   const char *format, ...);
__attribute__((import_name("print"))) int vsnprintf(char *out, size_t room,
                                                    const char *format,
                                                    va_list arguments);

FILE *fopen(const char *path, const char *how);
size_t fread(void *to, size_t size, size_t count, FILE *file);
int ferror(FILE *file);
int fclose(FILE *file);
int printf(const char *format, ...);
int putchar(int byte);
