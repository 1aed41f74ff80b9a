// On the target: the hash of steps of random machines that
// tests/golden/test_population.c computes with the library. Prints
// "population REAL HASH" and ends with 0.
#include "../../port/core.h"
// After the core, whose functions are local.
#include "../golden/population.h"
#include "say.h"

#ifdef SCHEME_LOCATED
#define MACHINES 100
#define STEPS_OF_EACH 2
#else
#define MACHINES 300
#define STEPS_OF_EACH 6
#endif

int main(void) {
  static uint8_t line[96];
  text_t text = {line};
  port_init();
  const uint64_t hash = hash_of_steps(scheme_step, MACHINES, STEPS_OF_EACH);
  text_string(&text, "population ");
  text_string(&text, sizeof(tf_real_t) == 8 ? "double " : "float ");
  text_hex(&text, hash);
  say(line, &text);
  port_halt(0);
}
