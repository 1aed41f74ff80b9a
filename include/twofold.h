/// @file
/// twofold: a fixed-step simulator of a machine whose friction is not always
/// deterministic. This umbrella header is all that a user includes:
/// scene -> prepare -> begin -> step(machine, state, input) -> report.
///
/// Of every function, unless it says otherwise: the caller owns all memory, and
/// no two arguments overlap; a pointer is kept only where it says "kept", so
/// that all are reentrant. A machine is one from tf_prepare, an input within
/// TF_STATE_LIMIT. Names are constant strings; of what an enum has not they
/// begin with "unknown". "(h)" and the like are equations of the paper, "(1)"
/// of DESIGN.md, which has both. Cost and stack of each: docs/bench/worst.csv,
/// which docs/BENCH.md explains.
#ifndef TWOFOLD_H
#define TWOFOLD_H

#include "twofold/command.h"
#include "twofold/compensated.h"
#include "twofold/design.h"
#include "twofold/ensemble.h"
#include "twofold/estimated.h"
#include "twofold/frame.h"
#include "twofold/link.h"
#include "twofold/located.h"
#include "twofold/machine.h"
#include "twofold/mode.h"
#include "twofold/philox.h"
#include "twofold/real.h"
#include "twofold/scene.h"
#include "twofold/simulation.h"
#include "twofold/singularity.h"
#include "twofold/status.h"
#include "twofold/step.h"
#include "twofold/surface.h"
#include "twofold/tally.h"
#include "twofold/telemetry.h"
#include "twofold/text.h"
#include "twofold/tyre.h"
#include "twofold/wire.h"

#define TF_VERSION "0.3.0"

#endif
