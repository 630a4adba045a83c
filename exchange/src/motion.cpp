#include "plumbline/exchange/motion.hpp"

#include <stdexcept>

namespace plumbline {

Motion exact_motion(const Scenario& scenario, const Reference& reference, double dt) {
  if (scenario.threshold) {
    throw std::invalid_argument(scenario.case_name() + " asks a question (threshold): it has no motion to hand out");
  }
  if (!scenario.pointwise) {
    throw std::invalid_argument(scenario.case_name() + ": only invariants are known of this motion, no positions");
  }
  if (!scenario.known_at.empty()) {
    throw std::invalid_argument(scenario.case_name() + ": this motion is known at " +
                                std::to_string(scenario.known_at.size()) +
                                " published times only, which its file lists");
  }
  if (!(dt > 0)) throw std::invalid_argument("dt must be > 0");
  Motion motion;
  motion.title = scenario.case_name() + ", exact, " + std::string(reference.kind());
  motion.source = reference.citation();
  for (const Body& body : scenario.bodies) motion.names.push_back(body.name);
  const Trajectory samples = sample(reference, scenario.bodies.size(), dt, scenario.step_count(dt) + 1);
  for (std::size_t k = 0; k < samples.samples(); ++k) motion.times.push_back(samples.time(k));
  motion.states.assign(samples.states().begin(), samples.states().end());
  return motion;
}

}  // namespace plumbline
