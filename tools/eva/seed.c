// Faults put here to be found: `alarms` explains each, so that the run fails
// where the analyser does not raise it.
#include "any.h"

void seed(void);
void seed(void) {
  int table[4] = {0}, unset;
  const int i = Frama_C_interval(0, 4), n = Frama_C_interval(0, 31);
  const tf_real_t x = any_real();
  table[i] = 1;
  table[0] = 1 << n;
  table[1] = (int)x;
  if (i == 3) table[2] = unset;
}
