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

#include "canard.h"

#include <math.h>
#include <string.h>

#include "../setup/setup.h"
#include "twofold/singularity.h"

cli_field_t cli_field_at(const tf_machine_t *k, cli_point_t at) {
  const cli_wide_t wide = {CLI_WIDE(k),
                           .stick_kappa = (double)k->contact.stick_kappa};
  return cli_wide_field_at(&wide, at);
}

tf_state_t cli_state_at(const tf_machine_t *k, cli_point_t at) {
  return (tf_state_t){.r = (tf_real_t)at.r,
                      .v = (tf_real_t)(at.p + (double)k->d * at.z),
                      .w = (tf_real_t)(at.z + (double)k->omega0),
                      .mode = TF_NO_MODE};
}

double cli_delassus(const tf_machine_t *k, double r, double g) {
  return cli_field_at(k, (cli_point_t){r, 0, 0}).A[g < 0];
}

cli_point_t cli_point_on_surface(const tf_machine_t *k, double r, double z) {
  const double h = cli_field_at(k, (cli_point_t){r, 0, z}).h;
  return (cli_point_t){r, h / (double)k->sin_gamma, z};
}

static cli_field_t on_surface(const cli_canard_t *canard, double r, double z) {
  const tf_machine_t *k = canard->machine;
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

static bool is_escaping(const cli_canard_t *canard, cli_canard_node_t at) {
  const cli_field_t f = on_surface(canard, at.r, at.z);
  const double A = f.A[canard->s < 0];
  return A < 0 && fabs(f.N) < -A * (double)canard->machine->contact.tyre.mu &&
         canard->s * f.g > 0;
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
  const tf_machine_t *k = canard->machine;
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
// Returns: whether it comes from the two-fold, within the room for nodes.
static bool comes_from_two_fold(cli_canard_t *canard, cli_canard_node_t at,
                                double ratio) {
  double left = time_since(canard, at);
  const double least = LINEAR * left;
  canard->nodes = 0;
  canard->steps = 2 + (int)(fmin(ratio, MOST_RATIO) / RATIO);
  while (left > least) {
    if (canard->nodes == CLI_CANARD_NODES) {
      return false;
    }
    canard->node[canard->nodes++] = at;
    for (int i = 0; i < canard->steps; i++) {
      if (!is_escaping(canard, at)) {
        return false;
      }
      at = step(canard, at, -left / NODES / canard->steps);
    }
    left = time_since(canard, at);
  }
  // At the mean of the speeds here and there.
  const double v = 0.5 * (rates(canard, at.r, at.z).r + canard->v);
  for (int i = 0; i < canard->nodes; i++) {
    canard->node[i].t += (at.r - canard->r) / v - at.t;
  }
  return canard->nodes > 0 && left >= 0;
}

// Stick from the two-fold that tends to rest at r, a saddle.
// Returns: CLI_CANARD_ENTERS where there is none.
static cli_canard_status_t tends_to(cli_canard_t *canard, double r,
                                    double ratio) {
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
  if (!(rz * zr > 0 && left > 0 && is_escaping(canard, at))) {
    return CLI_CANARD_ENTERS;
  }
  if (fastest > MOST_RATIO) {
    return CLI_CANARD_STIFF;
  }
  return comes_from_two_fold(canard, at, fastest) ? CLI_CANARD_SOLVED
                                                  : CLI_CANARD_ENTERS;
}

// What is left of the moment where stick holds the slider at rest [N m]: a
// quadratic in r, and 0 where the wheel can stay.
static double moment_at_rest(const cli_canard_t *canard, double r) {
  const cli_field_t f = on_surface(canard, r, 0);
  return f.J * f.rate.z - f.rate.p / f.p_F * f.stick_arm[canard->s < 0];
}

static cli_canard_status_t never_ends(cli_canard_t *canard, double ratio) {
  const double r = canard->r, c = moment_at_rest(canard, 0);
  const double up = moment_at_rest(canard, r), in = moment_at_rest(canard, -r);
  const double a = 0.5 * (up + in) - c, b = 0.5 * (up - in);
  const double q = -0.5 * (b + copysign(sqrt(b * b - 4 * a * c), b));
  const cli_canard_status_t first = tends_to(canard, r * c / q, ratio);
  return first == CLI_CANARD_ENTERS ? tends_to(canard, r * q / a, ratio)
                                    : first;
}

cli_canard_status_t cli_canard_solve(const tf_machine_t *k,
                                     const cli_two_fold_t *two_fold,
                                     cli_canard_t *canard) {
  const double ratio = two_fold->ratio;
  memset(canard, 0, sizeof *canard);
  canard->machine = k;
  canard->r = two_fold->r;
  canard->z = two_fold->omega - (double)k->omega0;
  canard->slope = two_fold->slope;
  canard->s = two_fold->g < 0 ? -1 : 1;
  if (!(ratio < MOST_RATIO)) {
    return CLI_CANARD_STIFF;
  }
  polish(canard);
  const cli_canard_status_t status = never_ends(canard, ratio);
  if (status != CLI_CANARD_ENTERS) {
    return status;
  }
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
  in = comes_from_two_fold(canard, tangent(canard, in), ratio) ? in : 0;
  for (int i = 0; i < HALVINGS; i++) {
    const double t = 0.5 * (in + out);
    *(comes_from_two_fold(canard, tangent(canard, t), ratio) ? &in : &out) = t;
  }
  return comes_from_two_fold(canard, tangent(canard, in), ratio)
             ? CLI_CANARD_SOLVED
             : CLI_CANARD_ENTERS;
}

const char *cli_canard_failure(cli_canard_status_t status) {
  return status == CLI_CANARD_STIFF
             ? "the ratio of its eigenvalues is too large for the solver, or "
               "the rest that stick tends to is too fast for it"
             : "no point of its tangent is reached by stick from it";
}

bool cli_canard_after(const cli_canard_t *canard, double t, cli_point_t *at,
                      double *reached) {
  cli_canard_node_t found = canard->node[0];
  bool inside = true;
  if (t < canard->node[canard->nodes - 1].t) {
    found = tangent(canard, t);
  } else if (t <= found.t) {
    int above = canard->nodes - 1;
    while (canard->node[above].t < t) {
      above--;
    }
    found = canard->node[above];
    for (int i = canard->steps; i > 0; i--) {
      found = step(canard, found, (t - found.t) / i);
    }
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

bool cli_find_two_fold(const tf_machine_t *k, cli_two_fold_t *out) {
  const tf_input_t input = tf_input_default(k);
  tf_surface_point_t points[TF_TWO_FOLDS];
  tf_two_fold_t form;
  int count = 0;
  if (tf_two_folds(k, &input, points, &count, NULL) != TF_OK) {
    return false;
  }
  for (int i = 0; i < count; i++) {
    // Stick has to arrive and to leave along the weak direction.
    if (tf_normal_form(k, &input, &points[i], &form) == TF_OK &&
        form.through.sticks && form.through.value < 0 &&
        form.across.value < form.through.value) {
      *out = (cli_two_fold_t){
          (double)form.point.r,
          (double)form.point.w,
          (double)form.point.g,
          (double)form.point.v,
          (double)form.through.velocity.w / (double)form.through.velocity.r,
          (double)form.across.value / (double)form.through.value};
      return true;
    }
  }
  return false;
}
