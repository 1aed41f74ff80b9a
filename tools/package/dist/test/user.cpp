// A program in C++ that uses the library: it steps, looks for a two-fold and
// prints where the slider ends.
#include <array>
#include <cstdio>
#include <stdexcept>

#include "twofold.h"

namespace {

class Simulation {
 public:
  explicit Simulation(const tf_scene_t &scene) : scene_(scene) {
    if (tf_simulation_open(&simulation_, &scene_, &scene_.params, 1) != TF_OK)
      throw std::runtime_error("refused");
  }

  void step() {
    const tf_input_t input = tf_simulation_input(&simulation_, &scene_);
    if (tf_step(&simulation_.machine, &simulation_.state, &input, &simulation_.report) <
        0)
      throw std::runtime_error(tf_status_name(simulation_.report.status));
  }

  int two_folds() const {
    std::array<tf_surface_point_t, TF_TWO_FOLDS> points;
    const tf_input_t input = tf_input_default(&simulation_.machine);
    int count = 0;
    tf_two_folds(&simulation_.machine, &input, points.data(), &count, nullptr);
    return count;
  }

  const tf_state_t &state() const { return simulation_.state; }

 private:
  const tf_scene_t &scene_;
  tf_simulation_t simulation_ = tf_simulation_t();
};

} // namespace

int main() {
  Simulation simulation(*tf_scenes[0]);
  for (int i = 0; i < 100000; i++) simulation.step();
  std::printf("%s r = %a m\n", tf_scenes[0]->name,
              static_cast<double>(simulation.state().r));
  return simulation.two_folds() == 2 ? 0 : 1;
}
