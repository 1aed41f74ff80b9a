// Texts and numbers for the logger.

#include "decimal.h"
#include "fmu.h"

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

static void say_number(fmu_message_t *message, double value) {
  char digits[DECIMAL_ROOM];
  (void)decimal_write(digits, value, false);
  say_text(message, digits);
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
