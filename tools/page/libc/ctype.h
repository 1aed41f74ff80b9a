/// Kinds of ASCII characters.
#pragma once

static inline int isspace(int byte) {
  return byte == ' ' || (byte >= '\t' && byte <= '\r');
}
