// The canard: a stick that leaves the two-fold along its weak direction and
// goes on in the escaping region.
//
// In backward time every stick in the escaping region tends to the two-fold
// along the weak direction. In forward time they part like t^ratio, the ratio
// of the eigenvalues (14.02 in `chaos`). So what leaves the two-fold fills an
// area; no method can follow one of these curves forward from rounded numbers;
// and a power series selects none where the ratio is near a whole number. Here
// the one is taken that passes the farthest point of the tangent, in the
// escaping region, to which any of them leads. From there it is integrated
// backward in time, which is stable whatever the ratio: an error shrinks like
// t^ratio. The steps shrink with the time that is left, down to where the curve
// and its tangent are the same. Beyond that point it is the stick that begins
// there.

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

tf_slip_t cli_slip_at(const tf_machine_t *k, cli_point_t at) {
  const cli_field_t f = cli_field_at(k, at);
  return (tf_slip_t){(tf_real_t)f.h, (tf_real_t)f.g};
}

tf_state_t cli_state_at(const tf_machine_t *k, cli_point_t at) {
  return (tf_state_t){.r = (tf_real_t)at.r,
                      .v = (tf_real_t)(at.p + (double)k->d * at.z),
                      .w = (tf_real_t)(at.z + (double)k->omega0),
                      .mode = TF_NO_MODE};
}

cli_point_t cli_point_of(const tf_machine_t *k, const tf_state_t *state) {
  const double z = (double)state->w - (double)k->omega0;
  return (cli_point_t){(double)state->r, (double)state->v - (double)k->d * z,
                       z};
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

// Of the time from the two-fold to the end: before it the tangent is the curve,
// up to the square of this.
#define LINEAR 1e-5
// Nodes while the time falls by the factor e; between two of them one step more
// for each RATIO of the ratio, so that step times decay, ratio / t, is at most
// 1/4.
#define NODES 32
#define RATIO 8.0
#define MOST_STEPS 256
#define TANGENT_STEPS 64 // until g would be 0 on the tangent
#define HALVINGS 40
#define AFTER 1e-3 // [s], a step beyond the last node

static bool is_escaping(const cli_canard_t *canard, double r, double z) {
  const cli_field_t f = on_surface(canard, r, z);
  const double A = f.A[canard->s < 0];
  return A < 0 && fabs(f.N) < -A * (double)canard->machine->contact.tyre.mu &&
         canard->s * f.g > 0;
}

// Stick after a time dt from a point: a step of the classical Runge-Kutta
// method.
static cli_canard_node_t step(const cli_canard_t *canard,
                              cli_canard_node_t from, double dt) {
  static const double part[] = {0, 0.5, 0.5, 1};
  static const double weight[] = {1. / 6, 1. / 3, 1. / 3, 1. / 6};
  cli_canard_node_t to = {from.t + dt, from.r, from.z};
  double rate[2] = {0, 0};
  for (int i = 0; i < 4; i++) {
    const double r = from.r + part[i] * dt * rate[0];
    const double z = from.z + part[i] * dt * rate[1];
    // The sliding vector field, (svf), from that times A.
    const cli_field_t f = on_surface(canard, r, z);
    const double A = f.A[canard->s < 0], arm = f.stick_arm[canard->s < 0];
    rate[0] = A * f.rate.r / A;
    rate[1] = (A * f.rate.z + f.N * arm / f.J) / A;
    to.r += weight[i] * dt * rate[0];
    to.z += weight[i] * dt * rate[1];
  }
  return to;
}

static cli_canard_node_t tangent(const cli_canard_t *canard, double t) {
  return (cli_canard_node_t){t, canard->r + canard->v * t,
                             canard->z + canard->slope * canard->v * t};
}

// When the tangent leaves the escaping region, no farther than half of the way
// to r = 0.
static double end_of_tangent(const cli_canard_t *canard) {
  const double zero = fabs(canard->z / (canard->slope * canard->v));
  const double half = 0.5 * fabs(canard->r / canard->v);
  const double dt = fmin(zero, half) / TANGENT_STEPS;
  double in = 0, out = dt;
  cli_canard_node_t at = tangent(canard, out);
  while (is_escaping(canard, at.r, at.z) && out < half) {
    in = out;
    out += dt;
    at = tangent(canard, out);
  }
  for (int i = 0; i < HALVINGS; i++) {
    const double middle = 0.5 * (in + out);
    at = tangent(canard, middle);
    if (is_escaping(canard, at.r, at.z)) {
      in = middle;
    } else {
      out = middle;
    }
  }
  return in;
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
    double N[3];
    for (int j = 0; j < 3; j++) {
      N[j] = on_surface(canard, canard->r, canard->z + (j - 1) * e).N;
    }
    canard->z -= 2 * e * N[1] / (N[2] - N[0]);
  }
  canard->v = on_surface(canard, canard->r, canard->z).rate.r;
}

// The time since the two-fold, about: by the higher of the speeds here and
// there.
static double time_since(const cli_canard_t *canard, cli_canard_node_t at) {
  const double v = on_surface(canard, at.r, at.z).rate.r;
  return (at.r - canard->r) / (fabs(v) > fabs(canard->v) ? v : canard->v);
}

// Goes backward from a node to the next one.
// Returns: whether all of that is in the escaping region.
static bool go_back(const cli_canard_t *canard, cli_canard_node_t *at,
                    double dt) {
  for (int i = 0; i < canard->steps; i++) {
    if (!is_escaping(canard, at->r, at->z)) {
      return false;
    }
    *at = step(canard, *at, -dt / canard->steps);
  }
  return true;
}

// Follows stick from a point of the tangent backward in time.
// Returns: whether it comes from the two-fold, within the room for nodes.
static bool comes_from_two_fold(cli_canard_t *canard, double whole) {
  cli_canard_node_t at = tangent(canard, whole);
  double left = time_since(canard, at);
  at.t = 0;
  canard->nodes = 0;
  while (left > LINEAR * whole) {
    if (canard->nodes == CLI_CANARD_NODES) {
      return false;
    }
    canard->node[canard->nodes++] = at;
    if (!go_back(canard, &at, left / NODES)) {
      return false;
    }
    left = time_since(canard, at);
  }
  for (int i = 0; i < canard->nodes; i++) {
    canard->node[i].t += left - at.t;
  }
  return canard->nodes > 0 && left >= 0;
}

cli_canard_status_t cli_canard_solve(const tf_machine_t *k,
                                     const cli_two_fold_t *two_fold,
                                     cli_canard_t *canard) {
  memset(canard, 0, sizeof *canard);
  canard->machine = k;
  canard->r = two_fold->r;
  canard->z = two_fold->omega - (double)k->omega0;
  canard->slope = two_fold->slope;
  canard->s = two_fold->g < 0 ? -1 : 1;
  if (!(two_fold->ratio < RATIO * MOST_STEPS)) {
    return CLI_CANARD_STIFF;
  }
  canard->steps = 2 + (int)(two_fold->ratio / RATIO);
  polish(canard);
  const double whole = end_of_tangent(canard);
  if (comes_from_two_fold(canard, whole)) {
    return CLI_CANARD_SOLVED;
  }
  double in = 0, out = whole;
  for (int i = 0; i < HALVINGS; i++) {
    const double middle = 0.5 * (in + out);
    *(comes_from_two_fold(canard, middle) ? &in : &out) = middle;
  }
  return comes_from_two_fold(canard, in) ? CLI_CANARD_SOLVED
                                         : CLI_CANARD_ENTERS;
}

const char *cli_canard_failure(cli_canard_status_t status) {
  return status == CLI_CANARD_STIFF
             ? "the ratio of its eigenvalues is too large for the steps of the "
               "solver"
             : "no point of its tangent is reached by stick from it";
}

// The canard between the tangent and its last node.
static cli_canard_node_t between(const cli_canard_t *canard, double t) {
  int above = 0, below = canard->nodes;
  while (below - above > 1) {
    const int middle = (above + below) / 2;
    *(canard->node[middle].t >= t ? &above : &below) = middle;
  }
  cli_canard_node_t at = canard->node[above];
  const double dt = (t - at.t) / canard->steps;
  for (int i = 0; i < canard->steps; i++) {
    at = step(canard, at, dt);
  }
  at.t = t;
  return at;
}

bool cli_canard_after(const cli_canard_t *canard, double t, cli_point_t *at,
                      double *reached) {
  cli_canard_node_t found = canard->node[0];
  bool inside = true;
  if (t < canard->node[canard->nodes - 1].t) {
    found = tangent(canard, t);
  } else if (t <= found.t) {
    found = between(canard, t);
  }
  while (inside && found.t < t) {
    const cli_canard_node_t next =
        step(canard, found, fmin(AFTER, t - found.t));
    inside = is_escaping(canard, next.r, next.z);
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
      const cli_two_fold_t found = {
          (double)form.point.r,
          (double)form.point.w,
          (double)form.point.g,
          (double)form.point.v,
          (double)form.through.velocity.w / (double)form.through.velocity.r,
          (double)form.across.value / (double)form.through.value};
      *out = found;
      return true;
    }
  }
  return false;
}

tf_state_t cli_before_two_fold(const tf_machine_t *k,
                               const cli_two_fold_t *two_fold,
                               double distance) {
  const double s = two_fold->g < 0 ? -1 : 1;
  const double e =
      cli_delassus(k, two_fold->r + distance, s) > 0 ? distance : -distance;
  tf_state_t state =
      cli_state_at(k, cli_point_on_surface(k, two_fold->r + e,
                                           two_fold->omega - (double)k->omega0 +
                                               two_fold->slope * e));
  state.mode = (uint8_t)cli_stick_mode(s);
  return state;
}
