/// Equations of motion, slip, tyre laws and surface; see reference.h.
#include "reference.h"

typedef ref_real_t real_t;

void ref_prepare(ref_machine_t *machine) {
  machine->sine = ref_sin(machine->gamma);
  machine->cosine = ref_cos(machine->gamma);
  // a = 1 - (2/pi) arccot(6 kappa)
  machine->share = 1 - 2 / REF_PI * ref_atan2(1, 6 * machine->kappa);
}

const ref_knot_t *ref_knot(const ref_machine_t *machine, int i) {
  return (machine->table ? machine->table : machine->knot) + i;
}

ref_input_t ref_input(const ref_machine_t *machine, real_t t, int piece) {
  const int last = machine->knots - 1;
  if (last < 0) return (ref_input_t){machine->omega0, 0, 0, 0};
  const ref_knot_t *a = ref_knot(machine, piece > 0 ? piece - 1 : 0);
  const ref_knot_t *b = ref_knot(machine, piece > last ? last : piece);
  ref_input_t u = {a->omega0, 0, a->force, a->torque};
  if (b->t > a->t) {
    const real_t since = t - a->t, length = b->t - a->t;
    u.alpha = (b->omega0 - a->omega0) / length;
    u.omega0 += since * u.alpha;
    u.force += since * (b->force - a->force) / length;
    u.torque += since * (b->torque - a->torque) / length;
  }
  if (machine->swing != 0) {
    const real_t turn = machine->swing_rate * t;
    u.omega0 += machine->swing * ref_sin(turn);
    u.alpha += machine->swing * machine->swing_rate * ref_cos(turn);
  }
  return u;
}

static real_t omega0_at(const ref_machine_t *machine, ref_state_t x) {
  return ref_input(machine, x.t, x.piece).omega0;
}

ref_state_t ref_state(const ref_machine_t *machine, real_t r, real_t v,
                      real_t w) {
  int piece = machine->knots > 0;
  while (piece < machine->knots && ref_knot(machine, piece)->t <= 0) ++piece;
  const real_t z = w - ref_input(machine, 0, piece).omega0;
  return (ref_state_t){.r = r, .p = v - machine->d * z, .z = z, .piece = piece};
}

real_t ref_v(const ref_machine_t *machine, ref_state_t x) {
  return x.p + machine->d * x.z;
}

real_t ref_w(const ref_machine_t *machine, ref_state_t x) {
  return x.z + omega0_at(machine, x);
}

ref_slip_t ref_slip(const ref_machine_t *machine, ref_state_t x) {
  const real_t s = machine->sine, c = machine->cosine;
  return (ref_slip_t){-x.p * s - x.r * x.z * c, -x.p * c + x.r * x.z * s};
}

ref_state_t ref_from_slip(const ref_machine_t *machine, ref_state_t x,
                          ref_slip_t slip) {
  const real_t s = machine->sine, c = machine->cosine;
  x.p = -slip.h * s - slip.g * c;
  x.z = (-slip.h * c + slip.g * s) / x.r;
  return x;
}

ref_state_t ref_with_h(const ref_machine_t *machine, ref_state_t x, real_t h) {
  x.p = -(h + x.r * x.z * machine->cosine) / machine->sine;
  return x;
}

ref_state_t ref_on_surface(const ref_machine_t *machine, ref_state_t x) {
  const real_t in_p = machine->sine, in_z = x.r * machine->cosine;
  const real_t in_r = x.z * machine->cosine;
  const real_t square = in_p * in_p + in_z * in_z + in_r * in_r;
  if (square > 0) {
    const real_t h = ref_slip(machine, x).h / square;
    x.r += h * in_r;
    x.p += h * in_p;
    x.z += h * in_z;
  }
  return x;
}

// m (p' - d alpha) = Q + F sin(gamma), and with J = m (beta^2 + r^2)
// J (z' + alpha) = d Q + torque - c1 w - 2 m r v w + F r cos(gamma) + M,
// Q = k2 (r0 - r) - c2 v + m r w^2 + force; then p' and (r z)' turn into h',
// g'.
ref_rate_t ref_rate(const ref_machine_t *machine, ref_state_t x,
                    ref_force_t force) {
  const ref_machine_t *q = machine;
  const ref_input_t u = ref_input(q, x.t, x.piece);
  const real_t w = x.z + u.omega0, v = ref_v(q, x);
  const real_t Q =
      q->k2 * (q->r0 - x.r) - q->c2 * v + q->m * x.r * w * w + u.force;
  const real_t J = q->m * (q->beta * q->beta + x.r * x.r);
  ref_rate_t rate;
  rate.r = v;
  rate.p = (Q + force.F * q->sine) / q->m + q->d * u.alpha;
  rate.z = (q->d * Q + u.torque - (q->c1 + 2 * q->m * x.r * v) * w +
            force.F * x.r * q->cosine + force.M) /
               J -
           u.alpha;
  const real_t rz = v * x.z + x.r * rate.z;
  rate.h = -rate.p * q->sine - rz * q->cosine;
  rate.g = -rate.p * q->cosine + rz * q->sine;
  return rate;
}

ref_affine_t ref_affine(const ref_machine_t *machine, ref_state_t x) {
  const ref_machine_t *q = machine;
  const real_t s = q->sine, c = q->cosine;
  const real_t J = q->m * (q->beta * q->beta + x.r * x.r);
  const ref_rate_t rate = ref_rate(q, x, (ref_force_t){0, 0});
  return (ref_affine_t){
      .h = rate.h,
      .h_F = -s * s / q->m - x.r * x.r * c * c / J,
      .h_M = -x.r * c / J,
      .g = rate.g,
      .g_F = -s * c / q->m + x.r * x.r * s * c / J,
      .g_M = x.r * s / J,
  };
}

real_t ref_energy(const ref_machine_t *machine, real_t r, real_t P, real_t w,
                  real_t stretch) {
  const ref_machine_t *q = machine;
  const real_t gyration2 = q->beta * q->beta + r * r;
  return (q->m * (P * P + gyration2 * w * w) + q->k2 * stretch * stretch) / 2;
}

bool ref_by_angle(const ref_machine_t *machine) {
  return machine->law == REF_JUMP || machine->law == REF_STRING;
}

bool ref_has_kink(const ref_machine_t *machine) {
  return ref_by_angle(machine) || machine->law == REF_SMOOTH;
}

bool ref_sticks(const ref_machine_t *machine) {
  return machine->law == REF_JUMP || machine->law == REF_COULOMB;
}

// Appendix B: with l = (delta/k) |g/h| there is no slip where l >= 2 a + sigma
// and full slip where l <= sigma.
ref_piece_t ref_piece_at(const ref_machine_t *machine, ref_slip_t slip,
                         int side) {
  const ref_machine_t *q = machine;
  const real_t H = q->k * ref_abs(slip.h), G = q->delta * ref_abs(slip.g);
  ref_piece_t piece = {side, ref_sign(slip.g), 0};
  if (q->law == REF_STRING && G < (2 * q->a + q->sigma) * H)
    piece.zone = G > q->sigma * H ? 1 : 2;
  return piece;
}

// Appendix B as corrected, with H / G = tan(phi) = |h/g|.
static ref_force_t string_force(const ref_machine_t *q, int zone, real_t H,
                                real_t G) {
  const real_t k = q->k, a = q->a, sigma = q->sigma, delta = q->delta;
  if (zone == 0)
    return (ref_force_t){2 * a * k * (a + sigma) * (H / G),
                         2 * a * a * a * k / 3 * (H / G)};
  if (zone == 2) return (ref_force_t){2 * a * q->rho * delta, 0};
  const real_t tangent = H / G, cotangent = G / H;
  const real_t x_s = a + sigma - delta / k * cotangent;
  return (ref_force_t){
      q->rho * delta * (2 * a + sigma) +
          delta * delta / (2 * k) * (1 - 2 * q->rho) * cotangent -
          k * sigma * sigma * tangent / 2,
      (k * k * k * sigma * sigma * (3 * a + sigma) * tangent +
       delta * delta * cotangent *
           (2 * delta * cotangent - 3 * k * (a + sigma))) /
              (6 * k * k) -
          delta * q->rho * (x_s * x_s - a * a) / 2};
}

// (force), (moment): cot(psi) = T = tan(a atan |g/h|). Beyond h = 0 it goes on
// up to half of the way to its pole, and from there by its tangent.
static ref_force_t angle_force(const ref_machine_t *q, real_t H, real_t G) {
  const real_t y = q->share * ref_atan2(G, H);
  const real_t last = REF_PI / 4 * (1 + q->share);
  real_t T = ref_tan(ref_smaller(y, last));
  if (y > last) T += (1 + T * T) * (y - last);
  return (ref_force_t){(real_t)4 / 3 - T / (18 * q->kappa), T / 6};
}

ref_force_t ref_slip_force(const ref_machine_t *machine, ref_slip_t slip,
                           ref_piece_t piece) {
  const ref_machine_t *q = machine;
  const real_t side = (real_t)piece.side, roll = (real_t)piece.roll;
  if (!ref_has_kink(q))
    return (ref_force_t){q->law == REF_COULOMB ? side * q->mu : 0, 0};
  const real_t H = side * slip.h, G = roll * slip.g;
  const ref_force_t f = q->law == REF_STRING ? string_force(q, piece.zone, H, G)
                                             : angle_force(q, H, G);
  real_t size = side * q->mu;
  if (q->law == REF_SMOOTH)
    size = q->mu * slip.h / ref_hypot(slip.h, q->epsilon);
  return (ref_force_t){size * f.F, roll * size * f.M};
}

ref_force_t ref_stick_force(const ref_machine_t *machine, int s,
                            real_t lambda) {
  const real_t kappa = machine->law == REF_JUMP ? machine->kappa : 0;
  return (ref_force_t){lambda, (real_t)s * kappa * lambda};
}

ref_edge_t ref_edge_of(const ref_machine_t *machine, const ref_affine_t *field,
                       int s) {
  const ref_force_t unit = ref_stick_force(machine, s, 1);
  ref_edge_t edge = {.N = field->h, .A = -field->h_F - unit.M * field->h_M};
  edge.plus = edge.N - edge.A * machine->mu;
  edge.minus = edge.N + edge.A * machine->mu;
  return edge;
}

ref_edge_t ref_edge(const ref_machine_t *machine, ref_state_t x, int s) {
  const ref_affine_t f = ref_affine(machine, x);
  return ref_edge_of(machine, &f, s);
}

real_t ref_speed_scale(const ref_machine_t *machine, ref_state_t x) {
  const ref_machine_t *q = machine;
  return ref_abs(omega0_at(q, x)) * (ref_abs(x.r) + q->beta) +
         ref_sqrt(q->k2 / q->m) * ref_abs(x.r - q->r0) + (real_t)1e-3L;
}
