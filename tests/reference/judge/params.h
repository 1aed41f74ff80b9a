/// @file
/// The parameters of a drawn machine, in the real type of who includes this.
#ifndef REFERENCE_PARAMS_H
#define REFERENCE_PARAMS_H

#include "machine.h"
#include "twofold.h"

static inline tf_params_t params_of(const lib_machine_t *q) {
  tf_params_t p = tf_scenes[0]->params;
  p.m = (tf_real_t)q->m;
  p.d = (tf_real_t)q->d;
  p.beta = (tf_real_t)q->beta;
  p.k2 = (tf_real_t)q->k2;
  p.c1 = (tf_real_t)q->c1;
  p.c2 = (tf_real_t)q->c2;
  p.r0 = (tf_real_t)q->r0;
  p.omega0 = (tf_real_t)q->omega0;
  p.mu = (tf_real_t)q->mu;
  p.kappa = (tf_real_t)q->kappa;
  p.gamma = (tf_real_t)q->gamma;
  p.dt = (tf_real_t)q->dt;
  p.rest = (tf_rest_law_t)q->rest;
  p.law = q->coulomb ? TF_TYRE_COULOMB : TF_TYRE_JUMP;
  return p;
}

#endif
