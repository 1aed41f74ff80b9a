// The constants of a contact from its parameters: for tf_contact_prepare, and
// for tf_prepare, which has more laws.
#ifndef TF_PREPARED_H
#define TF_PREPARED_H

#include "twofold/contact.h"

// Ranges: of mu [N], kappa [m] and a rate [1/s].
#define MAX_MU 1e9
#define MIN_KAPPA 1e-9
#define MAX_KAPPA 1e6
#define MAX_RATE 1e9

// The tables of the angle kernel, and the constants of its multipliers.
#define tf_prepare_angle_kernel TF_LINK(tf_prepare_angle_kernel)
TF_API void tf_prepare_angle_kernel(tf_tyre_t *tyre, tf_real_t kappa);

// All that is not its tyre, which is complete.
#define tf_complete_contact TF_LINK(tf_complete_contact)
TF_API void tf_complete_contact(tf_contact_t *contact, tf_rest_law_t rest,
                                tf_rule_t rule, tf_real_t rate_dt);

#endif
