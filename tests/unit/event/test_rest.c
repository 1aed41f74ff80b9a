/* A rest that ends within a step on a turntable that changes its speed, against
 * the conditions by the reference, looked for at close instants. When
 * it ends: law/test_pinned.c and law/test_located_turntable.c. */
#include "codim2_field.h"
#include "event/trajectory.h"

enum { INSTANTS = 512 };

/* A wheel at rest, and for how long. */
typedef struct {
  tf_params_t params;
  tf_machine_t k;
  ref_machine_t q;
  tf_input_t u;
  tf_real_t r, omega, length;
} rest_t;

static ref_affine_t field_at(const rest_t *c, real t) {
  return ref_affine(&c->q, (ref_state_t){.r = wide(c->r), .t = t, .piece = 1});
}

/* Whether a stick that attracts takes the wheel over. */
static bool attracts(const rest_t *c, real t) {
  const ref_affine_t at = field_at(c, t);
  return leaves_attracting(&c->q, &at, 1) || leaves_attracting(&c->q, &at, -1);
}

/* How far the force that holds the wheel is within its law; < 0 where the rest
 * has ended, also by a stick that attracts. */
static real margin_of_rest(const rest_t *c, real t) {
  const ref_affine_t at = field_at(c, t);
  if (attracts(c, t)) return -1;
  return ref_rest_margin(&c->q, ref_rest_force(&at), rest_laws[c->params.rest]);
}

/* Whether it ends within its length, even if it might go on later. */
static bool is_interrupted(const rest_t *c) {
  for (int i = 1; i <= INSTANTS; i++)
    if (margin_of_rest(c, wide(c->length) * i / INSTANTS) < 0) return true;
  return false;
}

static rest_t any_rest(int n) {
  rest_t c;
  memset(&c, 0, sizeof c);
  c.params = random_params();
  c.params.rest = (tf_rest_law_t)(n % TF_REST_LAWS);
  c.k = prepared(&c.params);
  c.u = tf_input_default(&c.k);
  c.u.alpha = uniform(-3, 3);
  c.omega = c.u.omega0;
  c.r = uniform(-0.5, 0.5);
  c.length = TF_R(0.25);
  const real F = wide(uniform(-1, 1) * c.params.mu);
  load_for(&c.params, &c.u, c.r, c.omega, F,
           wide(uniform(-1, 1) * c.params.mu * c.params.kappa));
  c.q = reference_of(&c.params, &c.u);
  return c;
}

static event_t next_event(const rest_t *c, taylor_t *motion, tf_real_t *time) {
  const segment_t segment = {.kind = SEGMENT_PINNED};
  begin_taylor(motion, &c->k, &c->u, c->omega, (phase_point_t){c->r, 0, 0});
  CHECK(tf_taylor_coefficients(motion, &segment, c->length));
  return tf_next_event(motion, &segment, c->length, time);
}

/* At the instant of the event the list of modes has the one that ends the rest:
 * the wheel is not left there by rounding. */
TEST(event_of_rest_is_seen_by_the_modes) {
  int by_stick = 0, by_slip = 0;
  for (int n = 0; n < samples(8000); n++) {
    rest_t c = any_rest(n);
    c.k.contact.rule = (tf_rule_t)(n / TF_REST_LAWS % TF_RULE_RANDOM);
    const unsigned asked = c.k.contact.rule == TF_RULE_SLIP_PLUS    ? 1
                           : c.k.contact.rule == TF_RULE_SLIP_MINUS ? 2
                                                                    : 0;
    static taylor_t motion;
    tf_real_t time;
    unsigned set[2], attracting[2];
    if (!(margin_of_rest(&c, 0) > 1e-3L)) continue;
    const event_t event = next_event(&c, &motion, &time);
    for (int i = 0; i < 2; i++) {
      const tf_real_t omega = i ? c.omega + c.u.alpha * time : c.omega;
      const rates_t rates = rates_at(&c.k, &c.u, c.r, 0, 0, omega);
      const codim2_field_t field = tf_codim2_field_of(&c.k, &rates);
      consistent_modes_t out;
      tf_codim2_modes(&c.k.contact, &field, &out);
      set[i] = out.solutions.set;
      attracting[i] = set[i] & out.solutions.attracting & STICKS;
    }
    if (set[0] & asked || event == EVENT_NONE) continue;
    CHECK(!(set[1] & TF_MODE_BIT(TF_PINNED)) || attracting[1] ||
          set[1] & asked);
    by_stick += attracting[1] != 0;
    by_slip += (set[1] & asked) != 0;
  }
  CHECK_ABOVE(by_stick, 50);
  CHECK_ABOVE(by_slip, 10);
}

/* A turntable that turns around within the step has the same speed and the same
 * forces at both ends. A stick that attracts between them, and is consistent at
 * neither, takes the wheel over: what rests then has missed it. */
TEST(rest_that_a_passing_stick_ends_is_coarse) {
  if (!IS_DOUBLE) SKIP("rounding of float is as large as the interruptions");
  int passes = 0;
  for (int n = 0; n < samples(400000) && passes < 20; n++) {
    rest_t c = any_rest(n);
    c.length = c.params.dt = TF_R(0.25);
    c.k = prepared(&c.params);
    c.omega = -c.u.alpha * c.length / 2;
    c.u.omega0 = c.omega;
    load_for(&c.params, &c.u, c.r, c.omega, wide(uniform(-1, 1) * c.params.mu),
             wide(uniform(-1, 1) * c.params.mu * c.params.kappa));
    c.q = reference_of(&c.params, &c.u);
    if (!(margin_of_rest(&c, 0) > 1e-3L) ||
        !(margin_of_rest(&c, wide(c.length)) > 1e-3L) ||
        !attracts(&c, wide(c.length) / 2))
      continue;
    c.u.omega0 = -c.omega;
    tf_state_t x = {.r = c.r, .w = c.omega, .mode = TF_PINNED};
    tf_report_t report;
    if (tf_step(&c.k, &x, &c.u, &report) < TF_OK || x.mode != TF_PINNED)
      continue;
    CHECK(report.status == TF_COARSE);
    passes++;
  }
  CHECK_ABOVE(passes, 9);
}

/* A step to whose end the rest is possible, but not throughout, says so if it
 * stays. */
TEST(rest_that_is_interrupted_is_coarse) {
  if (!IS_DOUBLE) SKIP("rounding of float is as large as the interruptions");
  int interrupted = 0, waits = 0;
  for (int n = 0; n < samples(40000) && interrupted < 20; n++) {
    rest_t c = any_rest(n);
    tf_state_t x = {.r = c.r, .w = c.omega, .mode = TF_PINNED};
    tf_report_t report;
    c.length = c.params.dt = TF_R(0.02);
    c.k = prepared(&c.params);
    if (!(margin_of_rest(&c, wide(c.length)) > 1e-9L) || !is_interrupted(&c))
      continue;
    c.u.omega0 += c.u.alpha * c.k.dt;
    /* Under RANDOM, where a stick alone does not end it, it need not. */
    tf_machine_t random = c.k;
    random.contact.rule = TF_RULE_RANDOM;
    tf_state_t y = x;
    waits +=
        tf_step(&random, &y, &c.u, &report) == TF_OK && y.mode == TF_PINNED;
    if (tf_step(&c.k, &x, &c.u, &report) < TF_OK || x.mode != TF_PINNED)
      continue;
    CHECK(report.status == TF_COARSE);
    interrupted++;
  }
  CHECK_ABOVE(interrupted, 9);
  CHECK_ABOVE(waits, 9);
}

/* Whether a rest ends at once: a stick attracts, or the slip of the rule is
 * consistent. */
static bool ends_at_once(const rest_t *c) {
  static const int mode_of_rule[TF_RULE_RANDOM] = {
      -1, [TF_RULE_SLIP_PLUS] = REF_SLIP_PLUS,
      [TF_RULE_SLIP_MINUS] = REF_SLIP_MINUS};
  const ref_affine_t at = field_at(c, 0);
  ref_consistent_t found;
  ref_consistent_field(&c->q, &at, &found);
  bool ends = attracts(c, 0);
  for (int i = 0; i < found.count; i++)
    ends |= (int)found.list[i].mode == mode_of_rule[c->params.rule];
  return ends;
}

/* A long step whose inclusion lacks the mode that ends its rest says so. */
TEST(rest_that_ends_at_once_goes_on_in_no_silent_step) {
  int stays[TF_RULE_RANDOM] = {0};
  for (int n = 0; n < samples(400000); n++) {
    rest_t c = any_rest(n);
    const int rule = n / TF_REST_LAWS % TF_RULE_RANDOM;
    c.params.rule = (tf_rule_t)rule;
    c.params.dt = TF_R(0.1);
    c.k = prepared(&c.params);
    c.u.alpha = 0;
    c.q = reference_of(&c.params, &c.u);
    tf_state_t x = {.r = c.r, .w = c.omega, .mode = TF_PINNED};
    tf_report_t report;
    if (stays[rule] == 20 || tf_step(&c.k, &x, &c.u, &report) < TF_OK ||
        x.mode != TF_PINNED || !ends_at_once(&c))
      continue;
    stays[rule]++;
    CHECK(!IS_DOUBLE || report.status == TF_COARSE);
  }
  for (int i = 0; i < TF_RULE_RANDOM; i++) CHECK_ABOVE(stays[i], 5);
}
