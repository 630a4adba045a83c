#include "solution_contact.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "plumbline/core/exact/curling_disc.hpp"
#include "plumbline/core/exact/falling_ladder.hpp"
#include "plumbline/core/exact/leaving_sphere.hpp"

namespace plumbline {
namespace {

[[noreturn]] void not_for(const char* why) { throw std::invalid_argument(why); }

class ContactSolution : public Reference {
 public:
  ContactSolution(const Scenario& scenario, std::string citation)
      : bodies_(scenario.bodies), citation_(std::move(citation)) {
    const bool only_contact = scenario.forces.empty() && scenario.joints.empty() && scenario.springs.empty();
    if (!only_contact || !scenario.contact) not_for("bodies must touch, and nothing else but gravity may act on them");
    if (scenario.contact->restitution != 0) not_for("restitution must be 0");
    if (scenario.gravity.x() != 0 || scenario.gravity.y() != 0 || !(scenario.gravity.z() < 0)) {
      not_for("gravity must point along -z");
    }
  }
  std::string_view citation() const override { return citation_; }
  std::string_view kind() const override { return "solution"; }
  std::string_view bound_source() const override { return bound_source_; }
  double uncertainty() const override { return uncertainty_; }
  BodyState at(std::size_t body, double t) const override { return body == moving_ ? moved(t) : bodies_[body].initial; }

 protected:
  virtual BodyState moved(double t) const = 0;

  // The one body that moves.
  const Body& find_moving() {
    moving_ = bodies_.size();
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      if (bodies_[k].fixed) continue;
      if (moving_ != bodies_.size()) not_for("exactly one body may move");
      moving_ = k;
    }
    if (moving_ == bodies_.size()) not_for("one body must move");
    return bodies_[moving_];
  }
  // The start, turned about y by `angle` since, at this place and with these velocities.
  BodyState in_plane(double x, double z, double angle, double vx, double vz, double rate) const {
    BodyState s = bodies_[moving_].initial;
    s.p_WB.x() = x;
    s.p_WB.z() = z;
    s.v_WB = {vx, 0, vz};
    s.q_WB = rotation_by(angle * Vec3::UnitY()) * s.q_WB;
    s.w_WB = {0, rate, 0};
    return s;
  }

  std::vector<Body> bodies_;
  std::size_t moving_ = 0;
  double uncertainty_ = 0;
  std::string bound_source_ = "rounding of the solution's own steps, magnified as the motion magnifies it";

 private:
  std::string citation_;
};

bool faces(const Body& body, const Vec3& normal) {
  const auto* half = std::get_if<HalfSpace>(&body.shape);
  return half != nullptr && half->normal == normal && half->normal.dot(body.initial.p_WB) == 0;
}

class BallLeavesBall final : public ContactSolution {
 public:
  BallLeavesBall(const Scenario& scenario, std::string citation) : ContactSolution(scenario, std::move(citation)) {
    const Body& ball = find_moving();
    if (bodies_.size() != 2) not_for("there must be two balls, one of them fixed");
    const Body& hill = bodies_[1 - moving_];
    const auto *small = std::get_if<Sphere>(&ball.shape), *large = std::get_if<Sphere>(&hill.shape);
    if (small == nullptr || large == nullptr) not_for("both bodies must be spheres");
    centre_ = hill.initial.p_WB;
    const Vec3 arm = ball.initial.p_WB - centre_;
    const double path = small->radius + large->radius;
    if (arm.y() != 0 || !(arm.x() > 0) || std::abs(arm.norm() - path) > 1e-12 * path) {
      not_for("the ball must start in contact, beside the top, towards +x in the x-z plane");
    }
    if (!ball.initial.v_WB.isZero(0) || !ball.initial.w_WB.isZero(0)) not_for("the ball must start from rest");
    const double mu = scenario.contact->friction, g = scenario.gravity.norm();
    const double inertia = mu > 0 ? ball.inertia.y() / (ball.mass * small->radius * small->radius) : 0;
    const double angle = std::atan2(arm.x(), arm.z());
    motion_.emplace(path, small->radius, inertia, g, angle, 0.0);
    // exact/planar_pendulum.hpp: k^2 = cos^2(angle/2), and the growth itself.
    const double w0 = std::sqrt(g / path);
    uncertainty_ =
        8e-16 * (1 + w0 * scenario.duration) / std::pow(std::sin(angle / 2), 2) * (1 + path / scenario.scales.length);
    if (inertia > 0) {
      uncertainty_ += motion_->slip_bound(mu) * scenario.duration / scenario.scales.length;
      bound_source_ = "the slip just before it leaves, where no friction is enough for rolling";
    }
  }

 private:
  BodyState moved(double t) const override {
    const LeavingState s = motion_->at(t);
    return in_plane(centre_.x() + s.across, centre_.z() + s.up, s.turn, s.v_across, s.v_up, s.spin);
  }
  Vec3 centre_;
  std::optional<LeavingSphere> motion_;
};

class LadderFalls final : public ContactSolution {
 public:
  LadderFalls(const Scenario& scenario, std::string citation) : ContactSolution(scenario, std::move(citation)) {
    const Body& ladder = find_moving();
    const auto* box = std::get_if<Box>(&ladder.shape);
    const bool corner =
        bodies_.size() == 3 && box != nullptr && scenario.contact->friction == 0 &&
        std::count_if(bodies_.begin(), bodies_.end(), [](const Body& b) { return faces(b, Vec3::UnitX()); }) == 1 &&
        std::count_if(bodies_.begin(), bodies_.end(), [](const Body& b) { return faces(b, Vec3::UnitZ()); }) == 1;
    if (!corner) not_for("it takes a box, the half-spaces z <= 0 and x <= 0, and no friction");
    const BodyState& start = ladder.initial;
    angle_ = -2 * std::atan2(start.q_WB.y(), start.q_WB.w());
    if (start.q_WB.x() != 0 || start.q_WB.z() != 0 || !start.v_WB.isZero(0) || !start.w_WB.isZero(0)) {
      not_for("the ladder must lean in the x-z plane and start from rest");
    }
    const double length = box->size.z(), thickness = box->size.x();
    motion_.emplace(length, thickness, ladder.inertia.y() / ladder.mass, scenario.gravity.norm(), angle_,
                    scenario.duration);
    const LadderState first = motion_->at(0);
    if (std::hypot(first.x - start.p_WB.x(), first.z - start.p_WB.z()) > 1e-12 * length) {
      not_for("the ladder must touch wall and ground with the edges of its lower side");
    }
    uncertainty_ = 1e-13 * (1 + length / scenario.scales.length);
    bound_source_ = "agreement of two tolerances of the integration, and its energy";
  }

 private:
  BodyState moved(double t) const override {
    const LadderState s = motion_->at(t);
    return in_plane(s.x, s.z, angle_ - s.angle, s.vx, s.vz, -s.rate);
  }
  double angle_ = 0;
  std::optional<FallingLadder> motion_;
};

class DiscCurls final : public ContactSolution {
 public:
  DiscCurls(const Scenario& scenario, std::string citation) : ContactSolution(scenario, std::move(citation)) {
    const Body& disc = find_moving();
    const auto* cylinder = std::get_if<Cylinder>(&disc.shape);
    if (bodies_.size() != 2 || cylinder == nullptr || !faces(bodies_[1 - moving_], Vec3::UnitZ())) {
      not_for("it takes a cylinder on the half-space z <= 0");
    }
    const BodyState& start = disc.initial;
    const bool lies = start.q_WB.x() == 0 && start.q_WB.y() == 0 && start.p_WB.z() == cylinder->height / 2;
    const bool slides = start.v_WB.y() == 0 && start.v_WB.z() == 0 && start.w_WB.x() == 0 && start.w_WB.y() == 0;
    if (!lies || !slides) not_for("the disc must lie on the ground, slide along x and spin about z");
    const double radius = cylinder->radius;
    motion_.emplace(radius, disc.inertia.z() / (disc.mass * radius * radius),
                    scenario.contact->friction * scenario.gravity.norm(), start.v_WB.x(), start.w_WB.z());
    uncertainty_ = 1e-12 * (1 + radius / scenario.scales.length);
    bound_source_ = "agreement of two tolerances of the integration";
  }

 private:
  BodyState moved(double t) const override {
    const DiscState d = motion_->at(t);
    BodyState s = bodies_[moving_].initial;
    s.p_WB.x() += d.way;
    s.v_WB = {d.speed, 0, 0};
    s.q_WB = rotation_by(d.turn * Vec3::UnitZ()) * s.q_WB;
    s.w_WB = {0, 0, d.spin};
    return s;
  }
  std::optional<CurlingDisc> motion_;
};

}  // namespace

std::shared_ptr<const Reference> solve_leaving_sphere(const Scenario& scenario, std::string citation) {
  return std::make_shared<BallLeavesBall>(scenario, std::move(citation));
}
std::shared_ptr<const Reference> solve_falling_ladder(const Scenario& scenario, std::string citation) {
  return std::make_shared<LadderFalls>(scenario, std::move(citation));
}
std::shared_ptr<const Reference> solve_curling_disc(const Scenario& scenario, std::string citation) {
  return std::make_shared<DiscCurls>(scenario, std::move(citation));
}

}  // namespace plumbline
