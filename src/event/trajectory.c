// What the parts of the located step ask of a trajectory and do to it.
#include "trajectory.h"

TF_API rates_t tf_trajectory_rates(const trajectory_t *path) {
  return rates_at(path->motion.machine, path->motion.input, path->now.r,
                  path->now.p, path->now.z, path->omega);
}

TF_API bool tf_begin_series(trajectory_t *path) {
  taylor_t *motion = &path->motion;
  begin_taylor(motion, motion->machine, motion->input, path->omega, path->now);
  return tf_taylor_coefficients(motion, &path->segment, path->remaining);
}

TF_API span_t tf_segment_span(const trajectory_t *path) {
  const taylor_t *motion = &path->motion;
  if (motion->order < SERIES_ORDER)
    return (span_t){path->remaining, motion->allowed};
  const error_t allowed = {motion->at_once, motion->allowed - motion->at_once};
  const tf_real_t length = tf_segment_length(motion, path->remaining, allowed);
  return (span_t){
      length, allowed.at_once + allowed.by_change * (length / path->remaining)};
}

TF_API void tf_advance(trajectory_t *path, tf_real_t from, tf_real_t to) {
  const taylor_t *motion = &path->motion;
  const tf_real_t time = to - from;
  const int order = motion->order;
  phase_point_t now = {motion->r.c[order], motion->p.c[order],
                       motion->z.c[order]};
  for (int n = order - 1; n >= 0; n--) {
    now.r = now.r * to + motion->r.c[n];
    now.p = now.p * to + motion->p.c[n];
    now.z = now.z * to + motion->z.c[n];
  }
  path->now = now;
  if (motion->machine->with_angle) {
    path->angle += tf_angle_change(motion, to);
    if (from != 0) path->angle -= tf_angle_change(motion, from);
  }
  path->omega += motion->input->alpha * time;
  path->remaining = time < path->remaining ? path->remaining - time : 0;
}

TF_API void tf_take_force(trajectory_t *path, tf_real_t time) {
  const taylor_t *motion = &path->motion;
  path->force = (tf_force_t){value_at(&motion->F, motion->order, time),
                             value_at(&motion->M, motion->order, time)};
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
