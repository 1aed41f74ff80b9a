// The functions of C on text, byte by byte.
// libc.mjs has those that read and print numbers.
#include "libc.h"

#include <stdbool.h>

int errno;

// As in C they give back a pointer to what the caller owns, so that it may be
// written where the caller may.
static void *writable(const void *at) {
  union {
    const void *given;
    void *writable;
  } it;
  it.given = at;
  return it.writable;
}

void *memchr(const void *text, int byte, size_t size) {
  const unsigned char *at = text;
  for (; size > 0; size--, at++)
    if (*at == (unsigned char)byte) return writable(at);
  return NULL;
}

size_t strlen(const char *text) {
  size_t length = 0;
  while (text[length] != '\0') length++;
  return length;
}

int strcmp(const char *a, const char *b) {
  while (*a != '\0' && *a == *b) a++, b++;
  return (unsigned char)*a - (unsigned char)*b;
}

char *strchr(const char *text, int byte) {
  return memchr(text, byte, strlen(text) + 1);
}

char *strrchr(const char *text, int byte) {
  const char *at = text + strlen(text);
  while (at > text && *at != (char)byte) at--;
  return *at == (char)byte ? writable(at) : NULL;
}

// How many bytes come before the first one that is in the list, or is not.
static size_t span(const char *text, const char *bytes, bool in_list) {
  size_t length = 0;
  while (text[length] != '\0' &&
         (strchr(bytes, text[length]) != NULL) == in_list)
    length++;
  return length;
}

size_t strspn(const char *text, const char *bytes) {
  return span(text, bytes, true);
}

size_t strcspn(const char *text, const char *bytes) {
  return span(text, bytes, false);
}

char *strpbrk(const char *text, const char *bytes) {
  const char *at = text + strcspn(text, bytes);
  return *at != '\0' ? writable(at) : NULL;
}
