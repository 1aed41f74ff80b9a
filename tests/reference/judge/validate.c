/// @file
/// The reference judged before it judges: its equations against the paper's at
/// random states, and its courses against tests/data, which the same solver
/// makes in quadruple precision.
#include <math.h>
#include <stdio.h>

#include "../../data/reference.h"
#include "judge.h"
#include "paper.h"

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

typedef struct {
  const reference_t *ref;
  int seen;
  real_t off;
} events_t;

static void on_event(const ref_orbit_t *orbit, ref_event_t event) {
  events_t *events = orbit->context;
  const real_t t = event == REF_CODIM2 ? orbit->at.t : orbit->x.t;
  if (events->seen < events->ref->events) {
    const real_t wanted = events->ref->event[events->seen].t;
    events->off = fmaxl(events->off, fabsl(t - wanted));
  }
  ++events->seen;
}

static void course(const reference_t *ref) {
  const ref_problem_t *problem = ref->problem;
  ref_machine_t q = problem->machine;
  events_t events = {.ref = ref};
  ref_orbit_t orbit = {.tolerance = 1e-15L,
                       .law = REF_HEXAGON,
                       .watch = on_event,
                       .context = &events};
  ref_prepare(&q);
  ref_begin(&orbit, &q, ref_problem_start(problem, &q), REF_MODES);
  // Its stops are those of the maker: `smooth` has an event that hangs on them.
  const real_t step = problem->t_grid / REF_SIXTEENTHS;
  int stops = 0;
  real_t off = 0;
  for (int i = 0; i < ref->states; ++i) {
    const reference_state_t *wanted = &ref->state[i];
    while (orbit.x.t < wanted->t - step / 2 && orbit.stop == REF_REACHED)
      ref_run(&orbit, step * ++stops);
    off = fmaxl(off, fabsl(orbit.x.r - wanted->r));
    off = fmaxl(off, fabsl(ref_v(&q, orbit.x) - wanted->v));
    off = fmaxl(off, fabsl(ref_w(&q, orbit.x) - wanted->w));
  }
  ref_run(&orbit, reference_end(ref) + 1e-9L);
  char what[64];
  snprintf(what, sizeof what, "%d states of tests/data", ref->states);
  check(problem->name, what, off, 1e-11L);
  snprintf(what, sizeof what, "times of its %d events", ref->events);
  // `smooth` passes its first h = 0 at 2e-6 m/s^2, so that the last digits of
  // h, and of libm, move that time.
  const bool slow = problem->machine.law == REF_SMOOTH;
  check(problem->name, what, events.off, slow ? 1e-10L : 1e-11L);
  check(problem->name, "events besides", events.seen - ref->events, 0);
}

static int run(const options_t *options) {
  (void)options;
  equations();
  for (int i = 0; i < REF_PROBLEMS; ++i) course(&references[i]);
  printf("%d of %d bad\n", failures, checks);
  return failures > 0;
}

const command_t command_validate = {
    "validate", "the reference against the paper and tests/data", 0, 0, run};
