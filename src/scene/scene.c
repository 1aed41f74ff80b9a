// How a scene starts, and its inputs over time.
#include "twofold/scene.h"

#include "../num/rounding.h"

// The time of a tick, by halves: both conversions are of 32 bits, and that of
// 64 takes 2 KB on a processor without floating point. Up to 2^32 it is rounded
// as that.
static tf_real_t time_of(uint64_t tick, tf_real_t dt) {
  const tf_real_t high = (tf_real_t)(uint32_t)(tick >> 32) * TF_R(0x1p32);
  return (high + (tf_real_t)(uint32_t)tick) * dt;
}

// The speed of the turntable at a time, to which knots up to t + off belong.
static tf_real_t speed_at(const tf_scene_t *scene, tf_real_t t, tf_real_t off) {
  const tf_knot_t *knot = scene->profile;
  int i = 0;
  while (i + 1 < scene->knots && knot[i + 1].t <= t + off) i++;
  if (i + 1 == scene->knots || t <= knot[i].t) return knot[i].omega0;
  if (t >= knot[i + 1].t) return knot[i + 1].omega0;
  return knot[i].omega0 + (knot[i + 1].omega0 - knot[i].omega0) *
                              ((t - knot[i].t) / (knot[i + 1].t - knot[i].t));
}

// By how much the speed jumps between two times.
static tf_real_t jumps_between(const tf_scene_t *scene, tf_real_t from,
                               tf_real_t to) {
  const tf_knot_t *knot = scene->profile;
  tf_real_t sum = 0;
  for (int i = 0; i + 1 < scene->knots; i++)
    if (knot[i].t == knot[i + 1].t && knot[i].t > from && knot[i].t <= to)
      sum += knot[i + 1].omega0 - knot[i].omega0;
  return sum;
}

// A knot that belongs to the boundary of two steps but for the rounding of tick
// dt, and of the decimals of both, is neither within the step before nor within
// the one behind: a jump there acts between the two.
TF_API tf_input_t tf_scene_input(const tf_scene_t *scene,
                                 const tf_machine_t *machine, uint64_t tick) {
  tf_input_t input = tf_input_default(machine);
  if (scene->knots == 0) return input;
  const uint64_t first = tick == 0 ? 0 : tick - 1;
  const tf_real_t dt = machine->dt;
  const tf_real_t from = time_of(first, dt), to = time_of(first + 1, dt);
  const tf_real_t rounding = dt * TF_R(0x1p-20) + 4 * TF_REAL_EPSILON * to;
  const tf_real_t off = rounding < dt / 2 ? rounding : dt / 2;
  const tf_real_t start = speed_at(scene, from, off);
  input.omega0 = start + jumps_between(scene, from + off, to - off);
  tf_turntable_to(&input, speed_at(scene, to, -off), dt);
  if (tick == 0) input.omega0 = start;
  return input;
}

TF_API tf_status_t tf_scene_start(const tf_scene_t *scene,
                                  const tf_machine_t *machine, uint32_t seed,
                                  tf_state_t *state, tf_report_t *report) {
  const tf_input_t input = tf_scene_input(scene, machine, 0);
  tf_state_t start = {.r = scene->r,
                      .v = scene->v,
                      .w = scene->omega,
                      .seed = seed,
                      .mode = TF_NO_MODE};
  const tf_status_t status =
      scene->v_is_given
          ? tf_begin(machine, &start, &input, report)
          : tf_begin_with_slip(machine, &start, &input, scene->h, report);
  if (status == TF_OK) *state = start;
  return status;
}
