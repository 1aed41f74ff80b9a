// U+FEFF in UTF-8: three bytes that are no part of the text.

#include "mark.h"

size_t cli_utf8_mark(const char *text, size_t size) {
  static const char mark[] = "\xEF\xBB\xBF";
  size_t same = 0;
  while (same < size && same < 3 && text[same] == mark[same]) {
    same++;
  }
  return same == 3 ? 3 : 0;
}
