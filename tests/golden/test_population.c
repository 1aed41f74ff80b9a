/* Hashes over machines and states of all kinds, one for each thing that the
 * core computes, the same for every compiler, optimisation level and target of
 * a real type. A hash changes only in a commit that says which arithmetic
 * changed and why. */
#include "firmware_start.h"
#include "population.h"
#include "same_state.h"
#include "tap.h"
#include "twofold.h"

static const struct {
  const char *name;
  uint64_t f64, f32;
} golden[] = {
#include "population.inc"
};

static void check_golden(const char *name, uint64_t got) {
  uint64_t want = 0;
  for (size_t i = 0; i < sizeof golden / sizeof *golden; i++)
    if (!strcmp(golden[i].name, name))
      want = sizeof(tf_real_t) == 8 ? golden[i].f64 : golden[i].f32;
  if (!CHECK(got == want)) printf("#   %s: 0x%016" PRIX64 "\n", name, got);
}

static long others;

/* Firmware with SPLIT=no takes the same step, or loses a slip and is not OK. */
static tf_status_t step_beside_unsplit(const tf_machine_t *k, tf_state_t *x,
                                       const tf_input_t *u, tf_report_t *o) {
  tf_state_t whole = *x;
  const bool slips = tf_mode_is_slip(x->mode);
  const tf_status_t is = unsplit_step(k, &whole, u, o);
  const bool loses = slips && whole.mode != x->mode;
  const tf_status_t status = tf_step(k, x, u, o);
  const bool same = same_state(&whole, x);
  CHECK(same ? loses || is == status : slips && is > TF_OK);
  others += !same;
  return status;
}

TEST(golden_steps) {
  check_golden("step", hash_of_steps(step_beside_unsplit, 40000, 12));
  CHECK_ABOVE(others, 100);
  check_golden("step on a board", hash_of_steps(tf_step, 300, 6));
}

TEST(golden_located_steps) {
  check_golden("locate", hash_of_steps(tf_step_located, 12000, 6));
  check_golden("locate on a board", hash_of_steps(tf_step_located, 100, 2));
}

TEST(golden_compensated_steps) {
  draw_t d = population(2);
  for (unsigned n = 0; n < 16000; n++) {
    const tf_params_t p = any_params(&d, n);
    tf_compensated_t k;
    memset(&k, 0, sizeof k);
    if (tf_prepare_compensated(&k, &p, NULL) != TF_OK) continue;
    mix_real(&d, k.low_sin_gamma);
    mix_real(&d, k.low_cos_gamma);
    mix_real(&d, k.low_inertia);
    tf_input_t u = any_input(&d, &k.machine);
    tf_state_t x = any_state(&d, &k.machine, &u);
    tf_report_t report;
    tf_compensation_t compensation = {0, 0, 0, 0};
    const tf_status_t begun = tf_begin(&k.machine, &x, &u, &report);
    if (n % 2) {
      const tf_real_t h = between(&d, -1, 1);
      const tf_status_t placed =
          tf_speed_for_slip_compensated(&k, &x, &compensation, u.omega0, h);
      mix_small(&d, (unsigned)placed);
    }
    for (int i = 0; i < 8 && begun == TF_OK; i++) {
      const tf_status_t done =
          tf_step_compensated(&k, &x, &compensation, &u, &report);
      mix_small(&d, (unsigned)done);
      if (done < 0) break;
      mix_step(&d, &x, &report);
      mix_real(&d, compensation.r);
      mix_real(&d, compensation.v);
      mix_real(&d, compensation.w);
      mix_real(&d, compensation.phi);
    }
  }
  check_golden("compensated", d.hash);
}

static void mix_rate(draw_t *d, const tf_rate_t *rate) {
  mix_real(d, rate->r);
  mix_real(d, rate->v);
  mix_real(d, rate->w);
}

static void mix_direction(draw_t *d, const tf_direction_t *direction) {
  mix_real(d, direction->value);
  mix_real(d, direction->plus);
  mix_real(d, direction->minus);
  mix_rate(d, &direction->velocity);
  mix_real(d, direction->lambda);
  mix_small(d, direction->sticks);
}

static void mix_two_fold(draw_t *d, const tf_two_fold_t *at) {
  const tf_real_t reals[] = {at->point.r, at->point.v,  at->point.w,
                             at->point.g, at->residual, at->time_scale,
                             at->Kpp,     at->Kpm,      at->Kmp,
                             at->Kmm,     at->J1,       at->J2};
  for (size_t i = 0; i < sizeof reals / sizeof *reals; i++)
    mix_real(d, reals[i]);
  mix_direction(d, &at->through);
  mix_direction(d, &at->across);
  mix_rate(d, &at->plus);
  mix_rate(d, &at->minus);
  mix_small(d, at->type);
  mix_small(d, at->paper_case);
}

TEST(golden_two_folds) {
  draw_t d = population(6);
  for (unsigned n = 0; n < 20000; n++) {
    tf_machine_t k;
    if (any_machine(&d, n, &k) != TF_OK) continue;
    const tf_input_t u = any_input(&d, &k);
    tf_surface_point_t places[TF_TWO_FOLDS];
    int count = 0;
    tf_absence_t absence = TF_ABSENCE_NONE;
    const tf_status_t status = tf_two_folds(&k, &u, places, &count, &absence);
    mix_small(&d, (unsigned)status);
    mix_small(&d, (unsigned)count);
    mix_small(&d, (unsigned)absence);
    for (int i = 0; i < count; i++) {
      tf_two_fold_t at;
      const tf_status_t formed = tf_normal_form(&k, &u, &places[i], &at);
      mix_small(&d, (unsigned)formed);
      if (formed == TF_OK) mix_two_fold(&d, &at);
    }
  }
  check_golden("two-folds", d.hash);
}
