// tyre - force and moment of the tyre over the slip angle, for the paper's
// figure 8: angle [degrees], F / mu and M / mu of the stretched string with the
// parameters of the left panel, and with those of the right panel, then F / mu
// and M / (mu kappa) of the law with a jump that takes its place.
#include <math.h>
#include <stdio.h>

#include "twofold.h"

static tf_force_t at(const tf_params_t *params, double angle) {
  tf_machine_t machine;
  const tf_force_t none = {0, 0};
  if (tf_prepare(&machine, params, NULL) != TF_OK) return none;
  return tf_tyre_force(&machine.tyre, 1, sin(angle), cos(angle));
}

int main(void) {
  enum { ROWS = 300 };
  const tf_params_t *chaos = &tf_scenes[0]->params;
  tf_params_t left = *chaos, right = *chaos;
  left.law = right.law = TF_TYRE_STRING;
  left.k = left.delta = left.sigma = left.a = 1;
  left.rho = right.rho = 2.0 / 3.0;
  right.k = 1e3;
  right.delta = right.sigma = 1e-3;
  right.a = 1;
  printf("# angle F_left M_left F_right M_right F_jump M_jump\n");
  for (int i = 1; i < ROWS; i++) {
    const double angle = 90.0 * i / ROWS, radians = angle * acos(-1.0) / 180;
    const tf_force_t a = at(&left, radians), b = at(&right, radians);
    const tf_force_t c = at(chaos, radians);
    printf("%.3f %.8g %.8g %.8g %.8g %.8g %.8g\n", angle, a.F, a.M, b.F, b.M,
           c.F, c.M / chaos->kappa);
  }
  return 0;
}
