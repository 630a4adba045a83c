#include "solution_linkage.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <tuple>

#include "plumbline/core/exact/planar_pendulum.hpp"
#include "plumbline/core/joints/joint_equations.hpp"

namespace plumbline {
namespace {

constexpr double kTight = 1e-9;  // typing errors are larger, rounding is smaller

[[noreturn]] void refuse(const char* why) { throw std::invalid_argument(why); }

struct Carried {
  Vec3 centre;  // of the circle that the centre of mass runs on
  Vec3 arm;     // at the start
  bool turns = false;
  bool placed = false;
};

class TurningLinkage final : public Reference {
 public:
  TurningLinkage(const Scenario& scenario, std::string citation) : citation_(std::move(citation)) {
    if (!scenario.forces.empty() || !scenario.springs.empty() || !scenario.joint_springs.empty() ||
        !scenario.drives.empty() || scenario.contact) {
      refuse("it is for bodies on hinges under gravity alone: no forces, springs, drives or contact");
    }
    for (const Body& body : scenario.bodies) start_.push_back(body.initial);
    find_axis(scenario);
    place(scenario);
    find_pendulum(scenario);
    require_joints(scenario);
    find_stop(scenario);
  }

  BodyState at(std::size_t body, double t) const override {
    if (!bodies_[body].placed) return start_[body];  // fixed
    const bool stands = stop_ && t >= stop_->time;
    const PendulumState now = stands ? PendulumState{stop_->angle, 0} : pendulum_->at(t);
    return turned(body, now.angle - angle0_, now.rate);
  }
  double uncertainty() const override { return uncertainty_; }
  std::string_view citation() const override { return citation_; }
  std::string_view kind() const override { return "solution"; }
  std::string_view bound_source() const override {
    return "rounding of the solution's own steps, magnified as the motion magnifies it";
  }

 private:
  struct Stop {
    double time = 0, angle = 0;
  };

  void find_axis(const Scenario& scenario) {
    bool found = false;
    for (const Joint& joint : scenario.joints) {
      if (joint.kind != JointKind::kHinge) refuse("all its joints must be hinges");
      if (joint.a == kWorld && !found) {
        axis_W_ = joint.on_a.axis();
        found = true;
      }
    }
    if (!found) refuse("a hinge must lead to the world");
  }

  Vec3 across(const Vec3& v) const { return v - axis_W_ * axis_W_.dot(v); }

  void place(const Scenario& scenario) {
    bodies_.resize(start_.size());
    for (const Joint& joint : scenario.joints) {
      if (joint.a == kWorld) {
        const Vec3 arm = across(start_[joint.b].p_WB - joint.on_a.anchor);
        bodies_[joint.b] = {start_[joint.b].p_WB - arm, arm, true, true};
      }
    }
    // A body that is carried has its circle from the joint with a body that turns.
    for (const Joint& joint : scenario.joints) {
      if (joint.a == kWorld) continue;
      for (const auto& [from, frame, to] :
           {std::tuple(joint.a, &joint.on_a, joint.b), std::tuple(joint.b, &joint.on_b, joint.a)}) {
        if (!bodies_[from].turns || bodies_[to].placed) continue;
        const Vec3 point = start_[from].p_WB + start_[from].q_WB * frame->anchor;
        const Vec3 arm = across(point - bodies_[from].centre);
        bodies_[to] = {start_[to].p_WB - arm, arm, false, true};
      }
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (bodies_[i].placed == scenario.bodies[i].fixed) {
        refuse("every body that moves must hang on a hinge to the world or on a body that does");
      }
    }
  }

  void find_pendulum(const Scenario& scenario) {
    Vec3 sum = Vec3::Zero();
    double inertia = 0, longest = 0, rate = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Body& body = scenario.bodies[i];
      if (body.fixed) continue;
      sum += body.mass * bodies_[i].arm;
      inertia += body.mass * bodies_[i].arm.squaredNorm();
      longest = std::max(longest, bodies_[i].arm.norm());
      if (bodies_[i].turns) {
        inertia += axis_W_.dot(inertia_in_world(body, start_[i].q_WB) * axis_W_);
        rate = axis_W_.dot(start_[i].w_WB);
      }
    }
    const Vec3 g = across(scenario.gravity);
    if (!(g.norm() > kTight * scenario.gravity.norm()) || !(sum.norm() > kTight * longest)) {
      refuse("gravity must have a lever about the axis");
    }
    const double w0 = std::sqrt(sum.norm() * g.norm() / inertia);
    const Vec3 down = g.normalized();
    const PendulumState initial{std::atan2(axis_W_.dot(down.cross(sum)), down.dot(sum)), rate};
    pendulum_.emplace(w0, initial);
    angle0_ = initial.angle;
    w0_ = w0;
    // exact/planar_pendulum.hpp: a few 1e-16 (1 + w0 t) of the arm, magnified near the upright position.
    const double k2 = std::pow(std::sin(initial.angle / 2), 2) + std::pow(initial.rate / (2 * w0), 2);
    uncertainty_ = 8e-16 * (1 + w0 * scenario.duration) / std::abs(1 - k2) * (1 + longest / scenario.scales.length);
  }

  BodyState turned(std::size_t body, double turn, double rate) const {
    const Carried& of = bodies_[body];
    const Quat rotation = rotation_by(turn * axis_W_);
    const Vec3 arm = rotation * of.arm;
    BodyState s = start_[body];
    s.p_WB = of.centre + arm;
    s.v_WB = rate * axis_W_.cross(arm);
    s.w_WB = Vec3::Zero();
    if (of.turns) {
      s.q_WB = rotation * s.q_WB;
      s.w_WB = rate * axis_W_;
    }
    return s;
  }

  // That all joints hold on the whole circle is what makes this the motion.
  void require_joints(const Scenario& scenario) const {
    const ArticulatedBody linkage = articulated_body(scenario);
    const double rate = pendulum_->at(0).rate;
    for (int k = 0; k < 16; ++k) {
      std::vector<BodyState> states = start_;
      for (std::size_t i = 0; i < states.size(); ++i) {
        if (bodies_[i].placed) states[i] = turned(i, 0.4 * k, rate);
        const double miss = (states[i].v_WB - start_[i].v_WB).norm() + (states[i].w_WB - start_[i].w_WB).norm();
        if (k == 0 && !(miss <= kTight * (1 + std::abs(rate)))) refuse("one angle does not move all its bodies");
      }
      if (!(joint_error(linkage, states) <= kTight * scenario.scales.length)) {
        refuse("one angle does not move all its bodies");
      }
    }
  }

  void find_stop(const Scenario& scenario) {
    for (const Joint& joint : scenario.joints) {
      if (!joint.range) continue;
      if (joint.a != kWorld) refuse("only a hinge to the world may have a range");
      const double low = angle0_ + joint.range->low, high = angle0_ + joint.range->high;
      const auto beyond = [&](double t) {
        const double angle = pendulum_->at(t).angle;
        return angle > high || angle < low;
      };
      double before = 0, after = 0;
      const double stride = std::min(1.0, 1 / (1 + pendulum_->period() * w0_)) / (16 * w0_);
      while (after < scenario.duration && !beyond(after)) {
        before = after;
        after += stride;
      }
      if (!beyond(after) || (stop_ && stop_->time < before)) continue;
      for (int k = 0; k < 100; ++k) {
        const double middle = (before + after) / 2;
        (beyond(middle) ? after : before) = middle;
      }
      const bool up = pendulum_->at(after).angle > high;
      stop_ = Stop{after, up ? high : low};
      // theta'' = -w0^2 sin(theta) must press on.
      if (!((up ? -1 : 1) * std::sin(stop_->angle) > 0)) refuse("gravity must hold it against the stop");
    }
  }

  std::string citation_;
  std::vector<BodyState> start_;
  std::vector<Carried> bodies_;
  Vec3 axis_W_ = Vec3::UnitZ();
  double angle0_ = 0, w0_ = 0, uncertainty_ = 0;
  std::optional<PlanarPendulum> pendulum_;
  std::optional<Stop> stop_;
};

}  // namespace

std::shared_ptr<const Reference> solve_turning_linkage(const Scenario& scenario, std::string citation) {
  return std::make_shared<TurningLinkage>(scenario, std::move(citation));
}

}  // namespace plumbline
