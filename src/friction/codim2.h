// What follows h = g = 0: every future that is consistent there, and the one
// that is taken. Every step asks this one function.
//
// Near that point h and g are rho sin(angle) and rho cos(angle), and their
// rates depend on the angle alone: rho' = R(angle), rho angle' = T(angle). So a
// motion reaches or leaves the point along a zero of T, a limit direction
// (Antali and Stepan 2018), or in stick; one with R > 0 leaves. A direction to
// which its neighbours turn attracts, as does a stick with a positive Delassus
// scalar. Stick that arrives goes on, at rest, where its law, the bow tie,
// holds the wheel. Other motion runs into a rest unless one of those that
// attract leaves: then it runs there.
#ifndef TF_CODIM2_H
#define TF_CODIM2_H

#include "consistent.h"
#include "quadrant.h"

// That of an instant.
#define tf_codim2_field_of TF_LINK(tf_codim2_field_of)
TF_API codim2_field_t tf_codim2_field_of(const tf_machine_t *k,
                                         const rates_t *rates);

// The limit direction of one quadrant of the (g, h) plane to which a slip near
// h = g = 0 turns, whether it falls in or leaves: its T = cot(psi). False where
// there is none.
#define tf_codim2_attractor TF_LINK(tf_codim2_attractor)
TF_API bool tf_codim2_attractor(const tf_machine_t *k,
                                const codim2_field_t *field, int sign_g,
                                int sign_h, tf_real_t *T);

// A limit direction or a stick that leads to or from h = g = 0.
typedef struct {
  unsigned mode;       // TF_MODES: none
  tf_slip_t along;     // direction, of length 1
  multipliers_t under; // of its force
  tf_real_t rate;      // rho', negative where it leads in
} codim2_way_t;

// The one that attracts a slip near h = g = 0 with this sign of h; none where
// it turns round and round.
#define tf_codim2_destination TF_LINK(tf_codim2_destination)
TF_API codim2_way_t tf_codim2_destination(const tf_machine_t *k,
                                          const codim2_field_t *field,
                                          tf_slip_t slip, int sign_h);

// The consistent modes at h = g = 0 under a law with a moment. Of the slips on
// one side of h = 0 it is the one that attracts, then the one that grows
// faster. `attracting` has the slips that attract as well, h_limit their rho',
// and near_stick is the faster stick.
#define tf_codim2_modes TF_LINK(tf_codim2_modes)
TF_API void tf_codim2_modes(const tf_machine_t *k, const codim2_field_t *field,
                            consistent_modes_t *out);

// The modes, and the one of them that the declared rule takes (tf_rule_t).
// from: the mode of the motion. arrives: it comes there, and has lost its mode;
// else it is there, and keeps its mode as the rule says. TF_NO_MODE where there
// is none. `attracting` then has pinned too where a stick goes on in it.
#define tf_leave_codim2 TF_LINK(tf_leave_codim2)
TF_API unsigned tf_leave_codim2(const tf_machine_t *k,
                                const codim2_field_t *field, unsigned from,
                                bool arrives, const tf_state_t *state,
                                consistent_modes_t *out);

#endif
