/// @file
/// Short texts for the logger, without a C library's printf, which may allocate
/// memory.
#ifndef TWOFOLD_FMU_MESSAGE_H
#define TWOFOLD_FMU_MESSAGE_H

#include <stddef.h>
#include <stdint.h>

#define FMU_MESSAGE_ROOM 320

/// A text that grows; what exceeds its room is cut off.
typedef struct {
  char text[FMU_MESSAGE_ROOM];
  size_t length;
} fmu_message_t;

/// Appends a text. text: in, zero-terminated; NULL appends nothing.
void fmu_say(fmu_message_t *message, const char *text);

/// Appends a whole number.
void fmu_say_whole(fmu_message_t *message, uint32_t value);

/// Appends a number, in at most nine significant digits.
void fmu_say_number(fmu_message_t *message, double value);

#endif
