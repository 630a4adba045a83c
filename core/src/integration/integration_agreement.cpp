#include "plumbline/core/integration/integration_agreement.hpp"

#include <algorithm>
#include <cmath>

#include "fehlberg_method.hpp"
#include "gauss_collocation.hpp"
#include "plumbline/core/integration/body_equations.hpp"
#include "plumbline/core/integration/dormand_prince.hpp"
#include "plumbline/core/kinetics/force_following.hpp"
#include "plumbline/core/metric.hpp"

namespace plumbline {
namespace {

using extended::Column;
using extended::Real;

constexpr int kTimes = 100;
constexpr double kCoreTolerance = 1e-15;  // what double precision stands in fields of any kind

}  // namespace

Agreement integration_agreement(const Scenario& scenario) {
  extended::Motion motion(scenario);
  Column x, u;
  motion.start(x, u);
  const double end = std::min(scenario.t_valid, scenario.duration);
  extended::GaussCollocation reference(motion, x, u, static_cast<Real>(scenario.duration));
  extended::FehlbergMethod second(motion, x, u);

  const AccelerationField field = acceleration_field(scenario);
  const BodyEquations equations(field, scenario.bodies.size());
  DormandPrince<Eigen::VectorXd> third({.relative = kCoreTolerance, .absolute = kCoreTolerance});
  std::vector<BodyState> states;
  for (const Body& body : scenario.bodies) states.push_back(body.initial);
  third.start(0, BodyEquations::pack(states));

  Agreement result;
  std::vector<BodyState> expected(states.size());
  for (int k = 1; k <= kTimes; ++k) {
    const double t = end * k / kTimes;
    reference.read(static_cast<Real>(t), x, u);
    second.advance_to(static_cast<Real>(t));
    result.second_method = max_or_nan(result.second_method, static_cast<double>(motion.distance(x, second.x())));
    third.advance_to(equations, t);
    BodyEquations::unpack(third.state(), states);
    motion.read(x, u, expected);
    for (std::size_t b = 0; b < states.size(); ++b) {
      const double places = (states[b].p_WB - expected[b].p_WB).norm() / scenario.scales.length;
      result.core_field = max_or_nan(result.core_field, places);
      result.core_field = max_or_nan(result.core_field, geodesic_angle(states[b].q_WB, expected[b].q_WB));
    }
  }
  return result;
}

}  // namespace plumbline
