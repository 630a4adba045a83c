#include "plumbline/core/integration/reference_integration.hpp"

#include <cmath>
#include <stdexcept>

#include "plumbline/core/integration/body_equations.hpp"
#include "plumbline/core/integration/dormand_prince.hpp"
#include "plumbline/core/metric.hpp"

namespace plumbline {
namespace {

void require_times(double t0, std::span<const double> times) {
  double before = t0;
  for (const double t : times) {
    if (!std::isfinite(t) || !(t >= before)) {
      throw std::invalid_argument(
          "integrate_reference: times must be finite, rise and start at t0 or later; sort them");
    }
    before = t;
  }
}

std::vector<BodyState> run(const AccelerationField& field, double t0, std::span<const BodyState> initial,
                           std::span<const double> times, double tolerance, Effort& effort) {
  const BodyEquations equations(field, initial.size());
  DormandPrince<Eigen::VectorXd> solver({tolerance, tolerance});
  solver.start(t0, BodyEquations::pack(initial));
  std::vector<BodyState> states(times.size() * initial.size());
  for (std::size_t k = 0; k < times.size(); ++k) {
    solver.advance_to(equations, times[k]);
    BodyEquations::unpack(solver.state(), std::span(states).subspan(k * initial.size(), initial.size()));
  }
  effort = solver.effort();
  return states;
}

}  // namespace

ReferenceRun integrate_reference(const AccelerationField& field, double t0, std::span<const BodyState> initial,
                                 std::span<const double> times, double tolerance) {
  require_times(t0, times);
  if (initial.empty()) throw std::invalid_argument("integrate_reference: there are no bodies to integrate");
  if (!(tolerance >= 1e-17 && tolerance <= 1e-3)) {
    throw std::invalid_argument("integrate_reference: the tolerance must lie in [1e-17, 1e-3]");
  }
  ReferenceRun result;
  result.states = run(field, t0, initial, times, tolerance, result.effort);
  Effort coarse_effort;
  const std::vector<BodyState> coarse = run(field, t0, initial, times, 10 * tolerance, coarse_effort);
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    const BodyState &a = result.states[i], &b = coarse[i];
    result.position_uncertainty = max_or_nan(result.position_uncertainty, (a.p_WB - b.p_WB).norm());
    result.attitude_uncertainty = max_or_nan(result.attitude_uncertainty, geodesic_angle(a.q_WB, b.q_WB));
  }
  return result;
}

}  // namespace plumbline
