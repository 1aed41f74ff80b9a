// Steps of 1 to 4 contacts of random mechanisms, each between two markers for
// the counter of the emulator: all joint modes, one of them, and its forces.
// tools/bench/contacts.py reads the counts.
#include "twofold/contacts.h"

#include <string.h>

#include "../../port/core.h"
#include "../../port/port.h"

// Forces that act through an inverse mass matrix; with fewer freedoms than
// slips; two contacts that are one. Products: 2^-10 of the slopes.
enum { MASSES, FEW, TWINS, KINDS };
#define FREEDOMS (2 * TF_CONTACTS + 1)

typedef struct {
  tf_contact_t contact[TF_CONTACTS];
  tf_real_t forms[(size_t)2 * TF_CONTACTS * TF_TERMS(TF_CONTACTS)];
  tf_slip_t now[TF_CONTACTS];
} system_t;

static uint32_t dice = 1;

static unsigned bits(void) {
  dice ^= dice << 13;
  dice ^= dice >> 17;
  dice ^= dice << 5;
  return dice >> 8;
}

static tf_real_t any(tf_real_t most) {
  const unsigned drawn = bits();
  return most * ((tf_real_t)drawn * TF_R(0x1p-23) - 1);
}

static void draw(system_t *k, unsigned n, unsigned kind) {
  const size_t terms = TF_TERMS(n);
  const unsigned freedoms =
      kind == FEW ? 2 + bits() % (2 * n - 1) : 2 * n + bits() % 2;
  tf_real_t row[2 * TF_CONTACTS][FREEDOMS], force[2 * TF_CONTACTS][FREEDOMS];
  for (unsigned i = 0; i < n; i++) {
    (void)tf_contact_prepare(
        &k->contact[i], bits() % 5 ? TF_TYRE_JUMP : TF_TYRE_COULOMB, 1,
        TF_R(0.55) + any(TF_R(0.5)), TF_REST_HULL, TF_RULE_PERSIST, 0);
    k->now[i] = (tf_slip_t){any(TF_R(0.2)), any(1)};
  }
  for (unsigned f = 0; f < 2 * n; f++)
    for (unsigned d = 0; d < freedoms; d++)
      row[f][d] = any(1), force[f][d] = f % 2 ? any(TF_R(0.6)) : -row[f][d];
  for (unsigned f = 0; f < 2 * n; f++) {
    tf_real_t *form = k->forms + f * terms, size = 0;
    for (unsigned b = 0; b < 2 * n; b++) {
      form[1 + b] = 0;
      for (unsigned d = 0; d < freedoms; d++)
        form[1 + b] += row[f][d] * force[b][d];
      size += form[1 + b] < 0 ? -form[1 + b] : form[1 + b];
    }
    form[0] = any(TF_R(0.7)) * size;
    for (size_t t = 1 + 2 * n; t < terms; t++)
      form[t] = any(TF_R(0x1p-10)) * size;
    if (kind == TWINS && f > 1)
      memcpy(form, form - 2 * terms, terms * sizeof *form);
  }
}

void window_open(void);
void window_close(void);

__attribute__((noinline)) void window_open(void) { __asm__ volatile(""); }
__attribute__((noinline)) void window_close(void) { __asm__ volatile(""); }

int main(void) {
  static const unsigned draws[] = {2000, 2000, 200, 20};
  static const uint8_t none[] = {TF_NO_MODE, TF_NO_MODE, TF_NO_MODE,
                                 TF_NO_MODE};
  static tf_joint_mode_t found[TF_JOINT_ROOM(TF_CONTACTS)];
  static system_t k;
  tf_force_t by[TF_CONTACTS];
  unsigned count = 0;
  port_init();
  window_open();
  window_close();
  for (unsigned n = 1; n <= TF_CONTACTS; n++)
    for (unsigned i = 0; i < (n < 3 ? KINDS : TWINS) * draws[n - 1]; i++) {
      draw(&k, n, i / draws[n - 1]);
      window_open();
      (void)tf_contacts_modes(n, k.contact, k.forms, k.now, found, 625, &count);
      const unsigned at =
          tf_contacts_choose(n, k.contact, found, count, none, 1, 1);
      (void)tf_contacts_force(n, k.contact, k.forms,
                              at < count ? &found[at] : NULL, k.now, by);
      window_close();
    }
  port_halt(0);
}
