// Runs one cell and judges it by the energy balance.
//
// The friction force acts along -grad h, so that along any motion
//   dE/dt = -c2 v^2 - c1 w^2 - F h + F omega0 (r cos gamma - d sin gamma)
//           + M w
// and -F h <= 0. With |F| <= F_max, |M| <= M_max, what the contact can have put
// in up to step n is at most
//   W_n = sum dt (F_max |omega0| |r cos gamma - d sin gamma| + M_max |w|)
// along the run's own path. No motion of the machine has E > E0 + W. A run with
// E > 4 (E0 + W) has more than twice the amplitude that this allows: energy
// was created by the scheme. Less than that is an error, not an instability.
// What a step gains that says itself that it is too coarse or degraded is known
// to be wrong: where E > 4 (E0 + W) by that alone, no step has kept silent.
#include "cell.h"

#include <math.h>
#include <string.h>

#include "../../../tests/reference/reference.h"

const char *const cell_verdict_names[CELL_VERDICTS] = {
    "ok",   "degraded", "physics",       "too_long", "diverged",
    "told", "created",  "bad_parameter", "touched",  "non_finite"};

const cell_scheme_t cell_schemes[CELL_SCHEMES] = {
    {"moreau-0.5", tf_step, TF_R(0.5)},
    {"moreau-1", tf_step, TF_R(1.0)},
    {"located", tf_step_located, TF_R(0.5)},
};

double cell_dt(int i) { return pow(10, -6 + i / 2.0); }

#define FACTOR 4

static long double wide(tf_real_t x) { return (long double)x; }

// Terms of 8 roundings, the least of which is that of a subnormal number.
static long double rounding(long double x) {
  return 8 * wide(TF_REAL_EPSILON) * (x + wide(TF_REAL_MIN));
}

static long double energy(const ref_machine_t *q, const tf_state_t *x) {
  const long double r = wide(x->r), w = wide(x->w);
  return ref_energy(q, r, wide(x->v) - q->d * w, w, r - q->r0);
}

// The energy of the rounding of a state.
static long double energy_of_rounding(const ref_machine_t *q,
                                      const tf_state_t *x) {
  const long double r = fabsl(wide(x->r));
  const long double dw = rounding(fabsl(wide(x->w)));
  const long double dp = rounding(fabsl(wide(x->v))) + fabsl(q->d) * dw;
  return ref_energy(q, r, dp, dw, rounding(r + fabsl(q->r0)));
}

// |F| and |M| that a law never exceeds. String: the pressure is delta at most
// on a contact of length 2a.
static tf_force_t largest_force(const tf_tyre_t *t) {
  switch (t->law) {
    case TF_TYRE_JUMP:
    case TF_TYRE_SMOOTH:
      return (tf_force_t){t->mu * 4 / 3, t->kappa * t->mu};
    case TF_TYRE_COULOMB:
      return (tf_force_t){t->mu, 0};
    case TF_TYRE_STRING:
    case TF_TYRE_TWO_PIECE:
      return (tf_force_t){2 * t->a * t->delta * t->mu,
                          t->a * t->a * t->delta * t->mu};
    case TF_TYRE_NONE:
    default: // a law that is not here: what it does exceeds this, and shows
      break;
  }
  return (tf_force_t){0, 0};
}

static long double power(const tf_tyre_t *tyre, const ref_machine_t *q,
                         const tf_state_t *x, tf_real_t omega0) {
  const tf_force_t f = largest_force(tyre);
  const long double arm = wide(x->r) * q->cosine - q->d * q->sine;
  return fabsl(wide(f.F) * wide(omega0) * arm) + fabsl(wide(f.M) * wide(x->w));
}

static bool all_finite(const tf_state_t *x, const tf_report_t *o) {
  return isfinite(x->r) && isfinite(x->v) && isfinite(x->w) &&
         isfinite(x->phi) && isfinite(o->force.F) && isfinite(o->force.M) &&
         isfinite(o->slip.h) && isfinite(o->slip.g) && isfinite(o->delassus) &&
         isfinite(o->residual);
}

static long double size(const tf_state_t *x) {
  return fabsl(wide(x->r)) + fabsl(wide(x->v)) + fabsl(wide(x->w));
}

static tf_input_t input_at(const case_t *c, const tf_machine_t *k, long n) {
  if (!c->scene) return tf_input_default(k);
  return tf_scene_input(c->scene, k, (uint64_t)n);
}

tf_status_t cell_begin(const case_t *c, tf_real_t theta, tf_real_t dt,
                       tf_machine_t *k, tf_state_t *x) {
  tf_report_t report;
  tf_params_t params = c->params;
  params.theta = theta;
  params.dt = dt;
  const tf_status_t status = tf_prepare(k, &params, NULL);
  if (status != TF_OK) return status;
  memset(x, 0, sizeof *x);
  x->r = c->r;
  x->v = c->v;
  x->w = c->w;
  x->mode = TF_NO_MODE;
  const tf_input_t u = input_at(c, k, 0);
  // Where no v gives h, the case starts with the v that it has.
  if (c->v_from_h && tf_begin_with_slip(k, x, &u, c->h, &report) == TF_OK)
    return TF_OK;
  return tf_begin(k, x, &u, &report);
}

// How much the state changes in a time by its free accelerations.
static long double change(const tf_params_t *p, const tf_state_t *x,
                          const tf_input_t *u, long double time) {
  ref_machine_t k = {PARAMETERS_OF(ref_real_t, p)};
  k.r0 = wide(u->r0);
  k.omega0 = wide(u->omega0);
  const ref_rate_t rate =
      ref_rate(&k, ref_state(&k, wide(x->r), wide(x->v), wide(x->w)),
               (ref_force_t){0, 0});
  const long double dv = rate.p + k.d * rate.z;
  return time * (fabsl(rate.r) + fabsl(dv) + fabsl(rate.z));
}

// A refused step, asked again in CELL_FINER parts. The motion diverges by
// itself only where these parts are refused as well and have come near the
// limit of states, or where its accelerations leap there even within one part.
static bool leaves(const case_t *c, step_t *step, tf_real_t theta, tf_real_t dt,
                   const tf_state_t *last, long n) {
  const long double near = wide(TF_STATE_LIMIT) / 100;
  tf_params_t params = c->params;
  tf_machine_t k;
  tf_report_t report;
  tf_state_t x = *last;
  params.theta = theta;
  params.dt = dt / CELL_FINER;
  if (params.dt < TF_R(1e-9)) params.dt = TF_R(1e-9);
  tf_status_t status = tf_prepare(&k, &params, NULL);
  if (status != TF_OK) return false;
  const tf_input_t u = input_at(c, &k, n * CELL_FINER);
  for (long i = 0; i < CELL_FINER && status >= TF_OK; i++)
    status = step(&k, &x, &u, &report);
  return (status == TF_DIVERGED || status == TF_BAD_STATE) &&
         size(&x) + change(&params, &x, &u, wide(params.dt)) > near;
}

// What a run is watched for, step by step.
typedef struct {
  const tf_machine_t *k;
  ref_machine_t q;
  long double E0, W;
  long double E, told; // energy; how far flagged steps have led beyond E0 + W
} watch_t;

static void worsen(cell_t *cell, cell_verdict_t verdict) {
  if (verdict > cell->verdict) cell->verdict = verdict;
}

static void watch(cell_t *cell, watch_t *at, const tf_state_t *old,
                  const tf_state_t *x, const tf_report_t *report,
                  tf_real_t omega0) {
  const tf_machine_t *k = at->k;
  if (!all_finite(x, report)) worsen(cell, CELL_NON_FINITE);
  if (report->status == TF_DEGRADED) worsen(cell, CELL_DEGRADED);
  const long double E = energy(&at->q, x);
  at->W += wide(k->dt) * fmaxl(power(&k->contact.tyre, &at->q, old, omega0),
                               power(&k->contact.tyre, &at->q, x, omega0));
  const long double room = at->E0 + at->W + energy_of_rounding(&at->q, x);
  if (report->status >= TF_COARSE || report->status == TF_DEGRADED)
    at->told = fmaxl(at->told, fminl(at->told + E - at->E, E - room));
  at->E = E;
  if (!(E <= FACTOR * room)) worsen(cell, CELL_TOLD);
  if (!(E <= FACTOR * (room + at->told))) worsen(cell, CELL_CREATED);
  cell->excess = fmaxl(cell->excess, E / room);
}

static cell_verdict_t refusal(const case_t *c, step_t *step, tf_status_t status,
                              tf_real_t theta, tf_real_t dt,
                              const tf_state_t *x, long n) {
  if (status == TF_BAD_PARAMETER) return CELL_PARAMETER;
  if (status == TF_STEP_TOO_LONG) return CELL_TOO_LONG;
  return leaves(c, step, theta, dt, x, n) ? CELL_PHYSICS : CELL_DIVERGED;
}

cell_t cell_run(const case_t *c, step_t *step, tf_real_t theta, tf_real_t dt) {
  cell_t cell;
  tf_machine_t k;
  tf_state_t x, old;
  memset(&cell, 0, sizeof cell);
  tf_status_t status = cell_begin(c, theta, dt, &k, &x);
  if (status != TF_OK) {
    cell.verdict = CELL_PARAMETER;
    return cell;
  }
  watch_t at = {.k = &k, .q = {PARAMETERS_OF(long double, &c->params)}};
  ref_prepare(&at.q);
  at.E0 = at.E = energy(&at.q, &x);
  for (long n = 0; n < CELL_STEPS; n++) {
    const tf_input_t u = input_at(c, &k, n + 1);
    tf_report_t report;
    memset(&report, 0, sizeof report);
    memcpy(&old, &x, sizeof x);
    status = step(&k, &x, &u, &report);
    if (report.status != status) worsen(&cell, CELL_TOUCHED);
    if (status < TF_OK) {
      if (memcmp(&old, &x, sizeof x) != 0) worsen(&cell, CELL_TOUCHED);
      worsen(&cell, refusal(c, step, status, theta, dt, &old, n));
      return cell;
    }
    watch(&cell, &at, &old, &x, &report, u.omega0);
  }
  return cell;
}
