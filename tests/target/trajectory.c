// On the target: the hash of a trajectory that tests/golden/test_golden.c
// computes with the library. Prints "trajectory SCENE REAL STEPS HASH" and ends
// with what tf_arithmetic finds: 0.
#include "../../port/core.h"
// After the core, whose functions are local.
#include "say.h"

static uint64_t mix(uint64_t hash, const void *data, unsigned size) {
  const unsigned char *byte = data;
  for (unsigned i = 0; i < size; i++) hash = (hash ^ byte[i]) * 0x100000001B3u;
  return hash;
}

static uint64_t trajectory_hash(uint32_t steps) {
  static tf_state_t x;
  static tf_report_t report;
  uint64_t hash = 0xCBF29CE484222325u;
  if (!scene_begin(&x, &report) || !scheme_begin()) return 0;
  for (uint32_t i = 1; i <= steps; i++) {
    const tf_input_t input = scene_input(i);
    if (scheme_step(SCENE_MACHINE, &x, &input, &report) < 0) return 0;
    // + 0 makes -0 a 0, as in the golden hashes.
    const tf_real_t bits[4] = {x.r + 0, x.v + 0, x.w + 0, x.phi + 0};
    const unsigned char modes[2] = {report.mode, report.set};
    hash = mix(hash, bits, sizeof bits);
    hash = mix(hash, modes, sizeof modes);
  }
  return hash;
}

int main(void) {
  static uint8_t line[96];
  text_t text = {line};
  port_init();
  const uint64_t hash = trajectory_hash(STEPS);
  text_string(&text, "trajectory ");
  text_string(&text, SCENE->name);
  text_string(&text, sizeof(tf_real_t) == 8 ? " double " : " float ");
  text_whole(&text, STEPS, 1);
  text_byte(&text, ' ');
  text_hex(&text, hash);
  say(line, &text);
  port_halt(tf_arithmetic());
}
