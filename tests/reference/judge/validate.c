/// The reference judged before it judges: its equations against the paper's at
/// random states, and its courses at two tolerances.
#include <math.h>
#include <stdio.h>

#include "judge.h"
#include "paper.h"
#include "problems.h"

static int failures, checks;

static void check(const char *name, const char *what, real_t off, real_t most) {
  const bool good = fabsl(off) <= most;
  failures += !good;
  ++checks;
  printf("%-4s %-12s %-46s off by %9.2Le, at most %.0Le\n", good ? "ok" : "BAD",
         name, what, off, most);
}

static real_t apart(real_t a, real_t b) {
  return fabsl(a - b) / (1 + fabsl(a) + fabsl(b));
}

// (h), (g), (force), (moment), (ds1)-(ds3), A and (muCalc).
static void equations(void) {
  real_t slip = 0, law = 0, field = 0, stick = 0;
  draw_t draw = draw_begin(1, 0);
  for (int i = 0; i < 1000; ++i) {
    lib_machine_t machine = draw_machine(&draw, false);
    machine.coulomb = machine.on_surface = false;
    machine.kappa += 0.01;
    const ref_machine_t q = draw_reference(&machine);
    const paper_t p = {PARAMETERS_OF(real_t, &q)};
    ref_state_t at = draw_start(&machine, &q);
    real_t x[3] = {at.r, ref_v(&q, at), ref_w(&q, at)}, dx[3], F, M;
    const ref_slip_t hg = ref_slip(&q, at);
    slip = fmaxl(slip, apart(hg.h, paper_h(&p, x)));
    slip = fmaxl(slip, apart(hg.g, paper_g(&p, x)));
    const ref_force_t f =
        ref_slip_force(&q, hg, ref_piece_at(&q, hg, ref_sign(hg.h)));
    paper_friction(&p, hg.h, hg.g, &F, &M);
    law = fmaxl(law, fmaxl(apart(f.F, F), apart(f.M, M)));
    const ref_rate_t rate = ref_rate(&q, at, f);
    paper_rhs_time(&p, x, F, M, dx);
    field = fmaxl(field, apart(rate.r, dx[0]));
    field = fmaxl(field, apart(rate.p + q.d * rate.z, dx[1]));
    field = fmaxl(field, apart(rate.z, dx[2]));
    if (fabsl(q.sine) < 1e-3L) continue;
    at = ref_with_h(&q, at, 0);
    x[1] = ref_v(&q, at);
    const int s = ref_sign(ref_slip(&q, at).g);
    const ref_edge_t edge = ref_edge(&q, at, s);
    stick = fmaxl(stick, apart(edge.A, paper_delassus(&p, at.r, s)));
    stick = fmaxl(stick, apart(edge.N, edge.A * paper_lambda(&p, x, s)));
  }
  check("equations", "(h), (g) of the paper", slip, 1e-17L);
  check("equations", "(force), (moment)", law, 1e-15L);
  check("equations", "(ds1)-(ds3)", field, 1e-15L);
  check("equations", "A, (muCalc)", stick, 1e-15L);
}

// At a tolerance a thousand times as large a course is the same.
static void course(int i) {
  const reference_t *ref = reference_course(i);
  const char *name = ref->problem->name;
  reference_t other;
  real_t off = 0, late = 0;
  reference_follow(i, 1e-12L, &other);
  for (int n = 0; n < ref->states; ++n) {
    const reference_state_t *a = &ref->state[n], *b = &other.state[n];
    off = fmaxl(off, fmaxl(fabsl(a->r - b->r),
                           fmaxl(fabsl(a->v - b->v), fabsl(a->w - b->w))));
  }
  for (int n = 0; n < ref->events && n < other.events; ++n)
    late = fmaxl(late, fabsl(ref->event[n].t - other.event[n].t));
  check(name, "states at another tolerance", off, 1e-10L);
  // `smooth` passes its first h = 0 at 2e-6 m/s^2, so that the last digits of h
  // move that time.
  const bool slow = ref->problem->machine.law == REF_SMOOTH;
  check(name, "times of events", late, slow ? 1e-7L : 1e-9L);
  check(name, "events besides", other.events - ref->events, 0);
}

static int run(const options_t *options) {
  (void)options;
  equations();
  for (int i = 0; i < REF_PROBLEMS; ++i) course(i);
  printf("%d of %d bad\n", failures, checks);
  return failures > 0;
}

const command_t command_validate = {
    "validate", "the reference against the paper and itself", 0, 0, run};
