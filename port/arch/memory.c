// The memory functions that a freestanding compiler may call, as small as they
// can be: those of a C library are long because they are fast.
#include <stddef.h>

void *memset(void *to, int value, size_t size);
void *memcpy(void *restrict to, const void *restrict from, size_t size);
void *memmove(void *to, const void *from, size_t size);

// Without this the compiler would replace the loops by calls of themselves.
#ifdef __clang__
#define ITSELF __attribute__((no_builtin))
#else
#define ITSELF __attribute__((optimize("no-tree-loop-distribute-patterns")))
#endif

ITSELF void *memset(void *to, int value, size_t size) {
  unsigned char *byte = to;
  while (size-- > 0) *byte++ = (unsigned char)value;
  return to;
}

ITSELF void *memmove(void *to, const void *from, size_t size) {
  unsigned char *byte = to;
  const unsigned char *other = from;
  if (byte > other)
    while (size-- > 0) byte[size] = other[size];
  else
    while (size-- > 0) *byte++ = *other++;
  return to;
}

void *memcpy(void *restrict to, const void *restrict from, size_t size) {
  return memmove(to, from, size);
}
