// The constants of a machine that depend on its step: for tf_prepare, and for
// what is left of a step.
#ifndef TF_STEP_LENGTH_H
#define TF_STEP_LENGTH_H

#include "../num/kernel.h"
#include "twofold/machine.h"

// The shortest step of a machine [s].
#define MIN_STEP TF_R(1e-9)

// The chance of an exit stays that of a whole step: one draw decides it.
TF_INLINE void set_step_length(tf_machine_t *k, tf_real_t dt) {
  const tf_real_t theta_dt = k->theta * dt;
  const tf_real_t a = theta_dt * (k->c2 + theta_dt * k->k2);
  k->dt = dt;
  k->theta_dt = theta_dt;
  k->explicit_dt = dt - theta_dt;
  k->a = a;
  k->d_a = k->d * a;
  k->m_plus_a = k->m + a;
  k->m_a_d2 = k->m * a * k->d * k->d;
  k->inertia = k->m * k->beta2 + theta_dt * k->c1;
  k->inv_mu_dt = inverse_or_0(k->contact.tyre.mu * dt);
}

#endif
