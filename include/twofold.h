/// @file
/// twofold: a fixed-step simulator of a machine whose friction is not always
/// deterministic. A user includes only this header. Order of use:
/// scene -> prepare -> begin -> step(machine, state, input) -> report.
///
/// For every function, unless it says otherwise: the caller owns all memory, no
/// two arguments overlap, and only pointers marked "kept" are kept. So all are
/// reentrant. Machines come from tf_prepare; inputs are within TF_STATE_LIMIT.
/// Functions that name a value return constant strings; for values outside an
/// enum these begin with "unknown". A letter, "(h)", is an equation of the
/// paper; a number, "(1)", one of DESIGN.md. Cost and stack of each function:
/// docs/bench/worst.csv, which docs/BENCH.md explains.
#ifndef TWOFOLD_H
#define TWOFOLD_H

#include "twofold/compensated.h" // tf_step_compensated: float, small steps
#include "twofold/contact.h"     // tf_contact_modes: your own mechanism
#include "twofold/contacts.h"    // tf_contacts_modes: with several contacts
#include "twofold/ensemble.h"    // tf_ensemble_step: many states at once
#include "twofold/frame.h"       // tf_frame_seal, tf_decoder_block
#include "twofold/link.h"        // tf_link_receive: commands to a board
#include "twofold/located.h"     // tf_step_located: from event to event
#include "twofold/machine.h"     // tf_prepare, tf_slip, tf_energy
#include "twofold/real.h"        // tf_real_t, TF_R
#include "twofold/simulation.h"  // tf_simulation_open: inputs that a host sets
#include "twofold/singularity.h" // tf_two_folds, tf_normal_form
#include "twofold/status.h"      // tf_status_t, tf_arithmetic
#include "twofold/step.h"        // tf_begin, tf_step, tf_report_t
#include "twofold/telemetry.h"   // tf_send_state, tf_read_state
#include "twofold/tyre.h"        // tf_tyre_force: the laws of friction

#define TF_VERSION "0.3.0"

#endif
