#include "solution_collision.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>

#include "plumbline/core/exact/rocking_block.hpp"

namespace plumbline {
namespace {

constexpr double kTight = 1e-9;  // typing errors are larger, rounding is smaller

void require(bool holds, const char* otherwise) {
  if (!holds) throw std::invalid_argument(otherwise);
}

class RockingBox final : public Reference {
 public:
  RockingBox(const Scenario& scenario, std::string citation) : citation_(std::move(citation)) {
    require(scenario.bodies.size() == 2 && scenario.joints.empty() && scenario.forces.empty() &&
                scenario.springs.empty() && scenario.contact && scenario.contact->restitution == 0,
            "it is for one box on one half-space, under gravity alone, with restitution = 0");
    for (std::size_t i = 0; i < 2; ++i) {
      bodies_[i] = scenario.bodies[i].initial;
      if (std::holds_alternative<Box>(scenario.bodies[i].shape) && !scenario.bodies[i].fixed) box_ = i;
    }
    require(box_.has_value(), "one of the bodies must be a box that moves");
    const Body &box = scenario.bodies[*box_], &floor = scenario.bodies[1 - *box_];
    const auto* ground = std::get_if<HalfSpace>(&floor.shape);
    const double g = scenario.gravity.norm();
    require(ground != nullptr && ground->normal == Vec3::UnitZ() && scenario.gravity == Vec3(0, 0, -g),
            "the other body must be a half-space that faces up, and gravity must point down");
    const Vec3 size = std::get<Box>(box.shape).size;
    half_ = {size.x() / 2, 0, size.z() / 2};
    const Quat& q = box.initial.q_WB;
    const double tilt = 2 * std::atan2(q.y(), q.w());
    require(std::hypot(q.x(), q.z()) < kTight && box.initial.v_WB.isZero(0) && box.initial.w_WB.isZero(0),
            "the box must start at rest, turned about y alone");
    side_ = tilt < 0 ? -1 : 1;
    edge_ = box.initial.p_WB - arm(tilt, side_);
    require(std::abs(edge_.z() - floor.initial.p_WB.z()) < kTight * scenario.scales.length,
            "the lower edge of the box must lie on the ground at the start");

    const double m = box.mass, radius = half_.norm(), inertia = box.inertia.y() + m * radius * radius;
    const double ratio = (box.inertia.y() + m * (half_.z() * half_.z() - half_.x() * half_.x())) / inertia;
    require(ratio > 0, "so flat a box does not rock: at the impact it stays, or turns back");
    const double p = std::sqrt(m * g * radius / inertia), alpha = std::atan2(half_.x(), half_.z());
    motion_.emplace(p, alpha, ratio, tilt, scenario.duration);
    require_friction(scenario, ratio, p, alpha);
    // exact/planar_pendulum.hpp: magnified by 1/(1 - k^2), here 1/sin^2 of half the angle to the vertical above the
    // edge, and once more by every impact.
    const double magnified = 1 / std::pow(std::sin((alpha - std::abs(tilt)) / 2), 2);
    uncertainty_ = 8e-16 * (1 + p * scenario.duration) * magnified *
                   static_cast<double>(1 + motion_->impacts().size()) * (1 + radius / scenario.scales.length);
  }

  BodyState at(std::size_t body, double t) const override {
    BodyState state = bodies_[body];
    if (body != *box_) return state;
    const RockingState now = motion_->at(t);
    // It turns about the edge to which it leans; at every impact that is the other one.
    const double side = now.impacts % 2 == 0 ? side_ : -side_;
    const Vec3 from_edge = arm(now.tilt, side);
    state.p_WB = edge_ + Vec3((side - side_) * half_.x(), 0, 0) + from_edge;
    state.q_WB = rotation_by(Vec3(0, now.tilt, 0));
    state.w_WB = {0, now.rate, 0};
    state.v_WB = state.w_WB.cross(from_edge);
    return state;
  }
  double uncertainty() const override { return uncertainty_; }
  std::string_view citation() const override { return citation_; }
  std::string_view kind() const override { return "solution"; }
  std::string_view bound_source() const override {
    return "rounding of the solution's own steps, magnified as the motion magnifies it";
  }

 private:
  // From the edge on that side to the centre.
  Vec3 arm(double tilt, double side) const {
    return rotation_by(Vec3(0, tilt, 0)) * Vec3(-side * half_.x(), 0, half_.z());
  }

  // What keeps the edge from slipping: of every impact (1 - ratio)/(1 + ratio) times height over width, and in between
  // the share of the force on the edge, m (a - g), that is not normal to the ground.
  void require_friction(const Scenario& scenario, double ratio, double p, double alpha) const {
    const double mu = scenario.contact->friction;
    double needed = half_.z() / half_.x() * (1 - ratio) / (1 + ratio);
    for (int k = 0; k <= 1000; ++k) {
      const RockingState now = motion_->at(scenario.duration * k / 1000);
      const double side = now.impacts % 2 == 0 ? side_ : -side_;
      const Vec3 from_edge = arm(now.tilt, side);
      const double angular = -side * p * p * std::sin(alpha - side * now.tilt);
      const Vec3 a = Vec3(0, angular, 0).cross(from_edge) - now.rate * now.rate * from_edge;
      const Vec3 force = a - scenario.gravity;
      require(force.z() > 0, "the box leaves the ground; tilt it less");
      needed = std::max(needed, std::abs(force.x()) / force.z());
    }
    require(needed <= mu, "the friction is too small for the box to rock without slipping");
  }

  std::string citation_;
  BodyState bodies_[2];
  std::optional<std::size_t> box_;
  Vec3 half_ = Vec3::Zero(), edge_ = Vec3::Zero();
  double side_ = 1, uncertainty_ = 0;
  std::optional<RockingBlock> motion_;
};

}  // namespace

std::shared_ptr<const Reference> solve_rocking_block(const Scenario& scenario, std::string citation) {
  return std::make_shared<RockingBox>(scenario, std::move(citation));
}

}  // namespace plumbline
