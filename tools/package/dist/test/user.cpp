// A program in C++ that uses the library: it steps, looks for two-folds and
// prints where the slider ends.
#include <array>
#include <cstdio>

#include "twofold.h"

int main() {
  const tf_scene_t &scene = *tf_scenes[0];
  tf_simulation_t simulation = tf_simulation_t();
  tf_machine_t &machine = simulation.machine;
  if (tf_simulation_open(&simulation, &scene, &scene.params, 1) != TF_OK)
    return 1;
  for (int i = 0; i < 100000; i++) {
    const tf_input_t input = tf_simulation_input(&simulation, &scene);
    if (tf_step(&machine, &simulation.state, &input, &simulation.report) < 0)
      return 2;
  }
  std::array<tf_surface_point_t, TF_TWO_FOLDS> points;
  const tf_input_t input = tf_input_default(&machine);
  int count = 0;
  tf_two_folds(&machine, &input, points.data(), &count, nullptr);
  std::printf("%s r = %a m\n", scene.name,
              static_cast<double>(simulation.state.r));
  return count == 2 ? 0 : 3;
}
