/// @file
/// Places of a static pool, which several threads may claim at the same time.
#ifndef TWOFOLD_FMU_CLAIM_H
#define TWOFOLD_FMU_CLAIM_H

#include <stdbool.h>

#if defined(_MSC_VER)
#include <intrin.h>
typedef volatile char fmu_claim_t;
static inline bool fmu_claim(fmu_claim_t *place) {
  return _InterlockedExchange8(place, 1) == 0;
}
static inline void fmu_release(fmu_claim_t *place) {
  (void)_InterlockedExchange8(place, 0);
}
static inline bool fmu_claimed(const fmu_claim_t *place) { return *place != 0; }
#else
typedef char fmu_claim_t;
static inline bool fmu_claim(fmu_claim_t *place) {
  return __atomic_exchange_n(place, 1, __ATOMIC_ACQUIRE) == 0;
}
static inline void fmu_release(fmu_claim_t *place) {
  __atomic_store_n(place, 0, __ATOMIC_RELEASE);
}
static inline bool fmu_claimed(const fmu_claim_t *place) {
  return __atomic_load_n(place, __ATOMIC_ACQUIRE) != 0;
}
#endif

#endif
