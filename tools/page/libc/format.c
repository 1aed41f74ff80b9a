// Text from a format, for the formats that the page's sources have: of another
// one it traps.
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "decimal.h"

typedef struct {
  char *text;
  size_t used, room; // what does not fit is counted
} out_t;

static void put(out_t *out, char byte) {
  if (out->used + 1 < out->room) out->text[out->used] = byte;
  out->used++;
}

static void put_text(out_t *out, const char *text) {
  while (*text != '\0') put(out, *text++);
}

static void put_whole(out_t *out, uint32_t value, int least) {
  char digits[10];
  int count = 0;
  do {
    digits[count++] = (char)('0' + value % 10);
    value /= 10;
  } while (value != 0 || count < least);
  while (count > 0) put(out, digits[--count]);
}

static void put_signed(out_t *out, int value, int least) {
  if (value < 0) put(out, '-');
  put_whole(out, value < 0 ? 0u - (uint32_t)value : (uint32_t)value, least);
}

// Rounds digits to a number of them, half to even as the digits are exact.
// Returns: whether a further place came before them.
static bool round_digits(char digits[DECIMAL_ROOM], size_t keep) {
  const size_t length = strlen(digits);
  if (length <= keep) {
    memset(digits + length, '0', keep - length);
    digits[keep] = '\0';
    return false;
  }
  const bool is_half = digits[keep] == '5' && digits[keep + 1] == '\0';
  const bool is_odd = ((unsigned char)digits[keep - 1] & 1u) != 0;
  const bool up = is_half ? is_odd : digits[keep] >= '5';
  size_t i = keep;
  digits[keep] = '\0';
  if (!up) return false;
  while (i > 0 && digits[i - 1] == '9') digits[--i] = '0';
  if (i > 0) {
    digits[i - 1]++;
    return false;
  }
  digits[0] = '1';
  return true;
}

static void put_scientific(out_t *out, const char *digits, int exponent) {
  put(out, digits[0]);
  if (digits[1] != '\0') {
    put(out, '.');
    put_text(out, digits + 1);
  }
  put_text(out, exponent < 0 ? "e-" : "e+");
  put_whole(out, (uint32_t)(exponent < 0 ? -exponent : exponent), 2);
}

static void put_fixed(out_t *out, const char *digits, int exponent) {
  if (exponent < 0) put_text(out, "0.");
  for (int i = exponent; i < -1; i++) put(out, '0');
  for (; *digits != '\0' || exponent >= 0; exponent--) {
    char digit = '0';
    if (*digits != '\0') digit = *digits++;
    put(out, digit);
    if (exponent == 0 && *digits != '\0') put(out, '.');
  }
}

// %g or %e. digits: in, how many %g has, and one fewer than %e has.
static void put_real(out_t *out, double value, int precision, bool is_g) {
  char digits[DECIMAL_ROOM];
  uint64_t bits = 0;
  memcpy(&bits, &value, sizeof bits);
  if (bits >> 63 != 0) put(out, '-');
  if (!(value - value <= 0)) {
    put_text(out, value > 0 || value < 0 ? "inf" : "nan");
    return;
  }
  const int size = is_g ? (precision > 0 ? precision : 1) : precision + 1;
  int exponent = decimal_digits(value, digits) - 1;
  if (digits[0] == '\0') exponent = 0;
  exponent += round_digits(digits, (size_t)size);
  if (!is_g) {
    put_scientific(out, digits, exponent);
    return;
  }
  size_t end = strlen(digits);
  while (end > 1 && digits[end - 1] == '0') end--;
  digits[end] = '\0';
  if (exponent < -4 || exponent >= size)
    put_scientific(out, digits, exponent);
  else
    put_fixed(out, digits, exponent);
}

int vsnprintf(char *text, size_t room, const char *format, va_list arguments) {
  out_t out = {text, 0, room};
  for (; *format != '\0'; format++) {
    int precision = 6;
    if (*format != '%') {
      put(&out, *format);
      continue;
    }
    format++;
    if (format[0] == '.' && format[1] == '*') {
      precision = va_arg(arguments, int);
      format += 2;
    }
    if (*format == 'z') format++; // size_t has the size of unsigned here
    if (*format == 's')
      put_text(&out, va_arg(arguments, const char *));
    else if (*format == 'u')
      put_whole(&out, va_arg(arguments, unsigned), 1);
    else if (*format == 'd')
      put_signed(&out, va_arg(arguments, int), 1);
    else if (*format == 'g' || *format == 'e')
      put_real(&out, va_arg(arguments, double), precision, *format == 'g');
    else
      __builtin_trap();
  }
  if (room > 0) text[out.used < room ? out.used : room - 1] = '\0';
  return (int)out.used;
}

int snprintf(char *text, size_t room, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const int length = vsnprintf(text, room, format, arguments);
  va_end(arguments);
  return length;
}
