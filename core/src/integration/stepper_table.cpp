#include "plumbline/core/integration/stepper_table.hpp"

#include <stdexcept>
#include <string>

#include "plumbline/core/integration/adaptive_stepper.hpp"
#include "plumbline/core/integration/explicit_euler.hpp"
#include "plumbline/core/integration/position_verlet.hpp"
#include "plumbline/core/integration/runge_kutta_4.hpp"
#include "plumbline/core/integration/semi_implicit_euler.hpp"
#include "plumbline/core/integration/velocity_verlet.hpp"

namespace plumbline {
namespace {

template <class T>
std::unique_ptr<Stepper> make() {
  return std::make_unique<T>();
}

constexpr StepperKind kKinds[] = {
    {"explicit Euler", 1, make<ExplicitEuler>},   {"semi-implicit Euler", 1, make<SemiImplicitEuler>},
    {"position Verlet", 2, make<PositionVerlet>}, {"velocity Verlet", 2, make<VelocityVerlet>},
    {"Runge-Kutta 4", 4, make<RungeKutta4>},      {"Dormand-Prince 8(5,3)", 8, make<AdaptiveStepper>},
};

}  // namespace

std::span<const StepperKind> stepper_kinds() { return kKinds; }

std::unique_ptr<Stepper> make_stepper(std::string_view name) {
  std::string known;
  for (const StepperKind& kind : kKinds) {
    if (kind.name == name) return kind.make();
    known += (known.empty() ? "" : ", ") + std::string(kind.name);
  }
  throw std::invalid_argument("no integrator is called '" + std::string(name) + "'; there are: " + known);
}

}  // namespace plumbline
