// Faults put here to be found: `alarms` explains each, so that the run fails
// where the analyser does not raise it.
#include "any.h"

int seed(void);
int seed(void) {
  int table[4] = {0};
  const int i = Frama_C_interval(0, 4), n = Frama_C_interval(0, 31);
  const tf_real_t x = any_real();
  table[i] = 1;
  //@ check reached: \false;
  return table[1] + (1 << n) / 2 + (int)x / 2;
}
