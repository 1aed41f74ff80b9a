/* The border of a step: what each scheme refuses and leaves untouched. Which
 * numbers are in range is test_kernel's and test_begin's; that a step is the
 * equations of motion is test_scheme's. */
#include "same_state.h"
#include "sim.h"

static sim_t good(const tf_params_t *params) {
  sim_t s = sim_of(params);
  s.x = (tf_state_t){
      .r = TF_R(0.5), .v = TF_R(0.3), .w = TF_R(-0.5), .seed = 3, .tick = 7};
  memset(&s.report, 0x5A, sizeof s.report);
  return s;
}

/* The located step has no series of a law that is single-valued. */
static bool takes(scheme_t scheme, tf_tyre_law_t law) {
  return scheme != LOCATED || tf_tyre_is_set_valued(law) || law == TF_TYRE_NONE;
}

static void refused(const sim_t *bad, scheme_t scheme, tf_status_t want) {
  sim_t s = *bad;
  if (!takes(scheme, bad->params.law)) want = TF_BAD_PARAMETER;
  CHECK(sim_step(&s, scheme) == want);
  CHECK(s.report.status == want);
  CHECK(same_state(&s.x, &bad->x));
  CHECK(memcmp(&s.low, &bad->low, sizeof s.low) == 0);
}

/* By every entry. */
static void bad_state(const sim_t *bad) {
  for (int scheme = 0; scheme < SCHEMES; scheme++)
    refused(bad, (scheme_t)scheme, TF_BAD_STATE);
  sim_t s = *bad;
  CHECK(sim_begin(&s) == TF_BAD_STATE);
  CHECK(same_state(&s.x, &bad->x));
  CHECK(same_report(&s.report, &bad->report));
}

TEST(bad_states_are_refused) {
  for (int i = 0; i < TF_SCENES; i++) {
    const sim_t whole = good(&tf_scenes[i]->params);
    const unsigned mode[] = {TF_MODES + 1, 127, 255};
    sim_t s = whole;
    s.x.w = (tf_real_t)NAN;
    bad_state(&s);
    s = whole;
    s.u.torque = 2 * TF_STATE_LIMIT;
    bad_state(&s);
    s = whole;
    for (int n = 0; n < 3; n++) {
      s.x.mode = (uint8_t)mode[n];
      bad_state(&s);
    }
    /* To tf_begin any mode will do, a step refuses it. */
    s.x.mode = TF_NO_MODE;
    for (int scheme = 0; scheme < SCHEMES; scheme++)
      refused(&s, (scheme_t)scheme, TF_BAD_STATE);
    CHECK(sim_begin(&s) == TF_OK);
    for (int scheme = 0; scheme < SCHEMES; scheme++)
      CHECK(sim_step(&s, (scheme_t)scheme) ==
            (takes((scheme_t)scheme, s.params.law) ? TF_OK : TF_BAD_PARAMETER));
  }
}

/* One member of the compensation, or two. */
TEST(bad_compensations_are_refused) {
  for (int i = 0; i < 16; i++) {
    sim_t s = good(&tf_scenes[0]->params);
    tf_real_t *const member[] = {&s.low.r, &s.low.v, &s.low.w, &s.low.phi};
    *member[i % 4] = *member[i / 4] = 2 * TF_STATE_LIMIT;
    refused(&s, COMPENSATED, TF_BAD_STATE);
    *member[i % 4] = (tf_real_t)NAN;
    refused(&s, COMPENSATED, TF_BAD_STATE);
  }
}

/* r moves in one step just so far that the disc has no inertia left, to the
 * last bit; Coriolis' force alone would make a number of it. */
TEST(no_inertia_left_is_refused) {
  for (int law = 0; law < TF_TYRE_LAWS; law++) {
    tf_params_t p = params_of_law((tf_tyre_law_t)law);
    p.m = 1;
    p.d = p.k2 = p.c1 = p.c2 = 0;
    p.beta = p.dt = TF_R(0.5);
    p.theta = 1;
    sim_t s = good(&p);
    s.x.r = s.x.w = 1;
    s.x.v = -1;
    refused(&s, MOREAU, TF_STEP_TOO_LONG);
    refused(&s, COMPENSATED, TF_STEP_TOO_LONG);
    s.x.v = TF_R(-0.75);
    sim_t pairs = s;
    const tf_status_t status = sim_step(&s, MOREAU);
    CHECK(status >= TF_OK && sim_step(&pairs, COMPENSATED) == status);
  }
}

TEST(a_diverging_step_is_refused) {
  for (int law = 0; law < TF_TYRE_LAWS; law++) {
    tf_params_t p = params_of_law((tf_tyre_law_t)law);
    p.m = TF_R(1e-3);
    p.k2 = 0;
    p.dt = TF_R(0.1);
    sim_t s = good(&p);
    s.u.force = TF_R(0.9e9);
    refused(&s, MOREAU, TF_DIVERGED);
    refused(&s, COMPENSATED, TF_DIVERGED);
    s.u.force = 1;
    CHECK(sim_step(&s, MOREAU) == TF_COARSE);
  }
}
