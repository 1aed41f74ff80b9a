/// @file
/// Many independent states of one machine under one input, stepped together:
/// the bits of tf_step for each of them, in a fraction of the time on a
/// processor with vector instructions (double: SSE4.2 or more). For statistics
/// over starts and seeds.
#ifndef TWOFOLD_ENSEMBLE_H
#define TWOFOLD_ENSEMBLE_H

#include "twofold/step.h"

TF_BEGIN_C

/// An ensemble of n states is an array of TF_BLOCKS(n) blocks; state i is lane
/// i % TF_LANES of block i / TF_LANES.
#define TF_LANES 16
#define TF_BLOCKS(n) (((n) + TF_LANES - 1) / TF_LANES)

/// tf_state_t of TF_LANES states: member by member, units and ranges there.
typedef struct {
  tf_real_t r[TF_LANES], v[TF_LANES], w[TF_LANES], phi[TF_LANES];
  uint64_t tick[TF_LANES];
  uint32_t seed[TF_LANES];
  uint8_t mode[TF_LANES]; ///< tf_mode_t
} tf_state_block_t;

/// tf_report_t of TF_LANES states: member by member, units there.
typedef struct {
  tf_real_t F[TF_LANES], M[TF_LANES];               ///< force [N], [N m]
  tf_real_t h[TF_LANES], g[TF_LANES];               ///< slip [m/s]
  tf_real_t delassus[TF_LANES], residual[TF_LANES]; ///< [1/kg], [N]
  uint8_t mode[TF_LANES], set[TF_LANES], choices[TF_LANES];
  int8_t status[TF_LANES]; ///< tf_status_t
} tf_report_block_t;

/// Writes one state of an ensemble; the other lanes stay as they are.
/// blocks: out, TF_BLOCKS(n). index: in, 0 to n - 1. state: in, from tf_begin.
#define tf_ensemble_put TF_LINK(tf_ensemble_put)
TF_API void tf_ensemble_put(tf_state_block_t *blocks, size_t index,
                            const tf_state_t *state);

/// Reads one state of an ensemble, index 0 to n - 1.
#define tf_ensemble_get TF_LINK(tf_ensemble_get)
TF_API tf_state_t tf_ensemble_get(const tf_state_block_t *blocks, size_t index);

/// Reads the report of one state of an ensemble, likewise.
#define tf_ensemble_report TF_LINK(tf_ensemble_report)
TF_API tf_report_t tf_ensemble_report(const tf_report_block_t *blocks,
                                      size_t index);

/// Advances n states by dt, each as tf_step does, bit for bit: state, report
/// and status. A state that is refused stays as it is and does not stop the
/// others. Under the law TF_TYRE_JUMP whole blocks go without branches; what
/// needs one (mode lost, refusal, no consistent mode) is done lane by lane by
/// tf_step, and so are other laws and a last block that is not full.
/// machine, input: in. n: in, number of states, 0 or more.
/// states: in/out, TF_BLOCKS(n) blocks of states from tf_begin. reports: out,
///   as many. Lanes beyond n are neither read nor written.
/// Returns: how many lanes were done by tf_step, one by one, which costs more.
/// Trust: that of tf_step, whose bits it has.
#define tf_ensemble_step TF_LINK(tf_ensemble_step)
TF_API size_t tf_ensemble_step(const tf_machine_t *machine,
                               tf_state_block_t *states, size_t n,
                               const tf_input_t *input,
                               tf_report_block_t *reports);

/// Takes several such steps of a block before the next, so that it stays in the
/// cache: the time of a step of a state is that of a small ensemble.
/// input: in, held, its alpha in the first step only. steps: in, 0 or more.
/// reports: out, of the last step. The others: as tf_ensemble_step.
/// Returns: as that, of all steps. Trust: that of tf_step, whose bits it has.
#define tf_ensemble_run TF_LINK(tf_ensemble_run)
TF_API size_t tf_ensemble_run(const tf_machine_t *machine,
                              tf_state_block_t *states, size_t n,
                              const tf_input_t *input, uint32_t steps,
                              tf_report_block_t *reports);

TF_END_C

#endif
