/// @file
/// Several contacts of one mechanism: every joint future of a step. A contact
/// that is alone takes contact.h, which is faster. Contact after contact finds
/// too few: a force of one contact changes which modes another may have.
#ifndef TWOFOLD_CONTACTS_H
#define TWOFOLD_CONTACTS_H

#include "twofold/contact.h"

TF_BEGIN_C

/// Most contacts, and multipliers m = (x_0, y_0, x_1, y_1, ...) of n.
#define TF_CONTACTS 4
#define TF_MULTIPLIERS(n) (2 * (n))

/// Numbers of one form: h_i or g_i at the end of the step [m/s] as
/// c + sum over a of b_a m_a + sum over a <= b of q_ab m_a m_b, in this order:
///   c, b_0 ... b_(2n-1), q_00, q_01, q_11, q_02, q_12, q_22, q_03 ...
/// The forms of a mechanism are an array forms[n][2][TF_TERMS(n)]: h_0, g_0,
/// h_1, g_1, ... For n = 1 a form is a tf_form_t. Products may be 0: they make
/// a step of second order where the directions of h and g turn.
#define TF_TERMS(n) (((size_t)(n) + 1) * (2 * (size_t)(n) + 1))

/// A mode of each contact, all at once. Of slip the multipliers are those at
/// h -> 0, but the law at `now` where h cannot come to 0 in this step.
typedef struct {
  uint8_t mode[TF_CONTACTS]; ///< tf_mode_t of each contact
  uint8_t attracting; ///< bit i: contact i sticks, and a small h_i decays while
                      ///< the other contacts keep their modes
  uint8_t near_plus;  ///< bit i: g_i > 0 is the present side: decides a tie
  uint16_t points;    ///< solutions with these modes
  tf_real_t x[TF_CONTACTS], y[TF_CONTACTS]; ///< multipliers F/mu, M/(kappa mu)
  tf_real_t h[TF_CONTACTS], g[TF_CONTACTS]; ///< slips at the end [m/s]
} tf_joint_mode_t;

/// Every joint mode in which a step may end, in the order of their modes, of
/// the last contact first. Of several solutions with the same modes: the slip
/// whose g keeps its side, then the one with the least sum of |x| + |y|.
/// Redundant contacts: forces are not unique though the motion is; reported are
/// those with the least sum of squares of x and y, or, where the law forbids
/// these, some away from its borders.
/// n: in, 1 to TF_CONTACTS. contacts, forms, now: in, [n] each, slips before
///   the step [m/s]. found: out, [room]. count: out, how many there are; of
///   more than `room` the first `room` are in found.
/// Returns: TF_OK; TF_COARSE: products so large that a solution may be missing;
///   TF_BAD_PARAMETER: n, or h_i of a COULOMB contact grows with x_i (see
///   tf_contact_modes); TF_BAD_STATE: not finite (both untouched).
/// Trust: under the hull there is always one. A solution is certain unless a
///   change of the coefficients by 64 epsilon lets it vanish (in float one in
///   200 of redundant contacts is lost).
#define tf_contacts_modes TF_LINK(tf_contacts_modes)
TF_API tf_status_t tf_contacts_modes(unsigned n, const tf_contact_t *contacts,
                                     const tf_real_t *forms,
                                     const tf_slip_t *now,
                                     tf_joint_mode_t *found, unsigned room,
                                     unsigned *count);

/// The joint mode that the rules take. Contacts choose in the order of their
/// index, each by tf_contact_choose among the joint modes that are left. No
/// slip enters a stick that does not attract.
/// found, count: in, all joint modes. modes: in, [n], before the step, or
///   TF_NO_MODE. tick, seed: in, counter and key of the draw; contact i draws
///   with key seed + i.
/// Returns: the index in found; count where none is admissible.
#define tf_contacts_choose TF_LINK(tf_contacts_choose)
TF_API unsigned tf_contacts_choose(unsigned n, const tf_contact_t *contacts,
                                   const tf_joint_mode_t *found, unsigned count,
                                   const uint8_t *modes, uint64_t tick,
                                   uint32_t seed);

/// Mean forces of a step that ends in a joint mode: in slip those of the law at
/// `at`, but those at h -> 0 where the law would carry h across 0; in stick and
/// pinned those that keep h, or h and g, at 0 beside them.
/// joint: in, of found; NULL: none was admissible. at: in, [n], slips of the
///   law: at the theta point, or at the start. force: out, [n].
/// Returns: TF_OK; TF_DEGRADED: joint is NULL: the law of slip at `at`;
///   TF_BAD_PARAMETER: n; TF_BAD_STATE: not finite (force untouched).
#define tf_contacts_force TF_LINK(tf_contacts_force)
TF_API tf_status_t tf_contacts_force(unsigned n, const tf_contact_t *contacts,
                                     const tf_real_t *forms,
                                     const tf_joint_mode_t *joint,
                                     const tf_slip_t *at, tf_force_t *force);

TF_END_C

#endif
