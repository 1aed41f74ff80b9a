// Text in buffers, in lines, and the names that are closest to a mistyped one.

#include <stdarg.h>

#include "text.h"

static void add_bytes(cli_buffer_t *buffer, const char *bytes, size_t length) {
  if (length >= buffer->room - buffer->used) {
    buffer->truncated = true;
    return;
  }
  memcpy(buffer->text + buffer->used, bytes, length);
  buffer->used += length;
  buffer->text[buffer->used] = '\0';
}

void cli_add(cli_buffer_t *buffer, const char *text) {
  add_bytes(buffer, text, strlen(text));
}

// What is between two conversions is added as it is. The letters are those of
// printf, so that a compiler checks the arguments.
void cli_add_form(cli_buffer_t *buffer, const char *form, ...) {
  va_list arguments;
  va_start(arguments, form);
  while (*form != '\0') {
    const size_t plain = strcspn(form, "%");
    add_bytes(buffer, form, plain);
    form += plain;
    if (*form == '\0') break;
    const bool is_long = form[1] == 'l'; // of a count: the length of its type
    form += strspn(form, "%l08");
    if (*form == 's')
      cli_add(buffer, va_arg(arguments, const char *));
    else if (*form == 'g')
      cli_add_real(buffer, (tf_real_t)va_arg(arguments, double));
    else if (*form == 'x')
      for (uint32_t at = 32, hash = va_arg(arguments, uint32_t); at > 0;
           at -= 4)
        add_bytes(buffer, &"0123456789abcdef"[hash >> (at - 4) & 15u], 1);
    else
      cli_add_count(buffer, is_long ? va_arg(arguments, uint64_t)
                                    : va_arg(arguments, unsigned));
    form++;
  }
  va_end(arguments);
}

void cli_add_real(cli_buffer_t *buffer, tf_real_t value) {
  cli_add_number(buffer, (double)value, sizeof value == sizeof(float));
}

void cli_add_number(cli_buffer_t *buffer, double value, bool is_float) {
  char digits[CLI_REAL_ROOM];
  const size_t length = decimal_write(digits, value, is_float);
  add_bytes(buffer, digits, length);
}

void cli_add_count(cli_buffer_t *buffer, uint64_t value) {
  char digits[20], *at = digits + sizeof digits;
  do *--at = (char)('0' + value % 10);
  while ((value /= 10) > 0);
  add_bytes(buffer, at, (size_t)(digits + sizeof digits - at));
}

void *cli_grow(void *list, size_t used, size_t *room, size_t size) {
  const size_t more = *room == 0 ? 64 : 2 * *room;
  if (used < *room) return list;
  list = more <= SIZE_MAX / size ? realloc(list, more * size) : NULL;
  *room = list != NULL ? more : *room;
  return list;
}

bool cli_next_line(cli_lines_t *lines, char *out, size_t room) {
  if (lines->line == 0 && lines->size >= 3 && lines->text[0] == '\xEF' &&
      lines->text[1] == '\xBB' && lines->text[2] == '\xBF') {
    lines->text += 3;
    lines->size -= 3;
  }
  if (lines->size == 0) return false;
  const char *newline = memchr(lines->text, '\n', lines->size);
  const size_t all =
      newline != NULL ? (size_t)(newline - lines->text) : lines->size;
  const size_t length = all - (all > 0 && lines->text[all - 1] == '\r');
  const size_t kept = length < room ? length : room - 1;
  memcpy(out, lines->text, kept);
  out[kept] = '\0';
  lines->open = newline == NULL;
  lines->length = length;
  lines->line++;
  lines->text += all + !lines->open;
  lines->size -= all + !lines->open;
  return true;
}

char *cli_trim(char *text) {
  text += strspn(text, " \t");
  size_t length = strlen(text);
  while (length > 0 && strchr(" \t", text[length - 1]) != NULL) length--;
  text[length] = '\0';
  return text;
}

// The distance of two names is the edit distance (insert, delete, replace, swap
// two neighbours), bounded by a third of the word: beyond that a suggestion is
// noise.

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

// table[i][j] is the distance of the first i letters to the first j.
static size_t edit_distance(const char *a, const char *b) {
  size_t table[CLI_CLOSEST_LONGEST + 1][CLI_CLOSEST_LONGEST + 1];
  const size_t n = strlen(a), m = strlen(b);
  if (n > CLI_CLOSEST_LONGEST || m > CLI_CLOSEST_LONGEST) return SIZE_MAX;
  for (size_t i = 0; i <= n; i++) {
    for (size_t j = 0; j <= m; j++) {
      size_t best = i + j;
      if (i > 0 && j > 0) {
        best = table[i - 1][j - 1] + (a[i - 1] != b[j - 1] ? 1 : 0);
        best = least(best, least(table[i - 1][j], table[i][j - 1]) + 1);
      }
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        best = least(best, table[i - 2][j - 2] + 1);
      table[i][j] = best;
    }
  }
  return table[n][m];
}

cli_closest_t cli_closest_to(const char *word) {
  return (cli_closest_t){word, (strlen(word) + 1) / 3 + 1, ""};
}

void cli_closest_offer(cli_closest_t *closest, const char *name) {
  const size_t distance = edit_distance(closest->word, name);
  if (distance < closest->distance) {
    closest->distance = distance;
    (void)snprintf(closest->hint, sizeof closest->hint, "; did you mean '%s'?",
                   name);
  }
}

size_t cli_closest_find(cli_closest_t *closest, const void *table, size_t count,
                        size_t bytes) {
  size_t i = 0;
  for (; i < count; i++) {
    const void *row = (const char *)table + i * bytes;
    const char *name = *(const char *const *)row;
    if (strcmp(name, closest->word) == 0) break;
    cli_closest_offer(closest, name);
  }
  return i;
}
