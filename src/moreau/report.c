// How far a step can be trusted, by what it has recorded. They are functions of
// their own, which a step ends with, so that they need no registers of it.
#include "report.h"

#include "../model/rates.h"

// Accelerations.
typedef struct {
  tf_real_t dp, dz;
} end_rates_t;

// What the terms of p' and z' amount to without their signs: a share of it is
// what rounding makes of an equilibrium. `speed` bounds the terms of v.
static end_rates_t terms_of_rates(const tf_machine_t *k, const tf_input_t *u,
                                  const tf_state_t *x, tf_real_t speed,
                                  tf_force_t force) {
  const force_terms_t size =
      force_terms(k, u, magnitude(u->r0) + magnitude(x->r), x->r, speed, x->w);
  const tf_real_t d = magnitude(k->d);
  const tf_real_t radial = size.radial + magnitude(force.F * k->sin_gamma);
  const tf_real_t torque =
      size.torque + d * radial + magnitude(force.F * x->r) + magnitude(force.M);
  return (end_rates_t){radial / k->m + d * magnitude(u->alpha),
                       torque / inertia_at(k, x->r) + magnitude(u->alpha)};
}

// A turntable that stands, or passes 0, may bring the wheel to rest; then h and
// g are off by the rounding of the forces that balance, each with what it does
// in dt: where they nearly undo each other in h, A is no measure of them.
TF_API tf_status_t tf_status_of_end(const tf_machine_t *k,
                                    const tf_state_t *state,
                                    const tf_input_t *u, tf_report_t *report) {
  tf_real_t rounding =
      slip_rounding(k, state->r, state->v, state->w, u->omega0);
  if (within(u->omega0, magnitude(turn_of_step(k, u)))) {
    const end_rates_t terms =
        terms_of_rates(k, u, state, magnitude(state->v), report->force);
    rounding +=
        SLIP_ROUNDINGS * k->dt * (terms.dp + magnitude(state->r) * terms.dz);
  }
  return status_by_signs(report, rounding);
}

// Stall: whether a step that has left r as it was will go on like that although
// the machine moves. Each such step is right to rounding, but where a step
// changes r or w by less than half of its last digit the change is lost, for as
// long as that is so. A motion that passes a turning point soon moves r again;
// one that is in equilibrium need not move.

// How many roundings of their terms the speeds and the accelerations of an
// equilibrium are off by at most.
#define STALL_ROUNDINGS (16 * TF_REAL_EPSILON)
// What moves by less than this share of its size in a second is at rest [1/s].
#define STALL_SLOWEST TF_R(1e-9)
// A motion that is to move r again within so many steps does not stall.
#define STALL_STEPS 32
// A slip of so many of its roundings has a direction, and with it a force, that
// rounding does not change.
#define STALL_DIRECTION 64

// The force of the law at the end of the step, and its share that is rounding:
// in stick lambda = N/A, which undoes the slip that rounding has left in no
// time at all; in slip the force of the step.
typedef struct {
  tf_force_t force, rounding;
} stall_force_t;

static stall_force_t force_in_stick(const tf_machine_t *k, const rates_t *rates,
                                    end_rates_t terms, tf_real_t r, sign_t s) {
  const tf_real_t kappa = signed_kappa(k, s), A = rates->A[s];
  const tf_real_t lambda = stick_lambda(k, rates, s);
  const tf_real_t off =
      (terms.dp + magnitude(r) * terms.dz) * STALL_ROUNDINGS / magnitude(A);
  return (stall_force_t){{lambda, kappa * lambda},
                         {off, magnitude(kappa) * off}};
}

static stall_force_t force_in_slip(const tf_machine_t *k, tf_force_t force,
                                   tf_slip_t slip, tf_real_t off) {
  const tf_real_t size = magnitude(slip.h) + magnitude(slip.g);
  const tf_real_t uncertain = STALL_DIRECTION * off;
  const tf_real_t share = uncertain < size ? uncertain / size : 1;
  return (stall_force_t){
      force, {share * k->contact.tyre.mu, share * k->contact.kappa_mu}};
}

// How fast the machine moves, and by how much rounding may be the reason.
typedef struct {
  tf_real_t v_rate, z_rate;
  tf_real_t v_off, v_rate_off, z_rate_off;
} stall_motion_t;

static stall_motion_t motion_at_end(const tf_machine_t *k, const tf_input_t *u,
                                    const tf_state_t *x, tf_force_t force) {
  const tf_real_t z = x->w - u->omega0, p = slider_speed(k, x->v, z);
  const tf_real_t d = magnitude(k->d), reach = d + magnitude(x->r);
  const tf_real_t terms_of_v = slip_terms(k, x->r, x->v, x->w, u->omega0);
  const tf_real_t v_off = STALL_ROUNDINGS * terms_of_v;
  const rates_t rates = tf_rates_at(k, u, x->r, p, z, u->omega0);
  const end_rates_t terms = terms_of_rates(k, u, x, terms_of_v, force);
  const stall_force_t by =
      tf_tyre_is_set_valued(k->contact.tyre.law) && is_stick(x->mode)
          ? force_in_stick(k, &rates, terms, x->r, sign_in(x->mode))
          : force_in_slip(k, force, slip_from_pq(k, p, x->r * z), v_off);
  const tf_real_t J = inertia_at(k, x->r), arm = x->r * k->cos_gamma;
  const tf_real_t p_rate = rates.dp + by.force.F * rates.Fp;
  const tf_real_t z_rate = rates.dz + spin_rate_under(arm, by.force, J);
  const tf_real_t p_off =
      STALL_ROUNDINGS * terms.dp + by.rounding.F * magnitude(rates.Fp);
  const tf_real_t z_off = STALL_ROUNDINGS * terms.dz +
                          spin_rate_under(magnitude(arm), by.rounding, J);
  return (stall_motion_t){
      slider_velocity(k, p_rate, z_rate), z_rate, v_off + STALL_SLOWEST * reach,
      p_off + d * z_off + STALL_SLOWEST * reach, z_off + STALL_SLOWEST};
}

static bool stalls(const tf_machine_t *k, const tf_input_t *u,
                   const tf_state_t *x, tf_force_t force) {
  const stall_motion_t a = motion_at_end(k, u, x, force);
  const bool sticks =
      tf_tyre_is_set_valued(k->contact.tyre.law) && is_stick(x->mode);
  // A stick whose disc does not turn is held at its h = 0.
  if (sticks && !within(a.z_rate, a.z_rate_off) &&
      x->w + k->dt * a.z_rate == x->w)
    return true;
  // A smooth law balances within a step any slip that rounding leaves, so that
  // its force at rest is no acceleration.
  const bool smooth = !tf_tyre_is_set_valued(k->contact.tyre.law) &&
                      k->contact.tyre.law != TF_TYRE_NONE;
  if (within(x->v, a.v_off) && (smooth || within(a.v_rate, a.v_rate_off)))
    return false;
  const tf_real_t later = x->v + STALL_STEPS * k->dt * a.v_rate;
  return x->r + k->theta_dt * later == x->r;
}

TF_API tf_status_t tf_status_of_stall(const tf_machine_t *k,
                                      const tf_input_t *u, const tf_state_t *x,
                                      tf_report_t *report) {
  if (report->status == TF_OK && x->mode != TF_PINNED &&
      stalls(k, u, x, report->force))
    report->status = TF_STALLED;
  return report->status;
}
