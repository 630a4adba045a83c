#include "solution_particle.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "named_solution.hpp"
#include "plumbline/core/exact/kepler_orbit.hpp"

namespace plumbline {
namespace {

// The strength GM [m^3/s^2] of the pull at some place: m GM/r^2 towards the origin, whatever the time and the velocity,
// probed in the plane of the orbit: a law may leave out y where nothing moves along it.
// Anything else is refused, so that the file's force law and the solution cannot be two different problems.
double strength(const Scenario& scenario, std::size_t body, const ForceLaw& law) {
  const BodyState& start = scenario.bodies[body].initial;
  const double m = scenario.bodies[body].mass;
  const Vec3 normal = start.p_WB.cross(start.v_WB).normalized();
  const Vec3 ahead = start.p_WB + normal.cross(start.p_WB);  // elsewhere in the orbit's plane
  double found = 0;
  for (const double scale : {1.0, 0.5, 3.0}) {
    BodyState probe = start;
    probe.p_WB = scale * ahead;
    probe.v_WB = -scale * start.v_WB;
    const Wrench pull = law.evaluate((scale - 1) * scenario.duration, probe);
    const double r = probe.p_WB.norm(), here = -pull.f_W.dot(probe.p_WB) * r / m;
    if (found == 0) found = here;
    const Vec3 expected = -m * found / (r * r * r) * probe.p_WB;
    if (!(found > 0) || !((pull.f_W - expected).norm() <= 1e-12 * expected.norm()) || !pull.tau_W.isZero(0)) {
      refuse("the force law must be -m*GM/r^2 towards the origin, with one GM > 0 everywhere and no torque");
    }
  }
  return found;
}

class KeplerMotion final : public NamedSolution {
 public:
  KeplerMotion(const Scenario& scenario, std::string citation) : NamedSolution(std::move(citation)) {
    if (!scenario.gravity.isZero(0) || scenario.contact || !scenario.joints.empty() || !scenario.springs.empty()) {
      refuse("nothing but the force laws may act: no gravity, joint, spring or contact");
    }
    if (scenario.forces.size() != scenario.bodies.size()) refuse("every body needs one force law");
    for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
      const auto law =
          std::find_if(scenario.forces.begin(), scenario.forces.end(), [i](const ForceLaw& f) { return f.body == i; });
      if (law == scenario.forces.end()) refuse("every body needs one force law");
      const BodyState& start = scenario.bodies[i].initial;
      if (!start.w_WB.isZero(0)) refuse("the bodies must not spin");
      const KeplerOrbit orbit(strength(scenario, i, *law), start.p_WB, start.v_WB);
      attitudes_.push_back(start.q_WB);
      // exact/kepler_orbit.hpp: a few 1e-16 of the angle passed, stretched by 1/(1 - e) near the centre.
      const double turned = 1 + scenario.duration * orbit.mean_motion();
      uncertainty_ = std::max(uncertainty_, 8e-16 * turned * orbit.semi_major_axis() /
                                                (scenario.scales.length * std::pow(1 - orbit.eccentricity(), 2)));
      orbits_.push_back(orbit);
    }
  }
  BodyState at(std::size_t body, double t) const override {
    const OrbitState now = orbits_[body].at(t);
    BodyState state;
    state.p_WB = now.position;
    state.v_WB = now.velocity;
    state.q_WB = attitudes_[body];
    return state;
  }
  double uncertainty() const override { return uncertainty_; }

 private:
  std::vector<KeplerOrbit> orbits_;
  std::vector<Quat> attitudes_;
  double uncertainty_ = 0;
};

}  // namespace

std::shared_ptr<const Reference> solve_kepler_orbit(const Scenario& scenario, std::string citation) {
  return solved_by<KeplerMotion>(scenario, std::move(citation));
}

}  // namespace plumbline
