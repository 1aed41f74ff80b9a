// A line that a program on the target prints, as fast as its serial line takes
// it.
#ifndef TESTS_TARGET_SAY_H
#define TESTS_TARGET_SAY_H

#include "../../port/port.h"
#include "../../port/text.h"

static inline void say(const uint8_t *from, text_t *text) {
  text_string(text, "\r\n");
  while (from < text->end)
    if (port_room() > 0) port_put(*from++);
}

#endif
