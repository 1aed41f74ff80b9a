// The header of one prepared scene, called from C++: prints the hash of 1e5
// steps that tests/golden has. SCENE is its name, HEADER its header.
#include <inttypes.h>
#include <stdio.h>

#include HEADER

#define NAME(scene, what) tf_##scene##_##what
#define OF(scene, what) NAME(scene, what)

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
  OF(SCENE, begin)(&x, &report);
  for (int i = 1; i <= 100000; i++) {
    const tf_input_t u = OF(SCENE, input)(&x);
    if (OF(SCENE, step)(&x, &u, &report) < 0) return 1;
    const tf_real_t bits[4] = {x.r + 0, x.v + 0, x.w + 0, x.phi + 0};
    const unsigned char modes[2] = {report.mode, report.set};
    hash = mix(hash, bits, sizeof bits);
    hash = mix(hash, modes, sizeof modes);
  }
  printf("%016" PRIX64 " %s\n", hash, OF(SCENE, mode_name)(report.mode));
  return 0;
}
