/// @file
/// The consistent modes of an instant; see consistent.h. Near h = g = 0 the
/// slip is (h, g) = rho (sin angle, cos angle), and its rate depends on the
/// angle alone: rho' = out(angle), rho angle' = turn(angle). A motion reaches
/// or leaves the point along a zero of turn, a limit direction, or in stick.
#include "consistent.h"

#include <math.h>
#include <string.h>

static const real_t pi = 3.14159265358979323846264338327950288L;

static void add(ref_consistent_t *out, ref_consistent_mode_t way) {
  if (out->count < REF_MAX_CONSISTENT) {
    out->list[out->count++] = way;
  }
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
  if (edge.plus > 0) {
    add(out, (ref_consistent_mode_t){.mode = REF_SLIP_PLUS, .rate = edge.plus});
  }
  if (edge.minus < 0) {
    add(out,
        (ref_consistent_mode_t){.mode = REF_SLIP_MINUS, .rate = -edge.minus});
  }
  if (holds(&edge)) {
    add(out, (ref_consistent_mode_t){
                 .mode = s > 0 ? REF_STICK_PLUS : REF_STICK_MINUS,
                 .attracting = edge.A > 0});
  }
}

typedef struct {
  real_t out, turn;
} polar_t;

// The rate of (rho, angle) times (1, rho); side names the half plane of h, so
// that angles 0 and pi are taken as limits from there.
static polar_t polar(const ref_machine_t *machine, const ref_affine_t *f,
                     real_t angle, int side) {
  const real_t s = sinl(angle), c = cosl(angle);
  const real_t h = side * s > 0 ? s : 0;
  const ref_force_t force =
      ref_slip_force(machine, (ref_slip_t){h, c}, side, c >= 0 ? 1 : -1);
  const real_t dh = f->h + f->h_F * force.F + f->h_M * force.M;
  const real_t dg = f->g + f->g_F * force.F + f->g_M * force.M;
  return (polar_t){dh * s + dg * c, dh * c - dg * s};
}

static real_t bisect(const ref_machine_t *machine, const ref_affine_t *f,
                     real_t low, real_t high, int side) {
  const bool rises = polar(machine, f, high, side).turn > 0;
  for (int i = 0; i < 80; ++i) {
    const real_t mid = (low + high) / 2;
    if ((polar(machine, f, mid, side).turn > 0) == rises) {
      high = mid;
    } else {
      low = mid;
    }
  }
  return (low + high) / 2;
}

static void limit_direction(const ref_machine_t *machine, const ref_affine_t *f,
                            real_t angle, int side, bool rises,
                            ref_consistent_t *out) {
  const polar_t rate = polar(machine, f, angle, side);
  if (rate.out > 0) {
    add(out, (ref_consistent_mode_t){
                 .mode = side > 0 ? REF_SLIP_PLUS : REF_SLIP_MINUS,
                 .attracting = !rises,
                 .rate = rate.out,
                 .angle = angle,
                 .family = rises,
             });
  } else {
    ++out->arriving;
  }
}

// All limit directions of one half plane, by a scan that is finest at its two
// ends; adds the change of ln rho across it to `winding`. Returns the sign of
// turn where it is the same throughout, else 0.
static int scan(const ref_machine_t *machine, const ref_affine_t *f, int side,
                ref_consistent_t *out, real_t *winding) {
  enum { POINTS = 1501 };
  const real_t from = side > 0 ? 0 : pi;
  real_t before = from;
  polar_t last = polar(machine, f, from, side);
  const int sign = last.turn > 0 ? 1 : -1;
  bool same = true;
  for (int i = 1; i <= POINTS; ++i) {
    const real_t angle = from + pi * (1 - cosl(pi * i / POINTS)) / 2;
    const polar_t now = polar(machine, f, angle, side);
    if ((now.turn > 0) != (last.turn > 0)) {
      limit_direction(machine, f, bisect(machine, f, before, angle, side), side,
                      now.turn > 0, out);
      same = false;
    }
    *winding += (angle - before) / 2 *
                (last.out / fabsl(last.turn) + now.out / fabsl(now.turn));
    before = angle;
    last = now;
  }
  return same ? sign : 0;
}

// Stick on the side s of g: leaves where lambda holds h' = 0 within the law
// and g' leads to that side.
static bool stick(const ref_machine_t *machine, const ref_affine_t *f,
                  ref_state_t x, int s, ref_consistent_t *out) {
  const ref_edge_t edge = ref_edge(machine, x, s);
  if (!holds(&edge) || edge.A == 0) {
    return false;
  }
  const ref_force_t force = ref_stick_force(machine, s, edge.N / edge.A);
  const real_t dg = f->g + f->g_F * force.F + f->g_M * force.M;
  if (s * dg > 0) {
    add(out, (ref_consistent_mode_t){
                 .mode = s > 0 ? REF_STICK_PLUS : REF_STICK_MINUS,
                 .attracting = edge.A > 0,
                 .rate = s * dg,
                 .angle = s > 0 ? 0 : pi});
  } else {
    ++out->arriving;
  }
  return true;
}

// h' = g' = 0 solved for the force; it lasts only where r z stays 0.
static void rest(const ref_machine_t *machine, const ref_affine_t *f,
                 ref_state_t x, ref_consistent_t *out) {
  const ref_machine_t *q = machine;
  const real_t det = f->h_F * f->g_M - f->h_M * f->g_F;
  if (det == 0 || x.z != 0) {
    return;
  }
  const real_t F = (f->h_M * f->g - f->h * f->g_M) / det;
  const real_t M = (f->g_F * f->h - f->g * f->h_F) / det;
  const real_t kappa = q->coulomb ? 0 : q->kappa;
  const real_t limit =
      q->coulomb ? q->mu : 4 * q->mu / 3 - fabsl(M) / (3 * q->kappa);
  out->resting = (ref_force_t){F, M};
  out->rests[REF_BOW_TIE] = fabsl(M) <= kappa * fabsl(F) && fabsl(F) <= q->mu;
  out->rests[REF_SQUARE] = fabsl(M) <= kappa * q->mu && fabsl(F) <= q->mu;
  out->rests[REF_HEXAGON] = fabsl(M) <= kappa * q->mu && fabsl(F) <= limit;
}

void ref_consistent_codim2(const ref_machine_t *machine, ref_state_t x,
                           ref_consistent_t *out) {
  memset(out, 0, sizeof *out);
  const ref_affine_t f = ref_affine(machine, x);
  real_t winding = 0;
  const int up = scan(machine, &f, 1, out, &winding);
  const int down = scan(machine, &f, -1, out, &winding);
  const bool right = stick(machine, &f, x, 1, out);
  const bool left = stick(machine, &f, x, -1, out);
  if (up != 0 && up == down && !right && !left) {
    out->winding = winding;
    out->spiral = winding > 0;
  }
  rest(machine, &f, x, out);
}

unsigned ref_consistent_set(const ref_consistent_t *consistent, ref_law_t law) {
  unsigned set = consistent->rests[law] ? 1u << REF_PINNED : 0;
  for (int i = 0; i < consistent->count; ++i) {
    set |= 1u << consistent->list[i].mode;
  }
  return set;
}

// Kinds of future in the order of the rule. Where the law of stick holds the
// wheel (the bow tie), a stick that arrives is held. Other motion runs into
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

static int kind_of(const ref_consistent_mode_t *way) {
  if (way->mode <= REF_SLIP_MINUS) {
    return way->family ? FAMILY : ATTRACTING_SLIP;
  }
  return way->attracting ? ATTRACTING_STICK : ESCAPING_STICK;
}

int ref_choose(const ref_consistent_t *consistent, ref_law_t law,
               int from_stick) {
  int best = REF_NONE, best_kind = NONE;
  for (int i = 0; i < consistent->count; ++i) {
    const ref_consistent_mode_t *f = &consistent->list[i];
    const int kind = kind_of(f);
    if (kind < best_kind ||
        (kind == best_kind && f->rate > consistent->list[best].rate)) {
      best = i;
      best_kind = kind;
    }
  }
  const int held = from_stick && consistent->rests[REF_BOW_TIE] ? HELD : REST;
  return best_kind > held && consistent->rests[law] ? REF_REST : best;
}
