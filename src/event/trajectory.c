// What the parts of the located step ask of a trajectory and do to it.
#include "trajectory.h"

TF_API rates_t tf_trajectory_rates(const trajectory_t *path) {
  return rates_at(path->motion.machine, path->motion.input, path->now.r,
                  path->now.p, path->now.z, path->omega);
}

TF_API bool tf_expand(trajectory_t *path) {
  taylor_t *motion = &path->motion;
  begin_taylor(motion, motion->machine, motion->input, path->omega, path->now);
  return tf_taylor_coefficients(motion, &path->segment);
}

TF_API void tf_advance(trajectory_t *path, tf_real_t from, tf_real_t to) {
  const taylor_t *motion = &path->motion;
  const tf_real_t time = to - from;
  path->now =
      (phase_point_t){value_at(&motion->r, to), value_at(&motion->p, to),
                      value_at(&motion->z, to)};
  path->force =
      (tf_force_t){value_at(&motion->F, to), value_at(&motion->M, to)};
  if (motion->machine->with_angle)
    path->angle += tf_angle_change(motion, to) - tf_angle_change(motion, from);
  path->omega += motion->input->alpha * time;
  path->remaining = time < path->remaining ? path->remaining - time : 0;
}

TF_API void tf_project(trajectory_t *path) {
  const tf_machine_t *k = path->motion.machine;
  const tf_real_t arm = path->now.r * k->cos_gamma;
  const tf_real_t J_over_m = gyration2_at(k, path->now.r);
  const tf_real_t mA = mass_times_delassus_of_force(k, arm, J_over_m);
  if (mA == 0) return;
  const tf_real_t impulse_over_m = trajectory_slip(path).h / mA;
  path->now.p += impulse_over_m * k->sin_gamma;
  path->now.z += impulse_over_m * arm / J_over_m;
}
