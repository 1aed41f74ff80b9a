/// @file
/// Short texts for the logger, without a C library's printf, which may allocate
/// memory.
#ifndef TWOFOLD_FMU_MESSAGE_H
#define TWOFOLD_FMU_MESSAGE_H

#include <stdarg.h>
#include <stddef.h>

#define FMU_MESSAGE_ROOM 320

/// A text that grows; what exceeds its room is cut off.
typedef struct {
  char text[FMU_MESSAGE_ROOM];
  size_t length;
} fmu_message_t;

#if defined(__GNUC__)
#define FMU_FORMAT(n) __attribute__((format(printf, n, (n) + 1)))
#else
#define FMU_FORMAT(n)
#endif

/// Appends a text. format: in; in it %s is the next text, of which NULL appends
/// nothing, %u the next unsigned and %g the next double, in as many digits as
/// tell it from others, at most 17.
FMU_FORMAT(2)
void fmu_say(fmu_message_t *message, const char *format, ...);
void fmu_say_all(fmu_message_t *message, const char *format, va_list arguments);

#endif
