// Which of several consistent modes a step takes: the rules are declared at
// tf_rule_t (machine.h). Of the modes of `solutions`, under `rule`, after the
// present mode: a tf_mode_t of solutions->set, or TF_NO_MODE where none of it
// is admissible. exit_threshold is the probability to leave in this step times
// 2^63, tick and seed are counter and key of the draw (RANDOM only).
#ifndef TF_SELECT_H
#define TF_SELECT_H

#include "inclusion.h"
#include "twofold/machine.h"

#define tf_select TF_LINK(tf_select)
TF_API unsigned tf_select(tf_rule_t rule, uint64_t exit_threshold,
                          const solutions_t *solutions, unsigned mode,
                          uint64_t tick, uint32_t seed);

#endif
