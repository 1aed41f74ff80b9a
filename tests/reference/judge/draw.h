/// @file
/// Random machines from wide ranges, and how to run one again.
#ifndef REFERENCE_DRAW_H
#define REFERENCE_DRAW_H

#include <stdint.h>

#include "library.h"
#include "reference.h"

typedef ref_real_t real_t;

/// A random sequence; machine i of a seed has its own.
typedef struct {
  uint64_t state;
} draw_t;

draw_t draw_begin(uint64_t seed, uint64_t index);
/// Uniform in [low, high).
double draw_uniform(draw_t *draw, double low, double high);
/// Logarithm uniform; low > 0.
double draw_log(draw_t *draw, double low, double high);
/// Machine with a start near h = g = 0, on h = 0 or anywhere. All numbers but
/// special angles are floats. `extreme`: m, beta, k2 and mu towards the ends of
/// their ranges in half of the machines.
lib_machine_t draw_machine(draw_t *draw, bool extreme);
/// The reference's machine and start. In `real` float the parameters are
/// rounded as the float build does.
ref_machine_t draw_reference(const lib_machine_t *machine,
                             const lib_table_t *real);
ref_state_t draw_start(const lib_machine_t *machine, const ref_machine_t *q,
                       const lib_table_t *real);
/// Prints the command that replays a run of the library.
void draw_print(const lib_machine_t *machine, double t_end, const char *scheme);

#endif
