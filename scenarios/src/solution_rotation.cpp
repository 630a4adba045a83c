#include "solution_rotation.hpp"

#include <cmath>
#include <optional>

#include "named_solution.hpp"
#include "plumbline/core/exact/lagrange_top.hpp"

namespace plumbline {
namespace {

class HeavyTop final : public NamedSolution {
 public:
  HeavyTop(const Scenario& scenario, std::string citation) : NamedSolution(std::move(citation)) {
    if (scenario.bodies.size() != 1 || scenario.joints.size() != 1 || !scenario.forces.empty() || scenario.contact ||
        !scenario.springs.empty()) {
      refuse("it is for one body on one ball joint, without force laws, springs and contact");
    }
    const Body& body = scenario.bodies.front();
    const Joint& joint = scenario.joints.front();
    if (joint.kind != JointKind::kBall || joint.a != kWorld || joint.range) {
      refuse("its joint must be a ball joint to the world, without a range");
    }
    const Vec3& g = scenario.gravity;
    if (!(g.x() == 0 && g.y() == 0 && g.z() < 0)) refuse("gravity must point along -z");
    TopBody top;
    top.mass = body.mass;
    top.gravity = -g.z();
    top.arm_B = -joint.on_b.anchor;
    Eigen::Index axis = 0;
    const double arm = top.arm_B.cwiseAbs().maxCoeff(&axis);
    const Vec3 across = top.arm_B - top.arm_B(axis) * Vec3::Unit(axis);
    const double one = body.inertia((axis + 1) % 3), other = body.inertia((axis + 2) % 3);
    if (!(arm > 0) || across.norm() > 1e-12 * arm || std::abs(one - other) > 1e-12 * one) {
      refuse("the centre of mass must lie on a body axis about which the body is symmetric");
    }
    top.arm_B = top.arm_B(axis) * Vec3::Unit(axis);  // without the rounding of the file's attitude
    top.inertia_axial = body.inertia(axis);
    top.inertia_transverse = one;
    motion_.emplace(top, body.initial);
    // exact/lagrange_top.hpp: a few 1e-16 times the angle turned, magnified near the motion that never returns.
    const double turned = 1 + body.initial.w_WB.norm() * scenario.duration;
    uncertainty_ = 8e-16 * turned / (1 - motion_->parameter()) * (1 + arm / scenario.scales.length);
  }
  BodyState at(std::size_t, double t) const override { return motion_->at(t); }
  double uncertainty() const override { return uncertainty_; }

 private:
  std::optional<LagrangeTop> motion_;
  double uncertainty_ = 0;
};

}  // namespace

std::shared_ptr<const Reference> solve_heavy_top(const Scenario& scenario, std::string citation) {
  return solved_by<HeavyTop>(scenario, std::move(citation));
}

}  // namespace plumbline
