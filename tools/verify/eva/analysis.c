// Analysis of any machine and point.
#include "any.h"
#include "twofold/design.h"
#include "twofold/singularity.h"
#include "twofold/surface.h"

void surface_any(void);
void surface_any(void) {
  const tf_machine_t machine = any_machine();
  const tf_input_t input = any_input();
  tf_surface_t surface;
  tf_surface_at(&machine, &input, any_real(), any_real(), any_real(), &surface);
  //@ check reached: \false;
}

void two_folds_any(void);
void two_folds_any(void) {
  const tf_machine_t machine = any_machine();
  const tf_input_t input = any_input();
  tf_surface_point_t places[TF_TWO_FOLDS], place;
  tf_two_fold_t form;
  tf_design_t design;
  tf_absence_t absence;
  int count;
  tf_two_folds(&machine, &input, places, &count, &absence);
  ANY_BITS(place);
  tf_normal_form(&machine, &input, &place, &form);
  tf_design_two_fold(&machine, &input, any_real(), any_real(), &design);
  //@ check reached: \false;
}
