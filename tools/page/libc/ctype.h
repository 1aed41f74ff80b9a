/// @file
/// Kinds of ASCII characters.
#ifndef TWOFOLD_PAGE_CTYPE_H
#define TWOFOLD_PAGE_CTYPE_H

static inline int isspace(int byte) {
  return byte == ' ' || (byte >= '\t' && byte <= '\r');
}

#endif
