#include "plumbline/core/joints/constrained_motion.hpp"

#include <stdexcept>
#include <utility>

namespace plumbline {
namespace {

void require_count(const ArticulatedBody& body, std::size_t states) {
  if (states != body.bodies.size()) throw std::invalid_argument("an articulated body needs one state per body");
}

// Without joints: gravity, what is applied, and the gyroscopic term, since M = dL/dt = I alpha + w x (I w).
std::vector<Twist> free_accelerations(const ArticulatedBody& body, std::span<const BodyState> states,
                                      std::span<const Wrench> wrenches) {
  std::vector<Twist> result;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const BodyState& s = states[i];
    const Wrench applied = wrenches.empty() ? Wrench{} : wrenches[i];
    const Vec3 w_B = s.q_WB.conjugate() * s.w_WB;
    const Vec3 gyroscopic_W = s.q_WB * w_B.cross(body.bodies[i].inertia_B * w_B);
    result.push_back(answer(body.bodies[i], s.q_WB, applied.f_W, applied.tau_W - gyroscopic_W));
    result.back().linear_W += body.gravity_W;
  }
  return result;
}

// What the rows still lack of `target` under x.
template <class Target>
Eigen::VectorXd lacking(std::span<const JointRow> rows, std::span<const Twist> x, Target target) {
  Eigen::VectorXd b(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) b[static_cast<Eigen::Index>(k)] = target(rows[k]) - rate(rows[k], x);
  return b;
}

}  // namespace

std::vector<JointReaction> reactions(const ArticulatedBody& body, std::span<const BodyState> states,
                                     std::span<const JointRow> rows, const Eigen::VectorXd& multipliers) {
  std::vector<JointReaction> result;
  std::size_t k = 0;
  for (const Joint& joint : body.joints) {
    const std::size_t end = k + joint_rows(joint, states).size();
    JointReaction sum;
    Vec3 about_centre = Vec3::Zero();
    for (; k < end; ++k) {
      const double lambda = multipliers[static_cast<Eigen::Index>(k)];
      sum.f_W += lambda * rows[k].force_W;
      about_centre += lambda * rows[k].torque_b_W;
    }
    const Vec3 r_B = states[joint.b].q_WB * joint.on_b.anchor;
    sum.tau_W = about_centre - r_B.cross(sum.f_W);
    result.push_back(sum);
  }
  return result;
}

ConstrainedAccelerations constrained_accelerations(const ArticulatedBody& body, std::span<const BodyState> states,
                                                   std::span<const Wrench> wrenches,
                                                   std::span<const std::size_t> held_ranges) {
  require_count(body, states.size());
  if (!wrenches.empty()) require_count(body, wrenches.size());
  std::vector<JointRow> rows = joint_rows(body, states);
  const std::size_t of_joints = rows.size();
  for (const std::size_t joint : held_ranges) rows.push_back(coordinate_row(body.joints.at(joint), states));

  const std::vector<Twist> free = free_accelerations(body, states, wrenches);
  const LeastChange solved =
      least_change(body, states, rows, lacking(rows, free, [](const JointRow& row) { return -row.bias; }));

  ConstrainedAccelerations result;
  for (std::size_t i = 0; i < states.size(); ++i) {
    result.accelerations.push_back(
        {free[i].linear_W + solved.change[i].linear_W, free[i].angular_W + solved.change[i].angular_W});
  }
  result.reactions = reactions(body, states, rows, solved.multipliers);
  for (std::size_t k = of_joints; k < rows.size(); ++k) {
    result.range_forces.push_back(solved.multipliers[static_cast<Eigen::Index>(k)]);
  }
  result.rank = solved.rank;
  return result;
}

AccelerationField constrained_field(const ArticulatedBody& body, WrenchField wrenches,
                                    std::vector<std::size_t> held_ranges) {
  require_valid(body);
  return [body, wrenches = std::move(wrenches), held_ranges = std::move(held_ranges)](
             double t, std::span<const BodyState> states, std::span<Acceleration> accelerations) {
    std::vector<Wrench> applied;
    if (wrenches) {
      applied.resize(states.size());
      wrenches(t, states, applied);
    }
    const auto all = constrained_accelerations(body, states, applied, held_ranges).accelerations;
    for (std::size_t i = 0; i < all.size(); ++i) accelerations[i] = all[i];
  };
}

std::vector<JointReaction> apply_impulse(const ArticulatedBody& body, std::span<BodyState> states, std::size_t on_body,
                                         const Vec3& point_W, const Vec3& impulse_W) {
  require_count(body, states.size());
  if (on_body >= states.size()) throw std::invalid_argument("there is no such body to give an impulse to");
  std::vector<Twist> jump(states.size());
  const BodyState& hit = states[on_body];
  jump[on_body] = answer(body.bodies[on_body], hit.q_WB, impulse_W, (point_W - hit.p_WB).cross(impulse_W));

  const std::vector<JointRow> rows = joint_rows(body, states);
  const LeastChange solved = least_change(body, states, rows, lacking(rows, jump, [](const JointRow&) { return 0.0; }));
  for (std::size_t i = 0; i < states.size(); ++i) {
    states[i].v_WB += jump[i].linear_W + solved.change[i].linear_W;
    states[i].w_WB += jump[i].angular_W + solved.change[i].angular_W;
  }
  return reactions(body, states, rows, solved.multipliers);
}

}  // namespace plumbline
