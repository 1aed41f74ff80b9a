// Several contacts: their joint modes, the choice among them, the forces.
#include "joint.h"

// Returns whether all numbers are finite.
static bool set_up(mechanism_t *k, unsigned n, const tf_contact_t *contacts,
                   const tf_real_t *forms, const tf_slip_t *now) {
  tf_real_t size = 0;
  *k = (mechanism_t){.count = 2 * n,
                     .terms = (unsigned)TF_TERMS(n),
                     .contacts = contacts,
                     .forms = forms};
  for (unsigned f = 0; f < 2 * n * k->terms; f++) size += magnitude(forms[f]);
  for (unsigned i = 0; i < n; i++) {
    size += magnitude(now[i].h) + magnitude(now[i].g);
    const tf_real_t g_free = numbers_of_form(k, 2 * i + 1)[0];
    if (is_nearer_plus(now[i].g, g_free)) k->near_plus |= 1u << i;
  }
  return within(size, TF_REAL_MAX);
}

// One contact, by contact.h.
static void modes_of_one(const mechanism_t *k, tf_slip_t now,
                         tf_joint_mode_t found[], unsigned room,
                         unsigned *count) {
  const tf_real_t *f = k->forms;
  const tf_form_t h = {f[0], f[1], f[2], f[3], f[4], f[5]},
                  g = {f[6], f[7], f[8], f[9], f[10], f[11]};
  tf_contact_modes_t modes = {.set = 0};
  (void)tf_contact_modes(k->contacts, &h, &g, now, TF_NO_MODE, &modes, NULL);
  *count = size_of(modes.set);
  for (unsigned mode = 0, at = 0; mode < TF_MODES && at < room; mode++) {
    if (!has(modes.set, mode)) continue;
    const multipliers_t m =
        tf_mode_multipliers(k->contacts, &h, &g, &modes, mode);
    found[at] = (tf_joint_mode_t){
        .mode = {(uint8_t)mode},
        .attracting = is_stick(mode) && has(modes.attracting, mode),
        .near_plus = modes.near_stick == TF_STICK_PLUS,
        .points = 1,
        .x = {m.x},
        .y = {has_moment(k, 0) ? m.y : with_sign(sign_of(m.y), 0)},
        .h = {is_slip(mode) ? modes.departure[sign_in(mode)] : 0},
        .g = {mode == TF_PINNED ? 0 : form_value(&g, m.x, m.y)}};
    at++;
  }
}

TF_API tf_status_t tf_contacts_modes(unsigned n, const tf_contact_t *contacts,
                                     const tf_real_t *forms,
                                     const tf_slip_t *now,
                                     tf_joint_mode_t *found, unsigned room,
                                     unsigned *count) {
  mechanism_t k;
  bool may_be_empty = false;
  if (n - 1 >= TF_CONTACTS) return TF_BAD_PARAMETER;
  if (!set_up(&k, n, contacts, forms, now)) return TF_BAD_STATE;
  for (unsigned i = 0; i < n; i++) {
    may_be_empty = may_be_empty || contacts[i].rest != TF_REST_HULL;
    const tf_real_t *own = numbers_of_form(&k, 2 * i) + 1 + X_OF(i);
    if (drives_itself(&contacts[i], own[0], own[1])) return TF_BAD_PARAMETER;
  }
  if (n == 1) {
    modes_of_one(&k, now[0], found, room, count);
    return TF_OK;
  }
  tf_bound_products(&k);
  for (unsigned i = 0; i < n; i++)
    if (!tf_comes_to_h_0(&k, i, now[i].h))
      slip_with_law(&k, i, sign_of(now[i].h), now[i]);
  const bool is_sure = tf_joint_modes(&k, found, room, count);
  return is_sure && (*count > 0 || may_be_empty) ? TF_OK : TF_COARSE;
}

// Whether a joint mode is admissible after the modes before, and has what the
// first contacts chose: modes, with a bit if they attract.
#define ATTRACTS 8u
static bool is_left(const tf_joint_mode_t *joint, unsigned n,
                    const uint8_t *before, const unsigned chosen[],
                    unsigned choices) {
  bool left = true;
  for (unsigned i = 0; i < n; i++) {
    const unsigned mode = joint->mode[i];
    const unsigned attracts = (joint->attracting >> i) & 1u ? ATTRACTS : 0;
    left = left && (attracts || !is_stick(mode) || !is_slip(before[i])) &&
           (i >= choices || chosen[i] == (mode | attracts));
  }
  return left;
}

TF_API unsigned tf_contacts_choose(unsigned n, const tf_contact_t *contacts,
                                   const tf_joint_mode_t *found, unsigned count,
                                   const uint8_t *modes, uint64_t tick,
                                   uint32_t seed) {
  unsigned chosen[TF_CONTACTS], choice = 0;
  if (n - 1 >= TF_CONTACTS) return count;
  for (unsigned i = 0; i < n; i++) {
    tf_contact_modes_t left = {.set = 0};
    if (modes[i] > TF_NO_MODE) return count;
    for (unsigned j = 0; j < count; j++) {
      const unsigned mode = found[j].mode[i];
      const sign_t s = sign_in(mode);
      if (!is_left(&found[j], n, modes, chosen, i)) continue;
      left.set |= (uint8_t)TF_MODE_BIT(mode);
      left.near_stick =
          (found[j].near_plus >> i) & 1u ? TF_STICK_PLUS : TF_STICK_MINUS;
      if ((found[j].attracting >> i) & 1u)
        left.attracting |= (uint8_t)TF_MODE_BIT(mode);
      if (is_slip(mode) &&
          magnitude(found[j].h[i]) > magnitude(left.departure[s]))
        left.departure[s] = found[j].h[i];
    }
    const unsigned mode =
        tf_contact_choose(&contacts[i], &left, modes[i], tick, seed + i);
    if (mode == TF_NO_MODE) return count;
    chosen[i] = mode | (has(left.attracting, mode) ? ATTRACTS : 0);
  }
  while (!is_left(&found[choice], n, modes, chosen, n)) choice++;
  return choice;
}

// Puts the law at `at` into the slips of a joint mode that are not `limited`,
// and balances the others beside them. Returns the slips that it would carry
// across h = 0; all where the others do not balance.
static unsigned balance(mechanism_t *k, const tf_joint_mode_t *joint,
                        const tf_slip_t *at, unsigned limited,
                        tf_real_t m[MULTIPLIERS]) {
  unsigned mode[TF_CONTACTS] = {0}, crossed = 0;
  tf_real_t h[TF_CONTACTS];
  k->slips = 0;
  for (unsigned i = 0; i < k->count / 2; i++) {
    mode[i] = joint->mode[i];
    m[X_OF(i)] = joint->x[i];
    m[Y_OF(i)] = joint->y[i];
    if (is_slip(mode[i])) slip_with_law(k, i, sign_in(mode[i]), at[i]);
    if ((limited >> i) & 1u)
      k->law[i] = (multipliers_t){joint->x[i], joint->y[i]};
  }
  if (!tf_balance_contacts(k, mode, m, h)) return ~limited;
  for (unsigned i = 0; i < k->count / 2; i++)
    if (is_slip(mode[i]) && !(with_sign(sign_in(mode[i]), h[i]) > 0))
      crossed |= (limited >> i) & 1u ? ~limited : 1u << i;
  return crossed;
}

TF_API tf_status_t tf_contacts_force(unsigned n, const tf_contact_t *contacts,
                                     const tf_real_t *forms,
                                     const tf_joint_mode_t *joint,
                                     const tf_slip_t *at, tf_force_t *force) {
  mechanism_t k;
  tf_real_t m[MULTIPLIERS] = {0};
  unsigned limited = ~0u;
  if (n - 1 >= TF_CONTACTS) return TF_BAD_PARAMETER;
  if (!set_up(&k, n, contacts, forms, at)) return TF_BAD_STATE;
  for (unsigned i = 0; i < n; i++) {
    if (joint != NULL && (joint->mode[i] >= TF_MODES ||
                          !within(joint->x[i], 2) || !within(joint->y[i], 2)))
      return TF_BAD_STATE;
    slip_with_law(&k, i, sign_of(at[i].h), at[i]);
    if (joint != NULL && is_slip(joint->mode[i])) limited = 0;
  }
  for (unsigned crossed = 1; limited != ~0u && crossed != 0;) {
    crossed = balance(&k, joint, at, limited, m);
    limited |= crossed;
  }
  for (unsigned i = 0; i < n; i++) {
    multipliers_t of = {m[X_OF(i)], m[Y_OF(i)]};
    if (limited == ~0u)
      of = joint == NULL ? k.law[i] : (multipliers_t){joint->x[i], joint->y[i]};
    force[i] = force_under(&contacts[i], of);
  }
  return joint == NULL ? TF_DEGRADED : TF_OK;
}
