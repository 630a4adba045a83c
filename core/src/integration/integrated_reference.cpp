#include "plumbline/core/integration/integrated_reference.hpp"

#include <stdexcept>

#include "plumbline/core/integration/body_equations.hpp"
#include "plumbline/core/integration/dormand_prince.hpp"
#include "plumbline/core/kinetics/force_following.hpp"

namespace plumbline {
namespace {

constexpr double kTolerance = 1e-15;

}  // namespace

struct IntegratedReference::Integration {
  explicit Integration(const Scenario& scenario)
      : field(acceleration_field(scenario)),
        equations(field, scenario.bodies.size()),
        solver({.relative = kTolerance, .absolute = kTolerance}) {
    for (const Body& body : scenario.bodies) states.push_back(body.initial);
    start = BodyEquations::pack(states);
    solver.start(0, start);
  }

  void go_to(double t) {
    if (t < solver.time()) solver.start(0, start);
    if (t > solver.time()) solver.advance_to(equations, t);
    BodyEquations::unpack(solver.state(), states);
  }

  AccelerationField field;
  BodyEquations equations;
  DormandPrince<Eigen::VectorXd> solver;
  Eigen::VectorXd start;
  std::vector<BodyState> states;
};

IntegratedReference::IntegratedReference(const Scenario& scenario, std::string citation, double uncertainty)
    : citation_(std::move(citation)), uncertainty_(uncertainty) {
  if (scenario.contact) throw std::invalid_argument("its motion is not smooth: remove [contact]");
  for (const Joint& joint : scenario.joints) {
    if (joint.range) throw std::invalid_argument("its motion is not smooth: '" + joint.name + "' has a range");
  }
  integration_ = std::make_unique<Integration>(scenario);
}

IntegratedReference::~IntegratedReference() = default;

BodyState IntegratedReference::at(std::size_t body, double t) const {
  if (t != integration_->solver.time()) integration_->go_to(t);
  return integration_->states[body];
}

}  // namespace plumbline
