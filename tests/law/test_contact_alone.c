/* Scene `chaos` by twofold/contact.h alone, stepped as docs/USE.md says,
 * against its reference: through h = g = 0 into stick-, out of the next one by
 * slip-, into the lower sliding region. */
#include "common.h"
#include "problems.h"

typedef struct {
  double v, w;
} u_t;

/* M^-1 times a force on the slider and a torque on the disc. */
static u_t response(const tf_params_t *p, double r, double Q_r, double Q_phi) {
  const double J = p->m * (p->beta * p->beta + r * r);
  const double w = (p->d * Q_r + Q_phi) / J;
  const u_t u = {Q_r / p->m + p->d * w, w};
  return u;
}

/* gradients: those of h and g by v and w, at the end of a step of dt. */
static tf_slip_t slip_of(const tf_params_t *p, double r, u_t u, double dt,
                         u_t gradients[2]) {
  const double sine = sin(p->gamma), cosine = cos(p->gamma), d = p->d;
  const double z = u.w - p->omega0, P = u.v - d * z;
  const u_t of_h = {-sine - dt * z * cosine, d * sine - r * cosine};
  const u_t of_g = {-cosine + dt * z * sine, d * cosine + r * sine};
  const tf_slip_t slip = {(tf_real_t)(-P * sine - r * z * cosine),
                          (tf_real_t)(-P * cosine + r * z * sine)};
  gradients[0] = of_h;
  gradients[1] = of_g;
  return slip;
}

static tf_form_t form_of(double c0, u_t by, u_t x, u_t y) {
  const tf_form_t form = {.c0 = (tf_real_t)c0,
                          .cx = (tf_real_t)(by.v * x.v + by.w * x.w),
                          .cy = (tf_real_t)(by.v * y.v + by.w * y.w)};
  return form;
}

static void follow(double dt) {
  const tf_params_t *p = &tf_scenes[0]->params;
  const reference_event_t *want = reference_course(0)->event;
  const double mu = p->mu, kappa_mu = p->kappa * mu, sine = sin(p->gamma);
  double r = 0.18;
  u_t u = {0, -1.037}, by[2];
  unsigned mode = TF_NO_MODE, before = TF_NO_MODE, seen = 0;
  tf_contact_t contact;
  u.v = slip_of(p, r, u, 0, by).h / sine; /* h = 0 there */
  CHECK(tf_contact_prepare(&contact, TF_TYRE_JUMP, p->mu, p->kappa,
                           TF_REST_HULL, TF_RULE_PERSIST, 0) == TF_OK);
  u.v -= 1e-10 / sine;
  for (int i = 0; i * dt < 2 && seen < 3; i++) {
    const tf_slip_t now = slip_of(p, r, u, dt, by);
    const u_t Q =
        response(p, r, p->k2 * (p->r0 - r) - p->c2 * u.v + p->m * r * u.w * u.w,
                 -p->c1 * u.w - 2 * p->m * r * u.v * u.w);
    const u_t end = {u.v + dt * Q.v, u.w + dt * Q.w};
    const double at = r + dt * end.v;
    const tf_slip_t free = slip_of(p, at, end, dt, by);
    const u_t x = response(p, at, dt * mu * sine,
                           dt * mu * (at * cos(p->gamma) - p->d * sine));
    const u_t y = response(p, at, 0, dt * kappa_mu);
    tf_form_t h = form_of(free.h, by[0], x, y);
    tf_form_t g = form_of(free.g, by[1], x, y);
    tf_contact_modes_t modes, futures;
    tf_force_t force = {0, 0};
    CHECK(tf_contact_modes(&contact, &h, &g, now, mode, &modes, NULL) == TF_OK);
    unsigned next = tf_contact_choose(&contact, &modes, mode, 0, 1);
    if (mode == TF_PINNED) {
      const tf_form_t end_h = h;
      h.c0 -= now.h;
      g.c0 -= now.g;
      next = tf_contact_leave(&contact, &h, &g, before, before != TF_PINNED, 0,
                              1, &futures, &force);
      h = end_h;
    }
    if (mode != TF_PINNED || !tf_mode_is_slip(next))
      CHECK(tf_contact_force(&contact, &h, &g, &modes, next, now, &force) ==
            TF_OK);
    if (next != mode && next != TF_PINNED && mode != TF_NO_MODE) {
      CHECK(next == want[seen].after);
      CHECK_NEAR(i * dt, (double)want[seen].t,
                 3 * dt + (IS_DOUBLE ? 1e-6 : 5e-3));
      seen++;
    }
    before = mode;
    mode = next;
    u.v = end.v + x.v * force.F / mu + y.v * force.M / kappa_mu;
    u.w = end.w + x.w * force.F / mu + y.w * force.M / kappa_mu;
    r += dt * u.v;
  }
  CHECK(seen == 3);
}

TEST(a_contact_alone_follows_the_reference) {
  static const double dts[] = {1e-3, 3.7e-4, 1e-4, 2.3e-5};
  for (int i = 0; i < (IS_DOUBLE ? 4 : 3); i++) follow(dts[i]);
}
