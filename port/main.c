// The program of a board: starts the board and the application, and runs the
// loop between the two.
#include "app.h"
#include "loop.h"
#include "port.h"

int main(void) {
  static loop_counts_t counts;
  port_init();
  if (!app_begin()) port_halt(LOOP_REFUSED);
  const loop_end_t end = loop_run(&app_plan, &counts);
  port_halt((int)end);
}
