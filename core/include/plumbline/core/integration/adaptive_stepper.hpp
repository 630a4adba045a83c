// The high-order solver behind the interface of the other integrators: as many steps inside dt as the tolerance asks
// for.
//
// Its order is that of Dormand-Prince, 8, as dt bounds the steps; as long as a single step inside dt is good enough the
// error falls like dt^8, and below the tolerance it stays where it is. Use integrate_reference() for whole
// trajectories: it carries what the sums lose from one output time to the next, which this one cannot. Cost: 13
// evaluations or more per dt. Range and errors as in dormand_prince.hpp; a state that is not finite is refused.
#pragma once

#include <Eigen/Core>

#include "plumbline/core/integration/dormand_prince.hpp"
#include "plumbline/core/integration/stepper.hpp"

namespace plumbline {

class AdaptiveStepper final : public Stepper {
 public:
  // Error that a step inside dt may add, as in integrate_reference().
  explicit AdaptiveStepper(double tolerance = 1e-12) : solver_({tolerance, tolerance}) {}
  std::string_view name() const override { return "Dormand-Prince 8(5,3)"; }
  int order() const override { return 8; }
  void step(const AccelerationField& field, double t, double dt, std::span<BodyState> states) override;

 private:
  DormandPrince<Eigen::VectorXd> solver_;
};

}  // namespace plumbline
