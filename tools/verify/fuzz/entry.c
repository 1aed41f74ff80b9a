// The door for libFuzzer: tools/verify/verify.mk compiles it once a target. A
// broken promise ends the program like any other crash, so that libFuzzer
// keeps the input.
#include <stdio.h>
#include <stdlib.h>

#include "verify/fuzz/fuzz.h"

#ifndef FUZZ
#define FUZZ fuzz_machine
#endif

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const char *broken = FUZZ(data, size);
  if (broken != NULL) {
    (void)fprintf(stderr, "broken promise: %s\n", broken);
    abort();
  }
  return 0;
}
