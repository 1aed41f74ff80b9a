// Philox-2x32-10, with the constants and rounds of Salmon et al. (2011).
#include "twofold/philox.h"

TF_API void tf_philox(uint64_t counter, uint32_t key, uint32_t out[2]) {
  uint32_t left = (uint32_t)counter, right = (uint32_t)(counter >> 32);
  for (int round = 0; round < 10; round++) {
    const uint64_t product = (uint64_t)0xD256D193u * left;
    left = (uint32_t)(product >> 32) ^ key ^ right;
    right = (uint32_t)product;
    key += 0x9E3779B9u;
  }
  out[0] = left;
  out[1] = right;
}
