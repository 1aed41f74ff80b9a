// The analysis of a machine (singularity.h) at any point of any
// input: what is refused stays untouched, what is returned is finite, in its
// range and consistent with itself.
#include "verify/fuzz/fuzz.h"

static int finite_rate(const tf_rate_t *f) {
  return fuzz_finite(f->r) && fuzz_finite(f->v) && fuzz_finite(f->w);
}

static const char *judge_direction(const tf_direction_t *direction) {
  const tf_real_t plus = fuzz_magnitude(direction->plus);
  const tf_real_t minus = fuzz_magnitude(direction->minus);
  FUZZ_HOLD(fuzz_finite(direction->value) && fuzz_finite(direction->lambda));
  FUZZ_HOLD(finite_rate(&direction->velocity));
  FUZZ_HOLD((plus == 0 && minus == 0) ||
            (plus + minus > TF_R(0.999) && plus + minus < TF_R(1.001)));
  return NULL;
}

static const char *judge_two_fold(const tf_two_fold_t *at) {
  FUZZ_HOLD(at->type < TF_FOLDS && at->paper_case <= 3);
  FUZZ_HOLD(at->paper_case == 0 || at->type == TF_FOLDS_INVISIBLE);
  FUZZ_HOLD(fuzz_finite(at->residual) && at->residual >= 0);
  FUZZ_HOLD(fuzz_finite(at->time_scale) && at->time_scale > 0);
  FUZZ_HOLD(fuzz_finite(at->Kpp) && fuzz_finite(at->Kpm));
  FUZZ_HOLD(fuzz_finite(at->Kmp) && fuzz_finite(at->Kmm));
  FUZZ_HOLD(fuzz_finite(at->J1) && fuzz_finite(at->J2));
  FUZZ_HOLD(finite_rate(&at->plus) && finite_rate(&at->minus));
  FUZZ_HOLD_ALL(judge_direction(&at->through));
  return judge_direction(&at->across);
}

static const char *normal_form(const tf_machine_t *machine,
                               const tf_input_t *input,
                               const tf_surface_point_t *place) {
  tf_two_fold_t at, was;
  memset(&at, 0x5a, sizeof at);
  memcpy(&was, &at, sizeof was);
  const tf_status_t status = tf_normal_form(machine, input, place, &at);
  if (status == TF_OK) return judge_two_fold(&at);
  FUZZ_HOLD(status == TF_BAD_STATE || status == TF_BAD_PARAMETER);
  FUZZ_HOLD(memcmp(&was, &at, sizeof was) == 0);
  return NULL;
}

static const char *two_folds(const tf_machine_t *machine,
                             const tf_input_t *input) {
  tf_surface_point_t places[TF_TWO_FOLDS];
  int count = -1;
  tf_absence_t absence = TF_ABSENCE_NONE;
  const tf_status_t status =
      tf_two_folds(machine, input, places, &count, &absence);
  if (status != TF_OK) {
    FUZZ_HOLD(status == TF_BAD_STATE && count == -1);
    return NULL;
  }
  FUZZ_HOLD(count >= 0 && count <= TF_TWO_FOLDS);
  FUZZ_HOLD((count == 0) == (absence != TF_ABSENCE_NONE) &&
            (int)absence < TF_ABSENCES);
  for (int i = 0; i < count; i++) {
    const tf_surface_point_t *at = &places[i];
    const tf_state_t x = {.r = at->r, .v = at->v, .w = at->w};
    FUZZ_HOLD(fuzz_finite(at->g) && at->g != 0 && at->r != 0);
    FUZZ_HOLD(i == 0 || at->g < 0 || places[i - 1].g > 0);
    FUZZ_HOLD(fuzz_in_reach(&x));
    FUZZ_HOLD_ALL(normal_form(machine, input, at));
  }
  return NULL;
}

static const char *surface(const tf_machine_t *machine, const tf_input_t *input,
                           const tf_state_t *x) {
  tf_surface_t at, was;
  memset(&at, 0x5a, sizeof at);
  memcpy(&was, &at, sizeof was);
  const tf_status_t status =
      tf_surface_at(machine, input, x->r, x->v, x->w, &at);
  if (status != TF_OK) {
    FUZZ_HOLD(status == TF_BAD_STATE || status == TF_BAD_PARAMETER);
    FUZZ_HOLD(memcmp(&was, &at, sizeof was) == 0);
    return NULL;
  }
  FUZZ_HOLD(at.region < TF_REGIONS);
  FUZZ_HOLD(fuzz_finite(at.slip.h) && fuzz_finite(at.slip.g));
  FUZZ_HOLD(fuzz_finite(at.lie_plus) && fuzz_finite(at.lie_minus));
  FUZZ_HOLD(fuzz_finite(at.delassus) && fuzz_finite(at.lambda));
  FUZZ_HOLD(finite_rate(&at.plus) && finite_rate(&at.minus));
  FUZZ_HOLD(finite_rate(&at.stick) && finite_rate(&at.scaled));
  return NULL;
}

static const char *design(const tf_machine_t *machine, const tf_input_t *input,
                          const tf_state_t *x) {
  tf_design_t out;
  memset(&out, 0x5a, sizeof out);
  const tf_status_t status =
      tf_design_two_fold(machine, input, x->r, x->w, &out);
  FUZZ_HOLD((status == TF_OK) == (out.obstacle == TF_DESIGN_FOUND));
  FUZZ_HOLD(out.obstacle <= TF_DESIGN_K2);
  FUZZ_HOLD(fuzz_finite(out.kappa) && fuzz_finite(out.k2));
  if (out.obstacle == TF_DESIGN_FOUND || out.obstacle >= TF_DESIGN_KAPPA)
    return judge_two_fold(&out.two_fold);
  FUZZ_HOLD(out.kappa == 0 && out.k2 == 0);
  return NULL;
}

const char *fuzz_analysis(const tf_machine_t *machine, const tf_input_t *input,
                          const tf_state_t *state) {
  const tf_surface_point_t here = {state->r, state->v, state->w, state->phi};
  FUZZ_HOLD_ALL(two_folds(machine, input));
  FUZZ_HOLD_ALL(normal_form(machine, input, &here));
  FUZZ_HOLD_ALL(surface(machine, input, state));
  return design(machine, input, state);
}
