// The joint modes of contacts that share a mechanism: the enumeration behind
// twofold/contacts.h.
#ifndef TF_JOINT_H
#define TF_JOINT_H

#include "outlook.h"

TF_INLINE bool slips_by_law(const mechanism_t *k, unsigned i) {
  return (k->slips >> i) & 1u;
}

TF_INLINE bool has_moment(const mechanism_t *k, unsigned i) {
  return k->contacts[i].stick_kappa > 0;
}

// From now on contact i slips to that side, by the law at a slip.
TF_INLINE void slip_with_law(mechanism_t *k, unsigned i, sign_t side,
                             tf_slip_t at) {
  k->slips |= 1u << i;
  k->law[i] = slip_multipliers(&k->contacts[i].tyre, side, at, true);
}

// Fills what the products of each form add.
#define tf_bound_products TF_LINK(tf_bound_products)
TF_API void tf_bound_products(mechanism_t *k);

// Whether h_i can come to 0: by how much it moves, free and under all forces.
#define tf_comes_to_h_0 TF_LINK(tf_comes_to_h_0)
TF_API bool tf_comes_to_h_0(const mechanism_t *k, unsigned i, tf_real_t now);

// All joint modes. found: out, [room]. count: out. Returns false where one may
// be missing.
#define tf_joint_modes TF_LINK(tf_joint_modes)
TF_API bool tf_joint_modes(const mechanism_t *k, tf_joint_mode_t found[],
                           unsigned room, unsigned *count);

// Balances the contacts that do not slip by law beside those that do. m: in, a
// guess; out, multipliers. h: out, of each contact. Returns whether it holds.
#define tf_balance_contacts TF_LINK(tf_balance_contacts)
TF_API bool tf_balance_contacts(const mechanism_t *k, const unsigned mode[],
                                tf_real_t m[MULTIPLIERS],
                                tf_real_t h[TF_CONTACTS]);

#endif
