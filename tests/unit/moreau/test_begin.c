/* tf_begin against the reference: which modes are consistent on h = 0 and at
 * h = g = 0, and the force of one. The mode that is asked for is taken where it
 * is consistent and ignored elsewhere. */
#include <stdbool.h>

#include "codim2_field.h"
#include "same_state.h"

#define BIT(mode) ((unsigned)TF_MODE_BIT(mode))

/* tf_begin from x in the mode that is asked for, TF_NO_MODE for any; what must
 * hold of every report is checked. */
static tf_report_t begun(const tf_machine_t *machine, const tf_state_t *x,
                         unsigned asked) {
  const tf_input_t input = tf_input_default(machine);
  tf_state_t state = *x;
  tf_report_t report;
  int modes = 0;
  memset(&report, 0, sizeof report);
  state.mode = (uint8_t)asked;
  CHECK(tf_begin(machine, &state, &input, &report) == TF_OK);
  CHECK(report.status == TF_OK && report.mode == state.mode);
  CHECK(state.mode < TF_MODES && (report.set & BIT(state.mode)));
  CHECK(state.r == x->r && state.v == x->v && state.w == x->w);
  CHECK(state.phi == x->phi && state.tick == x->tick && state.seed == x->seed);
  for (int i = 0; i < TF_MODES; i++) modes += report.set >> i & 1;
  CHECK(report.choices == modes);
  const tf_slip_t slip = tf_slip(machine, x->r, x->v, x->w, machine->omega0);
  CHECK(report.slip.h == slip.h && report.slip.g == slip.g);
  CHECK(report.residual == 0);
  if (asked < TF_MODES && (report.set & BIT(asked))) CHECK(state.mode == asked);
  return report;
}

/* The set does not depend on the mode that is asked for, and asking for one
 * outside of it is as asking for none. */
static void asked_mode_is_taken_if_consistent(const tf_machine_t *machine,
                                              const tf_state_t *x) {
  const tf_report_t none = begun(machine, x, TF_NO_MODE);
  for (unsigned asked = 0; asked < TF_MODES; asked++) {
    const tf_report_t other = begun(machine, x, asked);
    CHECK(other.set == none.set);
    if (!(none.set & BIT(asked))) CHECK(other.mode == none.mode);
  }
}

/* A state on h = 0 and the reference's view of it. */
typedef struct {
  tf_state_t x;
  ref_state_t at;
  ref_edge_t edge; /* [1/kg], [m/s^2] */
  int s;           /* sign of g */
  unsigned set;    /* of consistent modes */
  real size;       /* of the terms of N */
} contact_t;

/* False where rounding could decide: near the borders of a region. */
static bool on_the_surface(const tf_machine_t *k, const ref_machine_t *q,
                           contact_t *c) {
  const double reach = tap_bits() & 1u ? 1 : 0.2; /* most escape at small r */
  *c = (contact_t){
      .x = {.r = uniform(-reach, reach), .phi = 5, .tick = 17, .seed = 4}};
  c->x.w = k->omega0 + uniform(-2 * reach, 2 * reach);
  CHECK(tf_speed_for_slip(k, c->x.r, c->x.w, k->omega0, 0, &c->x.v) == TF_OK);
  c->at = ref_state(q, wide(c->x.r), wide(c->x.v), wide(c->x.w));
  c->at = ref_with_h(q, c->at, 0);
  const ref_rate_t none = ref_rate(q, c->at, (ref_force_t){0, 0});
  const real g = ref_slip(q, c->at).g;
  ref_consistent_t found;
  ref_consistent_edge(q, c->at, &found);
  for (int i = 0; i < found.count; i++) c->set |= BIT(found.list[i].mode);
  c->s = g < 0 ? -1 : 1;
  c->edge = ref_edge(q, c->at, c->s);
  c->size = 1 + fabsl(none.p) + 2 * fabsl(none.z) + fabsl(wide(c->x.v));
  const real doubt = 1000 * EPSILON * c->size;
  return fabsl(g) > 0.001L && fabsl(c->edge.A) > doubt &&
         fabsl(c->edge.plus) > doubt && fabsl(c->edge.minus) > doubt;
}

/* Returns whether it sticks. */
static bool judge_contact(const tf_machine_t *machine, const ref_machine_t *q,
                          const contact_t *c) {
  const tf_report_t report = begun(machine, &c->x, TF_NO_MODE);
  ref_orbit_t orbit = {.tolerance = 1e-13L};
  ref_begin(&orbit, q, c->at, REF_MODES);
  const ref_force_t by = ref_force(&orbit, orbit.x);
  const bool sticks = !tf_mode_is_slip(report.mode);
  const real A = fabsl(c->edge.A), kappa = q->kappa;
  CHECK(report.set == c->set && report.mode == (unsigned)orbit.mode);
  CHECK_NEAR(wide(report.delassus), c->edge.A, 32 * EPSILON * (1 + A));
  const real tol = sticks ? 100 * EPSILON * (c->size + fabsl(by.F)) / A
                          : 1e4L * EPSILON * q->mu;
  CHECK_NEAR(wide(report.force.F), by.F, tol);
  CHECK_NEAR(wide(report.force.M), by.M, sticks ? kappa * tol : tol);
  asked_mode_is_taken_if_consistent(machine, &c->x);
  return sticks;
}

/* Twice the mass of a scene under twice the forces. Without a moment no region
 * escapes, and stick has none. */
TEST(begin_finds_the_mode) {
  int seen[2][3] = {{0, 0, 0}, {0, 0, 0}};
  tf_params_t p = tf_scenes[0]->params;
  p.m *= 2, p.k2 *= 2, p.c1 *= 2, p.c2 *= 2, p.mu *= 2;
  for (int i = 0; i < samples(120000); i++) {
    contact_t c;
    const bool moment = i % 6 > 0;
    p.law = moment ? TF_TYRE_JUMP : TF_TYRE_COULOMB;
    const tf_machine_t machine = prepared(&p);
    const tf_input_t u = tf_input_default(&machine);
    const ref_machine_t q = reference_of(&p, &u);
    if (!on_the_surface(&machine, &q, &c)) continue;
    CHECK(moment || c.edge.A > 0);
    const bool sticks = judge_contact(&machine, &q, &c);
    seen[c.s < 0][!sticks ? 0 : c.edge.A > 0 ? 1 : 2]++;
  }
  for (int s = 0; s < 2; s++) { /* crossing, sliding, escaping */
    for (int n = 0; n < 3; n++) CHECK_ABOVE(seen[s][n], samples(100));
  }
  p.law = TF_TYRE_COULOMB;
  const tf_machine_t coulomb = prepared(&p);
  tf_state_t x = {.r = TF_R(0.5), .w = p.omega0};
  const tf_report_t still = begun(&coulomb, &x, TF_NO_MODE);
  CHECK(still.mode != TF_PINNED);
  x.w += TF_R(1e-4); /* it rolls slowly, under nearly the same force */
  CHECK(tf_speed_for_slip(&coulomb, x.r, x.w, p.omega0, 0, &x.v) == TF_OK);
  const real F = wide(begun(&coulomb, &x, TF_NO_MODE).force.F);
  CHECK(fabsl(F) > 0.1L);
  CHECK_NEAR(still.force.F, F, 1e-3L);
}

/* Off h = 0 the side decides alone, at any law, whatever mode is asked for. */
TEST(begin_off_the_surface) {
  for (int i = 0; i < samples(60000); i++) {
    tf_params_t params = tf_scenes[0]->params;
    params.epsilon = params.k = params.delta = params.a = params.rho = 1;
    params.law = (tf_tyre_law_t)(i % TF_TYRE_LAWS);
    const tf_machine_t machine = prepared(&params);
    const tf_state_t x = {
        .r = uniform(-2, 2), .v = uniform(-2, 2), .w = uniform(-2, 2)};
    const tf_slip_t slip = tf_slip(&machine, x.r, x.v, x.w, params.omega0);
    if (fabsl(wide(slip.h)) < 200 * EPSILON) continue;
    const tf_report_t report = begun(&machine, &x, TF_NO_MODE);
    const tf_real_t side = slip.h > 0 ? TF_R(1.0) : TF_R(-1.0);
    const tf_force_t f =
        tf_tyre_force(&machine.contact.tyre, side, slip.h, slip.g);
    CHECK(report.mode == (slip.h > 0 ? TF_SLIP_PLUS : TF_SLIP_MINUS));
    CHECK(report.choices == 1);
    CHECK(report.force.F == f.F && report.force.M == f.M);
    if (!tf_tyre_is_set_valued(params.law)) CHECK(report.delassus == 0);
    asked_mode_is_taken_if_consistent(&machine, &x);
  }
}

/* v that places h, up to the rounding band and beyond it. */
TEST(begin_counts_rounding_as_zero) {
  const tf_params_t params = tf_scenes[6]->params; /* rolling */
  const tf_machine_t machine = prepared(&params);
  tf_state_t x = {.r = TF_R(0.95), .w = TF_R(1.3)};
  int slips = 0;
  CHECK(!strcmp(tf_scenes[6]->name, "rolling"));
  for (int n = -40; n <= 40; n++) {
    CHECK(tf_speed_for_slip(&machine, x.r, x.w, -1, 0, &x.v) == TF_OK);
    x.v += 16 * TF_REAL_EPSILON * (tf_real_t)n;
    const tf_slip_t slip = tf_slip(&machine, x.r, x.v, x.w, -1);
    const real z = wide(x.w) + 1, h = wide(slip.h);
    const real terms = fabsl(wide(x.v)) + (1 + wide(x.r)) * z;
    const tf_report_t report = begun(&machine, &x, TF_NO_MODE);
    slips += tf_mode_is_slip(report.mode);
    if (fabsl(h) < 31.9L * EPSILON * terms)
      CHECK(!tf_mode_is_slip(report.mode));
    if (fabsl(h) > 32.1L * EPSILON * terms)
      CHECK(report.mode == (h > 0 ? TF_SLIP_PLUS : TF_SLIP_MINUS));
  }
  CHECK(slips > 10 && slips < 70);
}

/* The modes in which the reference leaves h = g = 0, or rests there. */
static unsigned reference_set(const ref_machine_t *q, tf_rest_law_t rest,
                              ref_state_t x) {
  ref_consistent_t found;
  ref_consistent_codim2(q, x, &found);
  unsigned set = found.rests[rest_laws[rest]] ? BIT(TF_PINNED) : 0;
  for (int i = 0; i < found.count; i++) set |= BIT(found.list[i].mode);
  return set;
}

/* Whether the reference has another set next to a point, so that rounding may
 * decide. */
static bool is_border(const ref_machine_t *q, tf_rest_law_t rest,
                      ref_state_t x) {
  const real near = IS_DOUBLE ? 1e-6L : 1e-3L;
  const ref_state_t above = {x.r * (1 + near), 0, x.z * (1 + near), 0, 1};
  const ref_state_t below = {x.r * (1 - near), 0, x.z * (1 - near), 0, 1};
  const unsigned set = reference_set(q, rest, x);
  return set != reference_set(q, rest, above) ||
         set != reference_set(q, rest, below);
}

/* The force of a start holds h or g, or gives it the sign of the mode. */
static void judge_force(const ref_machine_t *q, const tf_report_t *report,
                        ref_state_t x) {
  const ref_force_t force = {wide(report->force.F), wide(report->force.M)};
  const ref_rate_t rate = ref_rate(q, x, force);
  const ref_rate_t none = ref_rate(q, x, (ref_force_t){0, 0});
  const unsigned mode = report->mode;
  const real off =
      1e3L * EPSILON * (1 + fabsl(none.p) + fabsl(none.z) + q->mu / q->m);
  if (tf_mode_is_slip(mode))
    CHECK((mode == TF_SLIP_PLUS ? rate.h : -rate.h) > -off);
  else
    CHECK(fabsl(rate.h) < off);
  if (mode == TF_PINNED) CHECK(fabsl(rate.g) < off);
  if (mode == TF_STICK_PLUS) CHECK(rate.g > -off);
  if (mode == TF_STICK_MINUS) CHECK(rate.g < off);
}

/* v = d z and r z = 0: h = g = 0. The wheel rests where its law holds it, and
 * else is in another mode of the set, or at rest where that is empty. */
TEST(begin_at_codimension_two_has_every_future) {
  int sizes[TF_MODES + 1] = {0}, borders = 0;
  for (int n = 0; n < samples(1000); n++) {
    tf_params_t params = any_params(n);
    params.rest = (tf_rest_law_t)(n % TF_REST_LAWS);
    params.rule = (tf_rule_t)(n / 3 % TF_RULES);
    const tf_machine_t k = prepared(&params);
    tf_input_t u = tf_input_default(&k);
    u.force = n % 2 ? uniform(-2, 2) : 0;
    u.torque = n % 2 ? uniform(-1, 1) : 0;
    u.alpha = n % 5 ? 0 : uniform(-2, 2);
    const ref_machine_t q = reference_of(&params, &u);
    const bool passes_axis = n % 7 == 0;
    const tf_real_t z = passes_axis ? uniform(-2, 2) : 0;
    const tf_state_t x = {.r = passes_axis ? 0 : uniform(-0.6, 0.6),
                          .v = params.d * z,
                          .w = params.omega0 + z};
    const ref_state_t at = {wide(x.r), 0, wide(z), 0, 1};
    const unsigned want = reference_set(&q, params.rest, at);
    for (unsigned asked = 0; asked <= TF_NO_MODE; asked++) {
      tf_state_t y = x;
      tf_report_t report;
      y.mode = (uint8_t)asked;
      CHECK(tf_begin(&k, &y, &u, &report) == TF_OK);
      if (report.set != want && is_border(&q, params.rest, at)) {
        borders++;
        break;
      }
      CHECK(report.set == want && report.mode == y.mode);
      if (params.rest == TF_REST_HULL && !passes_axis) CHECK(want);
      if (want & BIT(asked))
        CHECK(y.mode == asked);
      else if (!want || want & BIT(TF_PINNED))
        CHECK(y.mode == TF_PINNED);
      else
        CHECK(want & BIT(y.mode));
      /* g = 0 counts as rolling forwards. */
      const real A = ref_edge(&q, at, 1).A;
      CHECK_NEAR(wide(report.delassus), A, 1e3L * EPSILON * (1 + fabsl(A)));
      if (want) judge_force(&q, &report, at);
      if (asked == TF_NO_MODE) sizes[report.choices]++;
    }
  }
  CHECK_BELOW(100 * borders, samples(1000) + 100);
  for (int i = 1; i <= 4; i++) CHECK_ABOVE(sizes[i], samples(1));
}

/* gamma = 0 and r = 0: no force acts on h, and none is needed. */
TEST(begin_where_no_force_acts_on_h) {
  tf_params_t params = tf_scenes[0]->params;
  params.gamma = 0;
  const tf_machine_t machine = prepared(&params);
  for (int side = -1; side <= 1; side += 2) {
    const tf_state_t x = {.v = (tf_real_t)side, .w = params.omega0};
    const tf_report_t report = begun(&machine, &x, TF_NO_MODE);
    CHECK(report.mode == (side < 0 ? TF_STICK_PLUS : TF_STICK_MINUS));
    CHECK(report.force.F == 0 && report.choices == 1);
  }
}

/* The limit is one of sums: of the state, of the inputs; each alone may be as
 * large, and two of either sign may not. */
TEST(begin_refuses_sums_beyond_the_limit) {
  const tf_machine_t machine = prepared(&tf_scenes[0]->params);
  for (int i = 0; i < 8; i++)
    for (int j = 0; j < 8; j++)
      for (int signs = 0; signs < 4; signs++) {
        tf_real_t value[8] = {0};
        value[i] = (signs & 1 ? TF_R(-0.75) : TF_R(0.75)) * TF_STATE_LIMIT;
        value[j] = (signs & 2 ? TF_R(-0.75) : TF_R(0.75)) * TF_STATE_LIMIT;
        tf_state_t x = {.r = value[0], .v = value[1], .w = value[2]};
        const tf_input_t u = {value[3], value[4], value[5], value[6], value[7]};
        const bool apart = i == j || (i < 3) != (j < 3);
        tf_report_t report;
        x.mode = TF_NO_MODE;
        CHECK(tf_begin(&machine, &x, &u, &report) ==
              (apart ? TF_OK : TF_BAD_STATE));
        if (apart) continue;
        x.mode = TF_SLIP_PLUS;
        CHECK(tf_step(&machine, &x, &u, &report) == TF_BAD_STATE);
        CHECK(tf_step_located(&machine, &x, &u, &report) == TF_BAD_STATE);
      }
}
