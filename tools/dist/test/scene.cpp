// The header of one prepared scene has the trajectory of the golden hash, when
// called from C++:  scene; prints the hash of 1e5 steps.
#include <inttypes.h>
#include <stdio.h>

#include "twofold_chaos.h"

static uint64_t mix(uint64_t hash, const void *data, size_t size) {
  const unsigned char *byte = static_cast<const unsigned char *>(data);
  for (size_t i = 0; i < size; i++)
    hash = (hash ^ byte[i]) * UINT64_C(0x100000001B3);
  return hash;
}

int main() {
  tf_state_t x;
  tf_report_t report;
  uint64_t hash = UINT64_C(0xCBF29CE484222325);
  tf_chaos_begin(&x, &report);
  for (int i = 1; i <= 100000; i++) {
    const tf_input_t u = tf_chaos_input(&x);
    if (tf_chaos_step(&x, &u, &report) < 0) return 1;
    const tf_real_t bits[4] = {x.r + 0, x.v + 0, x.w + 0, x.phi + 0};
    const unsigned char modes[2] = {report.mode, report.set};
    hash = mix(hash, bits, sizeof bits);
    hash = mix(hash, modes, sizeof modes);
  }
  printf("%016" PRIX64 " %s\n", hash, tf_chaos_mode_name(report.mode));
  return 0;
}
