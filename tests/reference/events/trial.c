/// @file
/// One step of the reference within a mode: extrapolation of the modified
/// midpoint rule (Gragg, Bulirsch, Stoer) to order 12.
#include <math.h>

#include "orbit.h"

enum { COLUMNS = 6 };

ref_force_t ref_force(const ref_orbit_t *orbit, ref_state_t x) {
  const ref_machine_t *q = orbit->machine;
  if (orbit->mode <= REF_SLIP_MINUS) {
    const int side = orbit->mode == REF_SLIP_PLUS ? 1 : -1;
    return ref_slip_force(q, ref_slip(q, x), side, orbit->sign_g);
  }
  const ref_edge_t edge = ref_edge(q, x, orbit->sign_g);
  return ref_stick_force(q, orbit->sign_g, edge.N / edge.A);
}

static ref_state_t slope(ref_orbit_t *orbit, ref_state_t x) {
  ++orbit->evaluations;
  const ref_rate_t rate = ref_rate(orbit->machine, x, ref_force(orbit, x));
  return (ref_state_t){rate.r, rate.p, rate.z};
}

static ref_state_t along(ref_state_t x, real_t t, ref_state_t f) {
  return (ref_state_t){x.r + t * f.r, x.p + t * f.p, x.z + t * f.z};
}

// n substeps of the midpoint rule with Gragg's smoothing.
static ref_state_t midpoint(ref_orbit_t *orbit, ref_state_t start, real_t H,
                            int n) {
  const real_t dt = H / n;
  ref_state_t last = orbit->x;
  ref_state_t x = along(last, dt, start);
  for (int i = 1; i < n; ++i) {
    const ref_state_t next = along(last, 2 * dt, slope(orbit, x));
    last = x;
    x = next;
  }
  const ref_state_t f = slope(orbit, x);
  return (ref_state_t){(x.r + last.r + dt * f.r) / 2,
                       (x.p + last.p + dt * f.p) / 2,
                       (x.z + last.z + dt * f.z) / 2};
}

// Error against what h, g and r are at both ends: in slip the angle in the
// (h, g) plane decides the force, so that the smaller slip counts.
static real_t error(const ref_orbit_t *orbit, ref_state_t a, ref_state_t end) {
  const ref_machine_t *q = orbit->machine;
  const ref_slip_t before = ref_slip(q, orbit->x), after = ref_slip(q, end);
  const real_t rho0 = hypotl(before.h, before.g);
  const real_t rho1 = hypotl(after.h, after.g);
  const bool slips = orbit->mode <= REF_SLIP_MINUS;
  const real_t rho = slips && rho0 > 0 ? fminl(rho0, rho1) : fmaxl(rho0, rho1);
  const real_t reach = fabsl(end.r) + q->beta;
  const real_t in_r = fabsl(a.r - end.r) / reach;
  const real_t in_p = fabsl(a.p - end.p) / rho;
  const real_t in_z = fabsl(a.z - end.z) * fabsl(end.r) / rho;
  const real_t alone = fabsl(a.z - end.z) / (fabsl(end.z) + rho / reach);
  return fmaxl(fmaxl(in_r, in_p), fmaxl(in_z, alone)) / orbit->tolerance;
}

real_t ref_trial(ref_orbit_t *orbit, real_t H, ref_state_t *end) {
  const ref_state_t start = slope(orbit, orbit->x);
  ref_state_t row[COLUMNS], coarser = orbit->x;
  for (int k = 0; k < COLUMNS; ++k) {
    const int n = 2 * (k + 1);
    ref_state_t next = midpoint(orbit, start, H, n);
    for (int j = 1; j <= k; ++j) {
      const real_t ratio = (real_t)n / (2 * (k + 1 - j));
      const real_t factor = 1 / (ratio * ratio - 1);
      const ref_state_t old = row[j - 1];
      row[j - 1] = next;
      next = (ref_state_t){next.r + (next.r - old.r) * factor,
                           next.p + (next.p - old.p) * factor,
                           next.z + (next.z - old.z) * factor};
    }
    coarser = k > 0 ? row[k - 1] : next;
    row[k] = next;
  }
  *end = row[COLUMNS - 1];
  const real_t e = error(orbit, coarser, *end);
  return e >= 0 ? e : HUGE_VALL;
}
