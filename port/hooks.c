// What a board may leave to this file: see the optional functions of port.h.
// And the end of a program in which something is broken.
#include "port.h"

#define TRIES 1000000ul // looks at a line that may be broken too, for each byte

#ifdef FRAMES
#define FRAME_END '\0'
#else
#define FRAME_END '\n'
#endif

#ifdef __GNUC__
#define DEFAULT __attribute__((weak))
#else
#define DEFAULT
#endif

DEFAULT void port_feed(void) {}

DEFAULT void port_safe(void) {}

DEFAULT uint32_t port_unread(void) { return 0; }

DEFAULT bool port_stack_holds(void) { return true; }

// Not from a buffer: what is in memory may be what is broken.
static void send(char byte) {
  for (uint32_t n = 0; n < TRIES && port_room() == 0; n++) continue;
  port_put((uint8_t)byte);
}

static void send_string(const char *from) {
  while (*from) send(*from++);
}

static void send_hex(uint32_t bits) {
  for (int n = 0; n < 8; n++, bits <<= 4) {
    const char digit = (char)(bits >> 28);
    send((char)(digit + (digit < 10 ? '0' : 'A' - 10)));
  }
}

void port_fault(const char *why, uint32_t at, uint32_t cause) {
  port_safe();
  send(FRAME_END); // a line between two frames, which hosts print
  send_string("\r\nfault: ");
  send_string(why);
  send_string(" at ");
  send_hex(at);
  send_string(" cause ");
  send_hex(cause);
  send_string("\r\n");
  send(FRAME_END);
  port_halt(PORT_FAULT);
}
