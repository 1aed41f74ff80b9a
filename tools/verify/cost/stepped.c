// See stepped.h. What a trap does not tell apart from the function: the
// additions that count, which are known, and what hands over its arguments.
#define _POSIX_C_SOURCE 200809L
#include "verify/cost/stepped.h"

#include <inttypes.h>
#include <signal.h>
#include <stdio.h>

#include "verify/cost/count.h"

int count_stepping;
uint32_t count_additions;

// Instructions of the harness in a window, at most.
#define HARNESS 64

static volatile sig_atomic_t traps;

static void on_trap(int signal_number) {
  (void)signal_number;
  traps = traps + 1;
}

int print_stepped(const call_t *call, const subject_t *s) {
  struct sigaction action = {.sa_handler = on_trap};
  if (sigaction(SIGTRAP, &action, NULL) != 0) return 0;
  count_stepping = 1;
  const uint32_t counted = call->count(s);
  count_stepping = 0;
  const long stepped = (long)traps - (long)count_additions;
  const long rest = stepped - (long)counted;
  printf("tf_%s: %" PRIu32 " counted, %ld stepped with its call\n", call->name,
         counted, stepped);
  traps = 0;
  return rest >= 0 && rest <= HARNESS;
}
