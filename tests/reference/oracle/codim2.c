// See codim2.h. The rule, DESIGN.md section 5: a slip that can go on goes on;
// else an attracting stick, pinned, a slip (the faster), an escaping stick, but
// that never from slip.
#include "codim2.h"

enum { CELLS = 400, HALVINGS = 120 };

// With R = sqrt(g^2 + h^2), in the limit R = 0: returns R d(angle)/dt, and puts
// dR/dt into radial.
static real angular_rate(const machine_t *p, const ramp_t *ramp, real r, real t,
                         real angle, real *radial) {
  const real s = sinq(angle), c = cosq(angle);
  const piece_t piece = {s < 0 ? -1 : 1, c < 0 ? -1 : 1, zone_of(p, s, c)};
  const motion_t x = {r, 0, 0, t};
  const rates_t d = rates_of(p, ramp, &x, force_of(p, &piece, s, c));
  *radial = d.dg * c + d.dh * s;
  return d.dh * c - d.dg * s;
}

int limit_directions(const machine_t *p, const ramp_t *ramp, real r, real t,
                     direction_t found[DIRECTIONS]) {
  const real cell = strtoflt128(PI_TEXT, NULL) / (2 * CELLS);
  const real edge = cell * (real)1e-20; // stays off the quadrant's borders
  const real d = (real)1e-9;
  int count = 0;
  for (int i = -2 * CELLS; i < 2 * CELLS && count < DIRECTIONS; i++) {
    real lo = cell * i + edge, hi = cell * (i + 1) - edge, radial, ignored;
    const int rising = angular_rate(p, ramp, r, t, lo, &radial) < 0;
    if (rising == (angular_rate(p, ramp, r, t, hi, &radial) < 0)) continue;
    for (int j = 0; j < HALVINGS; j++) {
      const real mid = (lo + hi) / 2;
      if ((angular_rate(p, ramp, r, t, mid, &radial) < 0) == rising)
        lo = mid;
      else
        hi = mid;
    }
    angular_rate(p, ramp, r, t, lo, &radial);
    found[count].angle = lo;
    found[count].speed = radial;
    found[count++].growth = (angular_rate(p, ramp, r, t, lo + d, &ignored) -
                             angular_rate(p, ramp, r, t, lo - d, &ignored)) /
                            (2 * d);
  }
  return count;
}

// Stick with roll s leaves h = g = 0 to its own side.
static int stick_is_possible(const machine_t *p, const ramp_t *ramp,
                             const motion_t *x, int roll, int *attracts) {
  const stick_t s = stick_of(p, ramp, x, roll);
  const real lambda = s.JN / s.JA;
  *attracts = s.JA > 0;
  return fabsq(lambda) <= p->mu && roll * (s.free.dg + lambda * s.g_lambda) > 0;
}

// The force and moment that hold p = z = 0.
static int pinned_is_possible(const machine_t *p, const ramp_t *ramp,
                              const motion_t *x) {
  const rates_t d = rates_of(p, ramp, x, (force_t){0, 0});
  if (p->s == 0) return 0;
  const real F = -p->m * d.dp / p->s;
  const real J = p->m * (p->beta * p->beta + x->r * x->r);
  const real M = -J * d.dz - F * x->r * p->c;
  return fabsq(F) <= p->mu && fabsq(M) <= p->kappa * fabsq(F);
}

// The slips that leave; of each side the one direction that a single orbit
// takes. More than one such, or a fan of orbits, is not a unique motion.
static unsigned slips_that_leave(const machine_t *p, const ramp_t *ramp,
                                 const motion_t *x, direction_t out[2],
                                 int ways[2]) {
  direction_t found[DIRECTIONS];
  const int n = limit_directions(p, ramp, x->r, x->t, found);
  unsigned set = 0;
  ways[0] = ways[1] = 0;
  for (int i = 0; i < n; i++) {
    const int mode = found[i].angle > 0 ? SLIP_PLUS : SLIP_MINUS;
    if (!(found[i].speed > 0)) continue;
    ways[mode] += found[i].growth < 0 ? 1 : 2;
    if (found[i].growth < 0) out[mode] = found[i];
    set |= 1u << mode;
  }
  return set;
}

continuation_t continuation_at_codim2(const machine_t *p, const ramp_t *ramp,
                                      real r, real t, int from) {
  const motion_t x = {r, 0, 0, t};
  const int slipping = from <= SLIP_MINUS;
  continuation_t f = {0, -1, {0, 0, 0}, NULL};
  direction_t out[2];
  int ways[2], attracts[2] = {0, 0};
  f.set = slips_that_leave(p, ramp, &x, out, ways);
  if (p->law != JUMP) {
    f.mode = f.set & 1u ? SLIP_PLUS : SLIP_MINUS;
    f.along = out[f.mode];
    if (ways[0] + ways[1] == 0) f.unknown = "nothing leaves h = g = 0";
    if (ways[0] + ways[1] > 1)
      f.unknown = "more than one slip leaves h = g = 0";
    return f;
  }
  for (int s = 0; s < 2; s++)
    if (stick_is_possible(p, ramp, &x, s ? -1 : 1, &attracts[s]))
      f.set |= 1u << (STICK_PLUS + s);
  if (pinned_is_possible(p, ramp, &x)) f.set |= 1u << IS_PINNED;
  int fast = SLIP_PLUS;
  if (f.set & 1u << SLIP_MINUS)
    if (!(f.set & 1u) || out[1].speed > out[0].speed) fast = SLIP_MINUS;
  for (int s = 1; s >= 0; s--)
    if ((f.set >> (STICK_PLUS + s) & 1u) && attracts[s])
      f.mode = STICK_PLUS + s;
  if (slipping && (f.set >> from & 1u)) f.mode = from;
  if (f.mode < 0 && (f.set & 1u << IS_PINNED)) f.mode = IS_PINNED;
  if (f.mode < 0 && (f.set & 3u)) f.mode = fast;
  for (int s = 0; s < 2; s++)
    if (f.mode < 0 && !slipping && (f.set >> (STICK_PLUS + s) & 1u))
      f.mode = STICK_PLUS + s;
  if (f.mode < 0) {
    f.unknown = "no mode leaves h = g = 0";
  } else if (f.mode <= SLIP_MINUS) {
    f.along = out[f.mode];
    if (ways[f.mode] != 1) f.unknown = "more than one slip leaves h = g = 0";
  }
  return f;
}
