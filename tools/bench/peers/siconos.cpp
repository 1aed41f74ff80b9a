// Siconos: Euler-Moreau time stepping (theta = 1/2, Newton's rule for the
// smooth part) with a relay solved by Lemke's algorithm. The law is written as
// a relay by
//   F = lambda (4/3 - T / (18 kappa)),  M = lambda sign(g) T / 6,
//   lambda in mu Sgn(h)
// so that x' = f(x) + B (-lambda): its relay is -y in N(lambda). B is taken at
// the middle of the step, guessed from the step before.
#include <SiconosKernel.hpp>

extern "C" {
#include "model.h"
}

namespace {

model_t machine;

void smooth(double, unsigned, double *x, double *f, unsigned, double *) {
  point_to(rates(&machine, point_of(x), 0, 0), f);
}

// By central differences: f has degree three.
void smooth_jacobian(double, unsigned, double *x, double *J, unsigned,
                     double *) {
  const double step = 1e-6;
  for (int j = 0; j < 4; j++) {
    double up[4] = {x[0], x[1], x[2], x[3]};
    double down[4] = {x[0], x[1], x[2], x[3]};
    double f_up[4], f_down[4];
    up[j] += step;
    down[j] -= step;
    smooth(0, 4, up, f_up, 0, nullptr);
    smooth(0, 4, down, f_down, 0, nullptr);
    for (int i = 0; i < 4; i++)
      J[4 * j + i] = (f_up[i] - f_down[i]) / (2 * step);
  }
}

// The column of the relay.
// cppcheck-suppress constParameter  ; its operator() writes
void relay_column(point_t y, SimpleMatrix &B) {
  const double g = rolling(&machine, y);
  const double T = tan(machine.a * atan2(fabs(g), fabs(y.h)));
  const point_t with =
      rates(&machine, y, 4. / 3 - T / (18 * machine.kappa), copysign(T / 6, g));
  const point_t without = rates(&machine, y, 0, 0);
  B(0, 0) = 0;
  B(1, 0) = without.h - with.h;
  B(2, 0) = without.z - with.z;
  B(3, 0) = 0;
}

// Half a step ahead of y by what the last step did, unless that would turn the
// sign of h or g: then y itself.
point_t middle(point_t y, point_t before) {
  const point_t ahead = {1.5 * y.r - 0.5 * before.r, 1.5 * y.h - 0.5 * before.h,
                         1.5 * y.z - 0.5 * before.z,
                         1.5 * y.t - 0.5 * before.t};
  const double g = rolling(&machine, y);
  const bool stuck = fabs(y.h) < 1e-9;
  if (g * rolling(&machine, ahead) <= 0 || g * rolling(&machine, before) <= 0)
    return y;
  return stuck || (y.h * ahead.h > 0 && y.h * before.h > 0) ? ahead : y;
}

void moreau(const problem_t *problem, double dt, answer_t *answer) {
  machine = model_of(problem);
  const long steps = harness_steps(problem, dt);
  const double step = problem->length / (double)steps;
  const double mu = machine.mu;
  const point_t start = model_start(&machine, problem);
  auto x0 = std::make_shared<SiconosVector>(4);
  point_to(start, x0->getArray());
  auto ds = std::make_shared<FirstOrderNonLinearDS>(x0);
  ds->setComputeFFunction(smooth);
  ds->setComputeJacobianfxFunction(smooth_jacobian);
  auto C = std::make_shared<SimpleMatrix>(1, 4);
  auto B = std::make_shared<SimpleMatrix>(4, 1);
  C->zero();
  (*C)(0, 1) = 1;
  relay_column(start, *B);
  auto relation = std::make_shared<FirstOrderLinearR>(C, B);
  auto law = std::make_shared<RelayNSL>(1, -mu, mu);
  auto contact = std::make_shared<Interaction>(law, relation);
  // A little longer, so that rounding does not take the last step away.
  auto system = std::make_shared<NonSmoothDynamicalSystem>(
      0, problem->length + 10 * step);
  system->insertDynamicalSystem(ds);
  system->link(contact, ds);
  auto clock = std::make_shared<TimeDiscretisation>(0, step);
  auto scheme = std::make_shared<EulerMoreauOSI>(0.5);
  auto solver = std::make_shared<Relay>(SICONOS_RELAY_LEMKE);
  auto simulation =
      std::make_shared<TimeStepping>(system, clock, scheme, solver);
  simulation->setNewtonTolerance(1e-10);
  simulation->setNewtonMaxIteration(20);
  simulation->initialize();
  simulation->setComputeResiduY(false);
  simulation->setComputeResiduR(false);
  point_t before = start;
  for (long i = 0; i < steps; i++) {
    const point_t y = point_of(ds->x()->getArray());
    relay_column(middle(y, before), *B);
    before = y;
    simulation->computeOneStep();
    simulation->nextStep();
  }
  model_end(&machine, point_of(ds->x()->getArray()), answer->x);
}

// What the library throws ends the run, not the sweep. The number is dt.
void solve(const problem_t *problem, const char *, const double number[NUMBERS],
           answer_t *answer) {
  try {
    moreau(problem, number[0], answer);
  } catch (...) {
    answer->lost = 1;
  }
}

} // namespace

int main(int argc, char **argv) { return harness_main(argc, argv, solve); }
