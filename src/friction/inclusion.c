// What is asked of an inclusion off the common path of a step, as functions:
// small rather than fast.
#include "inclusion.h"

TF_API void tf_enumerate(const inclusion_t *in, unsigned signs,
                         tf_contact_modes_t *out) {
  if (signs == BOTH_SIGNS) {
    enumerate(in, BOTH_SIGNS, out);
    return;
  }
  const sign_t s = signs == MINUS_SIGN ? MINUS : PLUS;
  out->near_stick = (uint8_t)stick_with(s);
  enumerate_one_sign(in, s, out);
}

// One step of Newton's method on (8).
static void step_to(const tf_form_t *h, const tf_form_t *g, tf_slip_t to,
                    multipliers_t *m) {
  const tf_real_t x = m->x, y = m->y;
  const tf_real_t hx = h->cx + 2 * h->cxx * x + h->cxy * y;
  const tf_real_t hy = h->cy + h->cxy * x + 2 * h->cyy * y;
  const tf_real_t gx = g->cx + 2 * g->cxx * x + g->cxy * y;
  const tf_real_t gy = g->cy + g->cxy * x + 2 * g->cyy * y;
  const tf_real_t missed_h = form_value(h, x, y) - to.h;
  const tf_real_t missed_g = form_value(g, x, y) - to.g;
  const tf_real_t det = hx * gy - hy * gx;
  m->x = x + (hy * missed_g - gy * missed_h) / det;
  m->y = y + (gx * missed_h - hx * missed_g) / det;
}

TF_API multipliers_t tf_multipliers_to(const tf_form_t *h, const tf_form_t *g,
                                       tf_slip_t to, multipliers_t guess) {
  multipliers_t m = guess;
  step_to(h, g, to, &m);
  step_to(h, g, to, &m);
  return m;
}
