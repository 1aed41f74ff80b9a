/* A contact for other mechanisms: choice and force against rule and law, and as
 * that of a machine against tf_step and tf_begin; test_friction.c has sets. */
#include "common.h"
#include "model/rates.h"

static tf_contact_t contact_of(const tf_params_t *p, tf_status_t want) {
  tf_contact_t contact = {.exit_threshold = 7};
  CHECK(tf_contact_prepare(&contact, p->law, p->mu, p->kappa, p->rest, p->rule,
                           p->rate * p->dt) == want);
  return contact;
}

static tf_contact_t any_contact(int n) {
  tf_params_t p = wide_params();
  p.law = n % 4 ? TF_TYRE_JUMP : TF_TYRE_COULOMB;
  p.rule = (tf_rule_t)(n / 4 % TF_RULES);
  p.rate = 1 / (4 * p.dt);
  return contact_of(&p, TF_OK);
}

TEST(contact_out_of_range_is_refused) {
  const tf_real_t no = (tf_real_t)NAN, low = -TF_REAL_MIN, high = TF_R(1.1e9);
  const tf_real_t mu[13] = {1, low, high, no, 1, 1, 1, 1, 1, 1, 1, 1, 1};
  const tf_real_t kappa[13] = {1, 1, 1, 1, 0, high, no, 1, 1, 1, 1, 1, 1};
  const tf_real_t exits[13] = {1, 1, 1, 1, 1, 1, 1, low, high, no, 1, 1, 1};
  for (int i = 0; i < 13; i++) {
    const tf_params_t p = {.law = i == 10 ? TF_TYRE_SMOOTH : TF_TYRE_JUMP,
                           .rest = (tf_rest_law_t)(i == 11 ? TF_REST_LAWS : 0),
                           .rule = (tf_rule_t)(i == 12 ? TF_RULES : 0),
                           .mu = mu[i],
                           .kappa = kappa[i],
                           .rate = exits[i],
                           .dt = 1};
    const tf_contact_t is = contact_of(&p, i > 0 ? TF_BAD_PARAMETER : TF_OK);
    CHECK((is.exit_threshold == 7) == (i > 0));
  }
}

static tf_form_t any_form(double c0) {
  return (tf_form_t){uniform(-c0, c0),   uniform(-1, 1),
                     uniform(-1, 1),     uniform(-0.1, 0.1),
                     uniform(-0.1, 0.1), uniform(-0.1, 0.1)};
}

static real at(const tf_form_t *f, real x, real y) {
  return wide(f->c0) + wide(f->cx) * x + wide(f->cy) * y +
         wide(f->cxx) * x * x + wide(f->cxy) * x * y + wide(f->cyy) * y * y;
}

TEST(numbers_that_are_not_finite_are_refused) {
  const tf_contact_t jump = any_contact(1), plain = any_contact(0);
  for (unsigned i = 0; i <= 15; i++) {
    tf_real_t c[14] = {1, -1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 0, 0, 0};
    if (i < 14) c[i] = i % 2 ? (tf_real_t)NAN : (tf_real_t)INFINITY;
    const tf_form_t h = {c[0], c[1], c[2], c[3], c[4], c[5]};
    const tf_form_t g = {c[6], c[7], c[8], c[9], c[10], c[11]};
    const tf_slip_t now = {c[12], c[13]};
    const unsigned mode = TF_NO_MODE + (i == 14);
    tf_contact_modes_t is = {.set = TF_MODE_BIT(TF_SLIP_PLUS)};
    tf_force_t f;
    CHECK((tf_contact_force(&jump, &h, &g, &is, i < 14 ? 0 : mode, now, &f) ==
           TF_BAD_STATE) == (i < 15));
    CHECK((tf_contact_modes(&jump, &h, &g, now, mode, &is, NULL) == TF_OK) ==
          (i == 15));
    if (i < 12 && (0x34 >> i % 6 & 1)) { /* y is not read without a moment */
      CHECK(tf_contact_modes(&plain, &h, &g, now, mode, &is, NULL) == TF_OK);
      CHECK(tf_contact_force(&plain, &h, &g, &is, mode, now, &f) ==
            TF_DEGRADED);
    }
    CHECK((tf_contact_leave(&jump, &h, &g, mode, false, 0, 1, &is, &f) ==
           TF_NO_MODE) == ((i < 12 && i % 6 < 3) || i == 14));
  }
}

TEST(choice_and_force_are_of_rule_and_law) {
  unsigned held = 0, left = 0;
  for (int n = 0; n < samples(4000); n++) {
    const tf_contact_t k = any_contact(n);
    tf_form_t h = any_form(1);
    const tf_form_t g = any_form(3);
    const tf_slip_t now = {uniform(-2, 2), uniform(-2, 2)};
    const real mu = wide(k.tyre.mu), kappa_mu = wide(k.kappa_mu);
    if (k.tyre.law == TF_TYRE_COULOMB && h.cx > 0) h.cx = -h.cx;
    tf_contact_modes_t is;
    tf_force_t f;
    CHECK(tf_contact_modes(&k, &h, &g, now, TF_NO_MODE, &is, NULL) == TF_OK);
    tf_contact_modes_t pinned = is; /* without such a point there is no force */
    pinned.set |= (uint8_t)TF_MODE_BIT(TF_PINNED);
    if (kappa_mu > 0)
      CHECK((tf_contact_force(&k, &h, &g, &pinned, TF_PINNED, now, &f) ==
             TF_OK) == (is.set >> TF_PINNED & 1));
    const tf_real_t of_x[] = {1, -1, is.x[0], is.x[1], 0, 0};
    const tf_real_t of_y[] = {is.tau[0], -is.tau[1], is.x[0], -is.x[1], 0, 0};
    for (unsigned mode = 0; mode <= TF_NO_MODE; mode++) {
      const bool none = mode == TF_NO_MODE, in = is.set >> mode & 1u;
      const unsigned next = tf_contact_choose(&k, &is, mode, (unsigned)n, 1);
      CHECK(next == TF_NO_MODE || is.set >> next & 1u);
      if (in && (tf_mode_is_slip(mode) || (is.attracting >> mode & 1u)))
        CHECK(next == mode);
      left += in && next != mode && k.rule == TF_RULE_RANDOM;
      const tf_status_t status =
          tf_contact_force(&k, &h, &g, &is, mode, now, &f);
      CHECK(status == (none ? TF_DEGRADED : in ? TF_OK : TF_BAD_STATE));
      if (status < TF_OK) continue;
      if (mode == TF_PINNED) continue; /* test_joint.c has its force */
      real x = wide(of_x[mode]), y = kappa_mu > 0 ? wide(of_y[mode]) : 0;
      if (mode == TF_STICK_PLUS || mode == TF_STICK_MINUS)
        CHECK(fabsl(x) <= 1 && fabsl(at(&h, x, y)) < 64 * EPSILON);
      if (none || tf_mode_is_slip(mode)) {
        const bool minus = none ? now.h < 0 : mode == TF_SLIP_MINUS;
        const tf_real_t side = minus ? -1 : 1;
        const tf_force_t law = tf_tyre_force(&k.tyre, side, now.h, now.g);
        const real x1 = wide(law.F) / mu;
        const real y1 = kappa_mu > 0 ? wide(law.M) / kappa_mu : 0;
        const bool stays = none || wide(side) * at(&h, x1, y1) > 0;
        held += !stays;
        x = stays ? x1 : x;
        y = stays ? y1 : y;
      }
      CHECK_NEAR(wide(f.F), mu * x, 8 * EPSILON * mu);
      CHECK_NEAR(wide(f.M), kappa_mu * y, 8 * EPSILON * kappa_mu);
    }
  }
  CHECK(held > 0 && left > 0);
}

/* At h = g = 0; test_friction.c has steps. */
TEST(machine_by_its_contact) {
  unsigned rests = 0;
  for (int n = 0; n < samples(16000); n++) {
    tf_params_t p = wide_params();
    p.rule = (tf_rule_t)(n % TF_RULES);
    p.rest = (tf_rest_law_t)(n / TF_RULES % TF_REST_LAWS);
    p.law = n % 5 ? TF_TYRE_JUMP : TF_TYRE_COULOMB;
    if (n % 64 == 0) p.mu = 0;
    const tf_machine_t k = prepared(&p);
    const tf_contact_t contact = contact_of(&p, TF_OK);
    CHECK(memcmp(&contact.tyre.mu, &k.contact.tyre.mu,
                 offsetof(tf_contact_t, rule) -
                     offsetof(tf_contact_t, tyre.mu)) == 0);
    const tf_input_t u = tf_input_default(&k);
    tf_state_t x = {.r = uniform(-1, 1), .mode = TF_NO_MODE, .seed = 1};
    tf_report_t report;
    tf_contact_modes_t is;
    tf_force_t f;
    x.w = u.omega0;
    CHECK(tf_begin(&k, &x, &u, &report) == TF_OK);
    const rates_t rates = rates_at(&k, &u, x.r, 0, 0, u.omega0);
    const codim2_field_t field = tf_codim2_field_of(&k, &rates);
    const tf_form_t h = {field.h.c0, field.h.cx, field.h.cy, 9, 9, 9};
    const tf_form_t g = {field.g.c0, field.g.cx, field.g.cy, 9, 9, 9};
    unsigned mode =
        tf_contact_leave(&contact, &h, &g, TF_PINNED, false, 0, 1, &is, &f);
    if (k.contact.stick_kappa > 0) {
      const real close = 64 * EPSILON * (1 + wide(p.mu));
      CHECK(is.set == report.set);
      CHECK(mode == report.mode || is.set == 0 || report.mode == TF_PINNED);
      rests += mode == TF_PINNED;
      if (mode == report.mode) {
        CHECK_NEAR(f.F, report.force.F, close);
        CHECK_NEAR(f.M, report.force.M, close);
      }
      if (mode < 2) CHECK_NEAR(is.tau[mode] * f.F * p.kappa, f.M, close);
    }
  }
  CHECK(rests > 0);
}

/* A force that raises h, or that stands in the place of a moment. */
TEST(forms_that_drive_a_block_are_refused) {
  const tf_contact_t block = any_contact(0), wheel = any_contact(1);
  const tf_form_t g = {0, 0, 0, 0, 0, 0};
  const tf_real_t wrong[3][2] = {{1, 0}, {TF_REAL_MIN, -1}, {0, -1}};
  for (unsigned i = 0; i < 3; i++) {
    tf_form_t h = {TF_R(0.5), wrong[i][0], wrong[i][1], 0, 0, 0};
    tf_contact_modes_t is;
    CHECK(tf_contact_modes(&block, &h, &g, (tf_slip_t){0, 0}, TF_NO_MODE, &is,
                           NULL) == TF_BAD_PARAMETER);
    CHECK(tf_contact_modes(&wheel, &h, &g, (tf_slip_t){0, 0}, TF_NO_MODE, &is,
                           NULL) == TF_OK);
    h.cx = i < 2 ? -h.cx : 0;
    h.cy = 0;
    CHECK(tf_contact_modes(&block, &h, &g, (tf_slip_t){0, 0}, TF_NO_MODE, &is,
                           NULL) == TF_OK);
  }
}

TEST(what_leaves_h_0_without_a_moment) {
  const tf_contact_t k = any_contact(0);
  const tf_form_t g = {1, 0, 9, 0, 0, 0};
  for (unsigned i = 0; i < 4; i++) {
    /* braked by less than it takes, or more; driven, there or arriving */
    const tf_form_t h = {i == 1 ? 3 : TF_R(0.5), i < 2 ? -1 : 1, 9, 0, 0, 0};
    const tf_real_t x = i % 2 ? 1 : i ? TF_R(-0.5) : TF_R(0.5);
    tf_contact_modes_t is;
    tf_force_t f;
    CHECK(tf_contact_leave(&k, &h, &g, TF_STICK_PLUS, i % 2, 0, 1, &is, &f) ==
          (i % 2 ? TF_SLIP_PLUS : TF_STICK_PLUS));
    CHECK(f.F == x * k.tyre.mu && f.M == 0);
  }
}
