/// The consistent modes of an instant; see reference.h. A motion reaches or
/// leaves h = g = 0 along a zero of turn, a limit direction, or in stick.
#include <string.h>

#include "reference.h"

typedef ref_real_t real_t;

static const real_t half_turn = REF_PI;

static void add(ref_consistent_t *out, ref_way_t way) {
  if (out->count < REF_MAX_WAYS) out->list[out->count++] = way;
}

static bool holds(const ref_edge_t *edge) {
  return (edge->plus <= 0 && edge->minus >= 0) ||
         (edge->plus >= 0 && edge->minus <= 0);
}

void ref_consistent_edge(const ref_machine_t *machine, ref_state_t x,
                         ref_consistent_t *out) {
  memset(out, 0, sizeof *out);
  const int s = ref_slip(machine, x).g > 0 ? 1 : -1;
  const ref_edge_t edge = ref_edge(machine, x, s);
  if (edge.plus > 0)
    add(out, (ref_way_t){.mode = REF_SLIP_PLUS, .rate = edge.plus});
  if (edge.minus < 0)
    add(out, (ref_way_t){.mode = REF_SLIP_MINUS, .rate = -edge.minus});
  if (holds(&edge))
    add(out, (ref_way_t){.mode = s > 0 ? REF_STICK_PLUS : REF_STICK_MINUS,
                         .attracting = edge.A > 0});
}

ref_polar_t ref_polar(const ref_machine_t *machine, const ref_affine_t *f,
                      real_t angle, int side) {
  const real_t s = ref_sin(angle), c = ref_cos(angle);
  const real_t h = side * s > 0 ? s : 0;
  const ref_slip_t slip = {h, c};
  const ref_force_t force =
      ref_slip_force(machine, slip, ref_piece_at(machine, slip, side));
  const real_t dh = f->h + f->h_F * force.F + f->h_M * force.M;
  const real_t dg = f->g + f->g_F * force.F + f->g_M * force.M;
  return (ref_polar_t){dh * s + dg * c, dh * c - dg * s};
}

// To the last digit of either number.
enum { HALVINGS = 120 };

static real_t bisect(const ref_machine_t *machine, const ref_affine_t *f,
                     real_t low, real_t high, int side) {
  const bool rises = ref_polar(machine, f, high, side).turn > 0;
  for (int i = 0; i < HALVINGS; ++i) {
    const real_t mid = (low + high) / 2;
    if ((ref_polar(machine, f, mid, side).turn > 0) == rises)
      high = mid;
    else
      low = mid;
  }
  return (low + high) / 2;
}

static void limit_direction(const ref_machine_t *machine, const ref_affine_t *f,
                            real_t angle, int side, bool rises,
                            ref_consistent_t *out) {
  const real_t growth = ref_polar(machine, f, angle, side).growth;
  if (growth > 0) {
    add(out, (ref_way_t){
                 .mode = side > 0 ? REF_SLIP_PLUS : REF_SLIP_MINUS,
                 .attracting = !rises,
                 .rate = growth,
                 .angle = angle,
             });
  }
}

// All limit directions of one half plane, by a scan that is finest at its two
// ends; adds the change of ln rho across it to `winding`. Returns the sign of
// turn where it is the same throughout, else 0.
static int scan(const ref_machine_t *machine, const ref_affine_t *f, int side,
                ref_consistent_t *out, real_t *winding) {
  enum { POINTS = 1501 };
  const real_t from = side > 0 ? 0 : half_turn;
  real_t before = from;
  ref_polar_t last = ref_polar(machine, f, from, side);
  const int sign = last.turn > 0 ? 1 : -1;
  bool same = true;
  for (int i = 1; i <= POINTS; ++i) {
    const real_t angle =
        from + half_turn * (1 - ref_cos(half_turn * i / POINTS)) / 2;
    const ref_polar_t now = ref_polar(machine, f, angle, side);
    if ((now.turn > 0) != (last.turn > 0)) {
      limit_direction(machine, f, bisect(machine, f, before, angle, side), side,
                      now.turn > 0, out);
      same = false;
    }
    *winding +=
        (angle - before) / 2 *
        (last.growth / ref_abs(last.turn) + now.growth / ref_abs(now.turn));
    before = angle;
    last = now;
  }
  return same ? sign : 0;
}

// Whether lambda holds h' = 0 within the law on the side s of g.
static bool can_stick(const ref_machine_t *machine, const ref_edge_t *edge) {
  return ref_sticks(machine) && holds(edge) && edge->A != 0;
}

real_t ref_stick_growth(const ref_machine_t *machine, const ref_affine_t *f,
                        int s) {
  const ref_edge_t edge = ref_edge_of(machine, f, s);
  if (!can_stick(machine, &edge)) return 0;
  const ref_force_t force = ref_stick_force(machine, s, edge.N / edge.A);
  return ref_larger(0, s * (f->g + f->g_F * force.F + f->g_M * force.M));
}

// h' = g' = 0 solved for the force.
ref_force_t ref_rest_force(const ref_affine_t *f) {
  const real_t det = f->h_F * f->g_M - f->h_M * f->g_F;
  if (det == 0) return (ref_force_t){0, 0};
  return (ref_force_t){(f->h_M * f->g - f->h * f->g_M) / det,
                       (f->g_F * f->h - f->g * f->h_F) / det};
}

real_t ref_rest_margin(const ref_machine_t *machine, ref_force_t force,
                       ref_rest_t law) {
  const ref_machine_t *q = machine;
  const real_t F = ref_abs(force.F), M = ref_abs(force.M);
  const real_t kappa = q->law == REF_COULOMB ? 0 : q->kappa;
  real_t most = q->mu;
  if (law == REF_HEXAGON && kappa > 0) most = 4 * q->mu / 3 - M / (3 * kappa);
  return ref_smaller(most - F, kappa * (law == REF_BOW_TIE ? F : q->mu) - M);
}

void ref_consistent_field(const ref_machine_t *machine,
                          const ref_affine_t *field, ref_consistent_t *out) {
  memset(out, 0, sizeof *out);
  real_t winding = 0;
  const int up = scan(machine, field, 1, out, &winding);
  const int down = scan(machine, field, -1, out, &winding);
  bool winds = up != 0 && up == down;
  for (int s = 1; s >= -1; s -= 2) {
    const ref_edge_t edge = ref_edge_of(machine, field, s);
    const real_t growth = ref_stick_growth(machine, field, s);
    winds = winds && !can_stick(machine, &edge);
    if (growth > 0)
      add(out, (ref_way_t){.mode = s > 0 ? REF_STICK_PLUS : REF_STICK_MINUS,
                           .attracting = edge.A > 0,
                           .rate = growth,
                           .angle = s > 0 ? 0 : half_turn});
  }
  out->spiral = winds && winding > 0;
  if (ref_sticks(machine) &&
      field->h_F * field->g_M != field->h_M * field->g_F) {
    out->resting = ref_rest_force(field);
    for (int law = 0; law < REF_RESTS; ++law)
      out->rests[law] =
          ref_rest_margin(machine, out->resting, (ref_rest_t)law) >= 0;
  }
}

void ref_consistent_codim2(const ref_machine_t *machine, ref_state_t x,
                           ref_consistent_t *out) {
  const ref_affine_t field = ref_affine(machine, x);
  ref_consistent_field(machine, &field, out);
  if (x.z != 0) { // r z does not stay 0
    memset(out->rests, 0, sizeof out->rests);
  }
}

// Kinds of future in the order of the rule. Where the law of stick holds the
// wheel (the bow tie), a stick that arrives is held, and a wheel at rest is by
// any law. Other motion runs into
// rest unless a stick or a direction leaves to which its neighbours turn, so
// those come before it.
enum {
  ATTRACTING_STICK,
  HELD,
  ATTRACTING_SLIP,
  REST,
  FAMILY,
  ESCAPING_STICK,
  NONE
};

static int kind_of(const ref_way_t *way) {
  if (way->mode <= REF_SLIP_MINUS)
    return way->attracting ? ATTRACTING_SLIP : FAMILY;
  return way->attracting ? ATTRACTING_STICK : ESCAPING_STICK;
}

int ref_choose(const ref_consistent_t *consistent, ref_rest_t law,
               ref_mode_t from) {
  int best = REF_NONE, best_kind = NONE;
  for (int i = 0; i < consistent->count; ++i) {
    const ref_way_t *f = &consistent->list[i];
    const int kind = kind_of(f);
    if (kind < best_kind ||
        (kind == best_kind && f->rate > consistent->list[best].rate)) {
      best = i;
      best_kind = kind;
    }
  }
  const bool held = from == REF_PINNED ||
                    (from >= REF_STICK_PLUS && consistent->rests[REF_BOW_TIE]);
  return best_kind > (held ? HELD : REST) && consistent->rests[law] ? REF_REST
                                                                    : best;
}
