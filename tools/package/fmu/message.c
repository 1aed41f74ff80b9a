// Texts and numbers for the logger.

#include <float.h>

#include "fmu.h"

#define DIGITS 17

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

// value 10^power; 10^22 is the last power that is exact.
static double shifted(double value, int power) {
  double ten = 1;
  for (int i = 0; i < power || i < -power; i++) ten *= 10;
  return power < 0 ? value / ten : value * ten;
}

// A positive number as digits 10^(exponent + 1 - DIGITS), zeros behind as many
// digits, nine or more, as read back as the same number.
static uint64_t scaled(double value, int *exponent) {
  const uint64_t least = UINT64_C(10000000000000000); // of DIGITS digits
  int power = 0;
  *exponent = DIGITS - 1;
  for (; value < 1e-280; value *= 10) --*exponent;
  while (shifted(value, power) >= 1e9) power--;
  while (shifted(value, power) < 1e8) power++;
  uint64_t digits = (uint64_t)(shifted(value, power) + 0.5);
  while (digits < least && shifted((double)digits, -power) != value)
    digits = (uint64_t)(shifted(value, ++power) + 0.5);
  *exponent -= power;
  for (; digits < least; digits *= 10) --*exponent;
  return digits;
}

// DIGITS digits, a point after the first `before` of them, or none where that
// is 0; without the zeros at the end of a fraction.
static void say_digits(fmu_message_t *message, uint64_t digits, int before) {
  char letter[DIGITS];
  int used = DIGITS;
  for (int i = DIGITS - 1; i >= 0; i--) {
    letter[i] = (char)('0' + digits % 10);
    digits /= 10;
  }
  while (used > before && letter[used - 1] == '0') used--;
  for (int i = 0; i < used; i++) {
    if (i > 0 && i == before) say_letter(message, '.');
    say_letter(message, letter[i]);
  }
}

static void say_number(fmu_message_t *message, double value) {
  int exponent = 0;
  if (value < 0) {
    say_letter(message, '-');
    value = -value;
  }
  if (!(value <= DBL_MAX) || value == 0) {
    say_text(message, value == 0 ? "0" : value > 0 ? "infinity" : "NaN");
    return;
  }
  const uint64_t digits = scaled(value, &exponent);
  if (exponent >= 0 && exponent < 9) {
    say_digits(message, digits, exponent + 1);
  } else if (exponent < 0 && exponent >= -4) {
    say_text(message, "0.");
    for (int i = -1; i > exponent; i--) say_letter(message, '0');
    say_digits(message, digits, 0);
  } else {
    say_digits(message, digits, 1);
    say_text(message, exponent < 0 ? "e-" : "e");
    say_whole(message, (unsigned)(exponent < 0 ? -exponent : exponent));
  }
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
