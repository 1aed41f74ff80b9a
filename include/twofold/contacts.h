/// @file
/// Several contacts of one mechanism: every joint future of a step. Solving
/// them in turn misses futures: the force of one changes the modes of others.
/// For one contact, contact.h is faster.
#ifndef TWOFOLD_CONTACTS_H
#define TWOFOLD_CONTACTS_H

#include "twofold/contact.h"

TF_BEGIN_C

/// Most contacts. n contacts have 2 n multipliers m = (x_0, y_0, x_1, y_1 ...).
#define TF_CONTACTS 4
#define TF_MULTIPLIERS(n) (2 * (n))

/// Room for all joint modes: TF_MODES^n.
#define TF_JOINT_ROOM(n) ((n) == 1 ? 5 : (n) == 2 ? 25 : (n) == 3 ? 125 : 625)

/// A form is h_i or g_i at the end of the step [m/s] in the multipliers:
///   c + sum over a of b_a m_a + sum over a <= b of q_ab m_a m_b
/// It is an array of TF_TERMS(n) numbers:
///   [0] c    [1 + a] b_a    [TF_PRODUCT(n, a, b)] q_ab, a <= b
/// The forms of a mechanism are an array forms[n][2][TF_TERMS(n)], passed as
/// forms[0][0], in the order h_0, g_0, h_1, g_1, ... For n = 1 a form has the
/// layout of tf_form_t. The products q may be 0. With them a step is of second
/// order where the directions of h and g turn.
#define TF_TERMS(n) (((size_t)(n) + 1) * (2 * (size_t)(n) + 1))
#define TF_PRODUCT(n, a, b) \
  (1 + 2 * (size_t)(n) + (size_t)(b) * ((size_t)(b) + 1) / 2 + (size_t)(a))

/// One mode for each contact. They hold together.
typedef struct {
  uint8_t mode[TF_CONTACTS]; ///< tf_mode_t of each contact
  uint8_t attracting; ///< bit i: contact i sticks, and a small h_i decays while
                      ///< the other contacts keep their modes
  uint8_t near_plus;  ///< bit i: the present side of g_i is g_i > 0: it decides
                      ///< between stick+ and stick-
  uint16_t points;    ///< how many solutions have these modes; here is one
  /// F/mu and M/(kappa mu). In slip: the limit at h -> 0, or the law at `now`
  /// where h cannot come to 0 in this step.
  tf_real_t x[TF_CONTACTS], y[TF_CONTACTS];
  tf_real_t h[TF_CONTACTS], g[TF_CONTACTS]; ///< slips at the end [m/s]
} tf_joint_mode_t;

/// Finds every joint mode in which a step may end. They are sorted by the mode
/// of the last contact, then of the one before it, and so on.
/// n: in, 1 to TF_CONTACTS. contacts, forms: in. now: in, [n], slips before the
///   step [m/s]. found: out, [room], the first `room` joint modes. count: out,
///   how many there are, also where that is more than room.
/// Returns: TF_OK; TF_COARSE: a solution may be missing: products are large, or
///   redundant contacts have products, or `found` is empty under TF_REST_HULL,
///   where one exists; TF_BAD_PARAMETER: n, or h_i of a COULOMB contact grows
///   with x_i (see tf_contact_modes); TF_BAD_STATE: not finite (found and count
///   untouched).
/// Several solutions may have the same modes. The one in `found` keeps the
///   present side of g in slip; of those, it has the least sum of |x| + |y|.
/// Redundant contacts: the motion is unique, not the forces. `found` has those
///   of the least sum of squares, or some well inside the law. Rest holds to
///   within 256 epsilon. Leave products out: with them a plate that rests on
///   three wheels is TF_COARSE, in no mode (1 of 4 states) or several (1 of 5).
/// Trust: TF_OK misses only what a change of the coefficients by 64 epsilon
///   removes; in float also one of 1,000 joint modes of redundant contacts.
/// Cost: for n = 2 a Cortex-M4F takes 1e5 instructions on average, and up to
///   2e7 were found (docs/BENCH.md): no step is promised to end in 1 ms.
/// h_i = g_i = 0: the next step finds how contact i leaves by the limits at
///   h_i -> 0. For the law itself, which may differ, eliminate from h_i and g_i
///   the multipliers of the others in a joint mode, and call tf_contact_leave.
#define tf_contacts_modes TF_LINK(tf_contacts_modes)
TF_API tf_status_t tf_contacts_modes(unsigned n, const tf_contact_t *contacts,
                                     const tf_real_t *forms,
                                     const tf_slip_t *now,
                                     tf_joint_mode_t *found, unsigned room,
                                     unsigned *count);

/// Takes one joint mode. Contact 0 chooses first, by tf_contact_choose and its
/// own rule; then contact 1 among the joint modes that are left, and so on. No
/// slip enters a stick that does not attract.
/// found, count: in, all joint modes; count <= room. modes: in, [n], before the
///   step, <= TF_NO_MODE. tick, seed: in, counter and key of a draw (seed + i).
/// Returns: the index in found; count where none is admissible, or n is wrong.
#define tf_contacts_choose TF_LINK(tf_contacts_choose)
TF_API unsigned tf_contacts_choose(unsigned n, const tf_contact_t *contacts,
                                   const tf_joint_mode_t *found, unsigned count,
                                   const uint8_t *modes, uint64_t tick,
                                   uint32_t seed);

/// The mean forces of a step that ends in a joint mode. A contact that slips
/// has the force of the law at `at`, but the limit at h -> 0 where that would
/// carry h across 0. One that sticks or is pinned has the force that keeps h,
/// or h and g, at 0 while those forces act.
/// joint: in, found with these forms; NULL if none was chosen. force: out, [n].
/// at: in, [n], slip where the law is read: at the start (order 1) or mid-step.
/// Returns: TF_OK; TF_DEGRADED: joint is NULL: the law of slip at `at`;
///   TF_BAD_PARAMETER: n; TF_BAD_STATE: not finite, bad joint (no output).
#define tf_contacts_force TF_LINK(tf_contacts_force)
TF_API tf_status_t tf_contacts_force(unsigned n, const tf_contact_t *contacts,
                                     const tf_real_t *forms,
                                     const tf_joint_mode_t *joint,
                                     const tf_slip_t *at, tf_force_t *force);

TF_END_C

#endif
