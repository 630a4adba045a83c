#include "plumbline/core/integration/integrated_reference.hpp"

#include "gauss_collocation.hpp"

namespace plumbline {

struct IntegratedReference::Integration {
  explicit Integration(const Scenario& scenario) : motion(scenario), states(scenario.bodies.size()) {
    extended::Column start_x, start_u;
    motion.start(start_x, start_u);
    motion.read(start_x, start_u, states);
    method = std::make_unique<extended::GaussCollocation>(motion, std::move(start_x), std::move(start_u),
                                                          static_cast<extended::Real>(scenario.duration));
  }

  void go_to(double new_t) {
    method->read(static_cast<extended::Real>(new_t), x, u);
    motion.read(x, u, states);
    t = new_t;
  }

  extended::Motion motion;
  std::unique_ptr<extended::GaussCollocation> method;
  extended::Column x, u;
  double t = 0;
  std::vector<BodyState> states;  // at t
};

IntegratedReference::IntegratedReference(const Scenario& scenario, std::string citation, double uncertainty)
    : integration_(std::make_unique<Integration>(scenario)),
      citation_(std::move(citation)),
      uncertainty_(uncertainty) {}

IntegratedReference::~IntegratedReference() = default;

BodyState IntegratedReference::at(std::size_t body, double t) const {
  if (t != integration_->t) integration_->go_to(t);
  return integration_->states[body];
}

}  // namespace plumbline
