// Joint modes of two contacts, and what contact after contact finds: reads
// "kappa kappa", then for each of h_0, g_0, h_1, g_1 its value and its four
// slopes by x_0, y_0, x_1, y_1, then g_0 and g_1 before the step; h is 0 there.
// Prints how many joint modes there are, how many modes either contact has in
// the end, whether their pairs are the joint modes, and the sweeps.
#include <stdio.h>

#include "twofold.h"
#include "twofold/contacts.h"

#define SWEEPS 200
#define NUMBERS 24

typedef struct {
  tf_contact_t contact[2];
  tf_real_t forms[2][2][TF_TERMS(2)];
  tf_slip_t now[2];
} system_t;

static bool read_system(system_t *k) {
  double number[NUMBERS];
  for (unsigned i = 0; i < NUMBERS; i++)
    if (scanf("%lf", &number[i]) != 1) return false;
  const system_t none = {.now = {{0, 0}, {0, 0}}};
  *k = none;
  for (unsigned i = 0; i < 2; i++) {
    if (tf_contact_prepare(&k->contact[i], TF_TYRE_JUMP, 1,
                           (tf_real_t)number[i], TF_REST_HULL, TF_RULE_PERSIST,
                           0) != TF_OK)
      return false;
    k->now[i].g = (tf_real_t)number[22 + i];
    for (unsigned f = 0; f < 2; f++)
      for (unsigned t = 0; t < 5; t++)
        k->forms[i][f][t] = (tf_real_t)number[2 + 10 * i + 5 * f + t];
  }
  return true;
}

// A form of contact i alone, under the multipliers m of the other.
static tf_form_t alone(const tf_real_t form[], unsigned i,
                       const tf_real_t m[4]) {
  const unsigned own = 1 + 2 * i, other = 3 - 2 * i;
  return (tf_form_t){
      form[0] + form[other] * m[other - 1] + form[other + 1] * m[other],
      form[own],
      form[own + 1],
      0,
      0,
      0};
}

// Contact after contact until neither changes. Returns the sweeps.
static unsigned solve_in_turn(const system_t *k, unsigned set[2]) {
  tf_real_t m[4] = {0};
  unsigned mode[2] = {TF_NO_MODE, TF_NO_MODE}, sweep = 0;
  for (bool moved = true; moved && sweep < SWEEPS; sweep++) {
    moved = false;
    for (unsigned i = 0; i < 2; i++) {
      const tf_form_t h = alone(k->forms[i][0], i, m);
      const tf_form_t g = alone(k->forms[i][1], i, m);
      tf_real_t *own = &m[(size_t)2 * i];
      const tf_real_t x = own[0], y = own[1];
      tf_contact_modes_t modes;
      tf_force_t force;
      (void)tf_contact_modes(&k->contact[i], &h, &g, k->now[i], mode[i], &modes,
                             NULL);
      mode[i] = tf_contact_choose(&k->contact[i], &modes, mode[i], 1, 1);
      set[i] = modes.set;
      if (tf_contact_force(&k->contact[i], &h, &g, &modes, mode[i], k->now[i],
                           &force) < TF_OK)
        continue;
      own[0] = force.F;
      own[1] = force.M * k->contact[i].inv_kappa_mu;
      const tf_real_t dx = own[0] - x, dy = own[1] - y;
      moved = moved || dx * dx + dy * dy > TF_R(1e-20);
    }
  }
  return sweep;
}

int main(void) {
  system_t k;
  while (read_system(&k)) {
    tf_joint_mode_t found[TF_JOINT_ROOM(2)];
    unsigned count = 0, set[2] = {0, 0}, size[2] = {0, 0}, pairs = 0;
    (void)tf_contacts_modes(2, k.contact, k.forms[0][0], k.now, found,
                            TF_JOINT_ROOM(2), &count);
    const unsigned sweeps = solve_in_turn(&k, set);
    for (unsigned mode = 0; mode < TF_MODES; mode++)
      for (unsigned i = 0; i < 2; i++) size[i] += (set[i] >> mode) & 1u;
    for (unsigned j = 0; j < count; j++)
      pairs += (set[0] >> found[j].mode[0]) & (set[1] >> found[j].mode[1]) & 1u;
    printf("%u %u %d %u\n", count, size[0] * size[1],
           pairs == count && count == size[0] * size[1], sweeps);
  }
  return 0;
}
