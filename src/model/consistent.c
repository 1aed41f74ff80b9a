// The field of the machine at h = g = 0.
#include "consistent.h"

TF_API codim2_field_t tf_codim2_field_of(const tf_machine_t *k,
                                         const rates_t *rates) {
  const tf_slip_t free = slip_from_pq(k, rates->dp, rates->dq);
  const tf_slip_t F = slip_from_pq(k, rates->Fp, rates->Fq);
  const tf_slip_t M = slip_from_pq(k, 0, rates->Mq);
  const tf_contact_t *contact = &k->contact;
  const tf_real_t mu = contact->tyre.mu, kappa_mu = contact->kappa_mu;
  return (codim2_field_t){{free.h, mu * F.h, kappa_mu * M.h},
                          {free.g, mu * F.g, kappa_mu * M.g},
                          {rates->pinning.F * contact->inv_mu,
                           rates->pinning.M * contact->inv_kappa_mu}};
}
