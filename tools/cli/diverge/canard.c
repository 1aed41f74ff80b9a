// The canard: a stick that leaves the two-fold along its weak direction and
// goes on in the escaping region.
//
// In backward time every stick in the escaping region tends to the two-fold
// along the weak direction. In forward time they part like t^ratio, the ratio
// of the eigenvalues (14.02 in `chaos`). So what leaves the two-fold fills an
// area; no method can follow one of these curves forward from rounded numbers;
// and a power series selects none where the ratio is near a whole number. Here
// the one is taken that tends to rest at h = g = 0, a saddle of (svf), if one
// does: it never ends, and the others part from it to either side. Elsewhere it
// is the one that passes the farthest point of the tangent, in the escaping
// region, to which any of them leads. From there it is integrated backward in
// time, which is stable whatever the ratio: an error shrinks like t^ratio. The
// steps shrink with the time that is left, down to where curve and tangent are
// the same. Beyond the far end it is the stick that begins there.
//
// All of it is in double: next to a two-fold A and N are differences in which
// float has no digits.

#undef TF_REAL_FLOAT
#include "canard.h"

#include <math.h>

#include "../../../src/model/rates.h"

cli_field_t cli_field_at(const cli_wide_t *given, cli_point_t at) {
  const tf_machine_t k = {CLI_WIDE(given),
                          .contact.stick_kappa = given->stick_kappa};
  const tf_input_t input = {.omega0 = k.omega0, .r0 = k.r0};
  const rates_t a = rates_at(&k, &input, at.r, at.p, at.z, k.omega0);
  const tf_slip_t slip = slip_from_pq(&k, at.p, at.r * at.z);
  const double arm = at.r * k.cos_gamma;
  return (cli_field_t){
      .rate = {slider_velocity(&k, at.p, at.z), a.dp, a.dz},
      .h = slip.h,
      .g = slip.g,
      .N = a.N,
      .A = {a.A[0], a.A[1]},
      .p_F = a.Fp,
      .stick_arm = {stick_arm(&k, arm, PLUS), stick_arm(&k, arm, MINUS)},
      .J = inertia_at(&k, at.r)};
}

double cli_delassus(const cli_wide_t *k, double r, double g) {
  return cli_field_at(k, (cli_point_t){r, 0, 0}).A[g < 0];
}

cli_point_t cli_point_on_surface(const cli_wide_t *k, double r, double z) {
  const double h = cli_field_at(k, (cli_point_t){r, 0, z}).h;
  return (cli_point_t){r, h / k->sin_gamma, z};
}

static cli_field_t on_surface(const cli_canard_t *canard, double r, double z) {
  const cli_wide_t *k = canard->machine;
  return cli_field_at(k, cli_point_on_surface(k, r, z));
}

// Of the time from the two-fold to the end, and of the way from rest: nearer
// than this a tangent is the curve, up to its square.
#define LINEAR 1e-5
// Nodes while the time falls by the factor e; between two of them one step more
// for each RATIO of the ratio, ratio / t being the decay there, or of such a
// ratio for the saddle: step times decay is at most 1/16.
#define NODES 32
#define RATIO 2.0
#define MOST_RATIO 2048.0
#define TANGENT_STEPS 64 // until g would be 0 on the tangent
#define HALVINGS 40
#define AFTER 1e-3 // [s], a step beyond the last node

// Why there is none.
static const char stiff[] =
    "the ratio of its eigenvalues is too large for the solver, or stick "
    "approaches its rest too fast for it";
static const char does_not_enter[] =
    "stick from it reaches no point of its tangent";

static bool is_escaping(const cli_canard_t *canard, cli_canard_node_t at) {
  const cli_field_t f = on_surface(canard, at.r, at.z);
  const double A = f.A[canard->s < 0];
  return A < 0 && fabs(f.N) < -A * canard->machine->mu && canard->s * f.g > 0;
}

// The rates of the members of a node in stick, (svf).
static cli_canard_node_t rates(const cli_canard_t *canard, double r, double z) {
  const cli_field_t f = on_surface(canard, r, z);
  const int side = canard->s < 0;
  return (cli_canard_node_t){
      1, f.rate.r, f.rate.z + f.N / f.A[side] * f.stick_arm[side] / f.J};
}

// Stick after a time dt from a point: a step of the classical Runge-Kutta
// method.
static cli_canard_node_t step(const cli_canard_t *canard,
                              cli_canard_node_t from, double dt) {
  static const double part[] = {0, 0.5, 0.5, 1};
  static const double weight[] = {1. / 6, 1. / 3, 1. / 3, 1. / 6};
  cli_canard_node_t to = {from.t + dt, from.r, from.z};
  cli_canard_node_t rate = {1, 0, 0};
  for (int i = 0; i < 4; i++) {
    rate = rates(canard, from.r + part[i] * dt * rate.r,
                 from.z + part[i] * dt * rate.z);
    to.r += weight[i] * dt * rate.r;
    to.z += weight[i] * dt * rate.z;
  }
  return to;
}

static cli_canard_node_t tangent(const cli_canard_t *canard, double t) {
  return (cli_canard_node_t){t, canard->r + canard->v * t,
                             canard->z + canard->slope * canard->v * t};
}

// The core has the two-fold to its own precision, the steps here need that of
// double: A = 0 depends on r alone, then h' = 0 without friction on z.
static void polish(cli_canard_t *canard) {
  const cli_wide_t *k = canard->machine;
  for (int i = 0; i < 4; i++) {
    const double e = 1e-5 * fabs(canard->r);
    canard->r -= 2 * e * cli_delassus(k, canard->r, canard->s) /
                 (cli_delassus(k, canard->r + e, canard->s) -
                  cli_delassus(k, canard->r - e, canard->s));
  }
  for (int i = 0; i < 4; i++) {
    const double e = 1e-5 * fabs(canard->z);
    const double up = on_surface(canard, canard->r, canard->z + e).N;
    const double in = on_surface(canard, canard->r, canard->z - e).N;
    canard->z -= 2 * e * on_surface(canard, canard->r, canard->z).N / (up - in);
  }
  canard->v = on_surface(canard, canard->r, canard->z).rate.r;
}

// The time since the two-fold, about: by the higher of the speeds here and
// there.
static double time_since(const cli_canard_t *canard, cli_canard_node_t at) {
  const double v = rates(canard, at.r, at.z).r;
  return (at.r - canard->r) / (fabs(v) > fabs(canard->v) ? v : canard->v);
}

// Follows stick from a point backward in time; ratio: of the eigenvalues, or of
// the fastest rate on the way to that of the time that is left.
// Returns: NULL, or why it does not come from the two-fold.
static const char *trace_back(cli_canard_t *canard, cli_canard_node_t at,
                              double ratio) {
  double left = time_since(canard, at);
  const double least = LINEAR * left;
  canard->nodes = 0;
  canard->steps = 2 + (int)(fmin(ratio, MOST_RATIO) / RATIO);
  while (left > least) {
    if (canard->nodes == CLI_CANARD_NODES) return does_not_enter;
    canard->node[canard->nodes++] = at;
    for (int i = 0; i < canard->steps; i++) {
      if (!is_escaping(canard, at)) return does_not_enter;
      at = step(canard, at, -left / NODES / canard->steps);
    }
    left = time_since(canard, at);
  }
  // At the mean of the speeds here and there.
  const double v = 0.5 * (rates(canard, at.r, at.z).r + canard->v);
  for (int i = 0; i < canard->nodes; i++)
    canard->node[i].t += (at.r - canard->r) / v - at.t;
  return canard->nodes > 0 && left >= 0 ? NULL : does_not_enter;
}

// Stick from the two-fold that tends to rest at r, a saddle.
// Returns: NULL, or why it does not.
static const char *tends_to(cli_canard_t *canard, double r, double ratio) {
  const double dr = LINEAR * (canard->r - r), dz = LINEAR * canard->z;
  const cli_canard_node_t up = rates(canard, r, dz), in = rates(canard, r, -dz);
  const double rz = (up.r - in.r) / (2 * dz), zz = (up.z - in.z) / (2 * dz);
  const double zr =
      (rates(canard, r + dr, 0).z - rates(canard, r - dr, 0).z) / (2 * dr);
  const double root = sqrt(0.25 * zz * zz + rz * zr);
  canard->rest = r;
  canard->decay = root - 0.5 * zz;
  const cli_canard_node_t at = {0, r + dr, -canard->decay / rz * dr};
  const double left = time_since(canard, at);
  const double fastest = fmax(ratio, 2 * root * left);
  if (!(rz * zr > 0 && left > 0 && is_escaping(canard, at)))
    return does_not_enter;
  if (fastest > MOST_RATIO) return stiff;
  return trace_back(canard, at, fastest);
}

// What is left of the moment where stick holds the slider at rest [N m]: a
// quadratic in r, and 0 where the wheel can stay.
static double moment_at_rest(const cli_canard_t *canard, double r) {
  const cli_field_t f = on_surface(canard, r, 0);
  return f.J * f.rate.z - f.rate.p / f.p_F * f.stick_arm[canard->s < 0];
}

static const char *never_ends(cli_canard_t *canard, double ratio) {
  const double r = canard->r, c = moment_at_rest(canard, 0);
  const double up = moment_at_rest(canard, r), in = moment_at_rest(canard, -r);
  const double a = 0.5 * (up + in) - c, b = 0.5 * (up - in);
  const double q = -0.5 * (b + copysign(sqrt(b * b - 4 * a * c), b));
  const char *first = tends_to(canard, r * c / q, ratio);
  return first == does_not_enter ? tends_to(canard, r * q / a, ratio) : first;
}

const char *cli_canard_solve(const cli_wide_t *k,
                             const cli_two_fold_t *two_fold,
                             cli_canard_t *canard) {
  const double ratio = two_fold->ratio;
  *canard = (cli_canard_t){.machine = k,
                           .r = two_fold->r,
                           .z = two_fold->omega - k->omega0,
                           .slope = two_fold->slope,
                           .s = two_fold->g < 0 ? -1 : 1};
  if (!(ratio < MOST_RATIO)) return stiff;
  polish(canard);
  const char *status = never_ends(canard, ratio);
  if (status != does_not_enter) return status;
  canard->decay = 0;
  // Where the tangent leaves the region, no farther than half way to r = 0.
  const double half = 0.5 * fabs(canard->r / canard->v);
  const double zero = fabs(canard->z / (canard->slope * canard->v));
  const double part = fmin(zero, half) / TANGENT_STEPS;
  double in = 0, out = part;
  while (out < half && is_escaping(canard, tangent(canard, out))) {
    in = out;
    out += part;
  }
  in = trace_back(canard, tangent(canard, in), ratio) == NULL ? in : 0;
  for (int i = 0; i < HALVINGS; i++) {
    const double t = 0.5 * (in + out);
    *(trace_back(canard, tangent(canard, t), ratio) == NULL ? &in : &out) = t;
  }
  return trace_back(canard, tangent(canard, in), ratio);
}

bool cli_canard_after(const cli_canard_t *canard, double t, cli_point_t *at,
                      double *reached) {
  cli_canard_node_t found = canard->node[0];
  bool inside = true;
  if (t < canard->node[canard->nodes - 1].t) {
    found = tangent(canard, t);
  } else if (t <= found.t) {
    int above = canard->nodes - 1;
    while (canard->node[above].t < t) above--;
    found = canard->node[above];
    for (int i = canard->steps; i > 0; i--)
      found = step(canard, found, (t - found.t) / i);
  } else if (canard->decay > 0) {
    const double left = exp(canard->decay * (found.t - t));
    found = (cli_canard_node_t){
        t, canard->rest + left * (found.r - canard->rest), left * found.z};
  }
  while (inside && found.t < t) {
    const cli_canard_node_t next =
        step(canard, found, fmin(AFTER, t - found.t));
    inside = is_escaping(canard, next);
    found = inside ? next : found;
  }
  *at = cli_point_on_surface(canard->machine, found.r, found.z);
  *reached = found.t;
  return inside;
}
