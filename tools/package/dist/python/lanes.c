/* The lanes of an ensemble once more, for the vectors of AVX2. */
#if defined(__GNUC__) && defined(__x86_64__)
#pragma GCC target("avx2")
#define TF_API_STATIC
#include "twofold.c"

#define step_with_avx2 TF_LINK(tf_ensemble_step_avx2)
size_t step_with_avx2(const tf_machine_t *machine, tf_state_block_t *states,
                      size_t n, const tf_input_t *input,
                      tf_report_block_t *reports) {
  return tf_ensemble_step(machine, states, n, input, reports);
}
#endif
