// Texts and numbers for the logger.

#include "message.h"

#include <float.h>
#include <stdint.h>

#define DIGITS 9

static void say_letter(fmu_message_t *message, char letter) {
  if (message->length + 1 >= sizeof message->text) return;
  message->text[message->length++] = letter;
  message->text[message->length] = '\0';
}

static void say_text(fmu_message_t *message, const char *text) {
  while (text != NULL && *text != '\0') say_letter(message, *text++);
}

static void say_whole(fmu_message_t *message, unsigned value) {
  char digits[10];
  int n = 0;
  do {
    digits[n++] = (char)('0' + value % 10);
    value /= 10;
  } while (value > 0);
  while (n > 0) say_letter(message, digits[--n]);
}

// The digits of a positive number: value = digits 10^(exponent - 8), rounded to
// DIGITS of them.
static uint32_t scaled(double value, int *exponent) {
  const double one_more = 1e9;
  *exponent = 0;
  while (value >= 10) value /= 10, ++*exponent;
  while (value < 1) value *= 10, --*exponent;
  const double digits = value * (one_more / 10) + 0.5;
  if (digits < one_more) return (uint32_t)digits;
  ++*exponent;
  return (uint32_t)(one_more / 10);
}

// `count` digits, a point after the first `before` of them; without the zeros
// at the end of a fraction.
static void say_digits(fmu_message_t *message, uint32_t digits, int before) {
  char letter[DIGITS];
  int used = DIGITS;
  for (int i = DIGITS - 1; i >= 0; i--) {
    letter[i] = (char)('0' + digits % 10);
    digits /= 10;
  }
  while (used > before && letter[used - 1] == '0') used--;
  for (int i = 0; i < DIGITS && i < used; i++) {
    if (i == before) say_letter(message, '.');
    say_letter(message, letter[i]);
  }
}

static void say_number(fmu_message_t *message, double value) {
  int exponent = 0;
  if (value != value) {
    say_text(message, "NaN");
    return;
  }
  if (value < 0) {
    say_letter(message, '-');
    value = -value;
  }
  if (value > DBL_MAX || value == 0) {
    say_text(message, value > 0 ? "infinity" : "0");
    return;
  }
  const uint32_t digits = scaled(value, &exponent);
  if (exponent >= 0 && exponent < DIGITS) {
    say_digits(message, digits, exponent + 1);
    return;
  }
  if (exponent < 0 && exponent >= -4) {
    say_text(message, "0.");
    for (int i = -1; i > exponent; i--) say_letter(message, '0');
    say_digits(message, digits, DIGITS);
    while (message->text[message->length - 1] == '0')
      message->text[--message->length] = '\0';
    return;
  }
  say_digits(message, digits, 1);
  say_text(message, exponent < 0 ? "e-" : "e");
  say_whole(message, (unsigned)(exponent < 0 ? -exponent : exponent));
}

void fmu_say_all(fmu_message_t *message, const char *format,
                 va_list arguments) {
  for (; *format != '\0'; format++) {
    if (*format != '%')
      say_letter(message, *format);
    else if (*++format == 's')
      say_text(message, va_arg(arguments, const char *));
    else if (*format == 'u')
      say_whole(message, va_arg(arguments, unsigned));
    else
      say_number(message, va_arg(arguments, double));
  }
}

void fmu_say(fmu_message_t *message, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  fmu_say_all(message, format, arguments);
  va_end(arguments);
}
