// The count of count.h against the processor's own: it stops after every
// instruction (trap flag) and Linux sends a signal each time. 16 us an
// instruction, so for a few calls only.
#ifndef COST_STEPPED_H
#define COST_STEPPED_H

#include "verify/cost/calls.h"

// Prints "tf_name counted stepped". Returns: 0 where they differ.
int print_stepped(const call_t *call, const subject_t *s);

#endif
