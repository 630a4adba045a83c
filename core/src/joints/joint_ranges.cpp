#include "plumbline/core/joints/joint_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "plumbline/core/metric.hpp"

namespace plumbline {
namespace {

constexpr double kTouch = 1e-9;  // [rad] or [m]: what an integrator's drift may do to a coordinate that rests
constexpr double kMeet = 1e-12;  // [rad] or [m]: how closely a limit is met
constexpr int kMostImpacts = 100;

// What the unit impulse of a limit does to all bodies, joints included.
std::vector<Twist> unit_answer(const ArticulatedBody& body, std::span<const BodyState> states,
                               std::span<const JointRow> joints, const JointRow& limit, double sense) {
  std::vector<Twist> x(states.size());
  const auto push = [&](std::size_t i, const Vec3& force, const Vec3& torque) {
    if (i != kWorld) x[i] = answer(body.bodies[i], states[i].q_WB, sense * force, sense * torque);
  };
  push(limit.a, -limit.force_W, limit.torque_a_W);
  push(limit.b, limit.force_W, limit.torque_b_W);
  Eigen::VectorXd lacking(static_cast<Eigen::Index>(joints.size()));
  for (std::size_t k = 0; k < joints.size(); ++k) lacking[static_cast<Eigen::Index>(k)] = -rate(joints[k], x);
  const LeastChange solved = least_change(body, states, joints, lacking);
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i].linear_W += solved.change[i].linear_W;
    x[i].angular_W += solved.change[i].angular_W;
  }
  return x;
}

// J >= 0, D J >= b, J.(D J - b) = 0: few limits are reached at once, so plain projected Gauss-Seidel will do.
Eigen::VectorXd pushes(const Eigen::MatrixXd& D, const Eigen::VectorXd& b) {
  Eigen::VectorXd J = Eigen::VectorXd::Zero(b.size());
  for (int sweep = 0; sweep < 1000; ++sweep) {
    double largest = 0;
    for (Eigen::Index i = 0; i < b.size(); ++i) {
      if (!(D(i, i) > 0)) continue;  // the joints alone hold this coordinate
      const double old = J[i];
      const double next = old + (b[i] - D.row(i).dot(J)) / D(i, i);
      J[i] = next < 0 ? 0 : next;  // lets NaN through
      largest = std::max(largest, std::abs(J[i] - old));
    }
    if (!(largest > 1e-15 * J.cwiseAbs().maxCoeff())) break;
  }
  return J;
}

// Joints whose coordinate rests on a limit that has to push to keep it there.
std::vector<std::size_t> leaning(const ArticulatedBody& body, std::span<const BodyState> states,
                                 std::span<const Wrench> wrenches) {
  std::vector<std::size_t> joints;
  std::vector<double> senses;
  for (const RangeLimit& limit : range_limits(body)) {
    if (room(body, limit, states) > kTouch || std::abs(room_rate(body, limit, states)) > kTouch) continue;
    joints.push_back(limit.joint);
    senses.push_back(limit.sense);
  }
  while (!joints.empty()) {  // let go of the one that pulls most, until all push
    const std::vector<double> force = constrained_accelerations(body, states, wrenches, joints).range_forces;
    std::size_t worst = 0;
    for (std::size_t k = 1; k < force.size(); ++k) {
      if (senses[k] * force[k] < senses[worst] * force[worst]) worst = k;
    }
    if (!(senses[worst] * force[worst] < 0)) break;
    joints.erase(joints.begin() + static_cast<std::ptrdiff_t>(worst));
    senses.erase(senses.begin() + static_cast<std::ptrdiff_t>(worst));
  }
  return joints;
}

// Least room of all limits but the ones that are held.
double least_room(const ArticulatedBody& body, const std::vector<std::size_t>& held,
                  std::span<const BodyState> states) {
  double least = std::numeric_limits<double>::infinity();
  for (const RangeLimit& limit : range_limits(body)) {
    if (std::find(held.begin(), held.end(), limit.joint) != held.end()) continue;
    least = std::min(least, room(body, limit, states));
  }
  return least;
}

}  // namespace

double room(const ArticulatedBody& body, const RangeLimit& limit, std::span<const BodyState> states) {
  const Joint& joint = body.joints[limit.joint];
  const double x = coordinate_row(joint, states).error;
  return limit.sense > 0 ? x - joint.range->low : joint.range->high - x;
}

double room_rate(const ArticulatedBody& body, const RangeLimit& limit, std::span<const BodyState> states) {
  return limit.sense * rate(coordinate_row(body.joints[limit.joint], states), states);
}

std::vector<RangeLimit> range_limits(const ArticulatedBody& body) {
  std::vector<RangeLimit> limits;
  for (std::size_t k = 0; k < body.joints.size(); ++k) {
    if (!body.joints[k].range) continue;
    if (body.joints[k].kind != JointKind::kBall) limits.push_back({k, 1});
    limits.push_back({k, -1});
  }
  return limits;
}

std::vector<double> resolve_range_impacts(const ArticulatedBody& body, std::span<BodyState> states,
                                          const RangeRule& rule, double touch) {
  if (!(rule.restitution >= 0 && rule.restitution <= 1)) throw std::invalid_argument("restitution lies within [0, 1]");
  const std::vector<RangeLimit> limits = range_limits(body);
  std::vector<double> impulses(limits.size(), 0);
  std::vector<std::size_t> reached;
  for (std::size_t k = 0; k < limits.size(); ++k) {
    if (!(room(body, limits[k], states) > touch)) reached.push_back(k);
  }
  if (reached.empty()) return impulses;
  const std::vector<JointRow> joints = joint_rows(body, states);
  const Eigen::Index n = static_cast<Eigen::Index>(reached.size());
  std::vector<std::vector<Twist>> answers;
  Eigen::MatrixXd D(n, n);
  Eigen::VectorXd b(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const RangeLimit& limit = limits[reached[static_cast<std::size_t>(j)]];
    answers.push_back(unit_answer(body, states, joints, coordinate_row(body.joints[limit.joint], states), limit.sense));
    const double r = room_rate(body, limit, states);
    const double rebound = rule.restitution * -r;
    b[j] = (rebound > rule.rest_speed ? rebound : 0) - r;
    for (Eigen::Index i = 0; i < n; ++i) {
      const RangeLimit& other = limits[reached[static_cast<std::size_t>(i)]];
      D(i, j) = other.sense * rate(coordinate_row(body.joints[other.joint], states), answers.back());
    }
  }
  const Eigen::VectorXd J = pushes(D, b);
  for (Eigen::Index j = 0; j < n; ++j) {
    impulses[reached[static_cast<std::size_t>(j)]] = J[j];
    for (std::size_t i = 0; i < states.size(); ++i) {
      states[i].v_WB += J[j] * answers[static_cast<std::size_t>(j)][i].linear_W;
      states[i].w_WB += J[j] * answers[static_cast<std::size_t>(j)][i].angular_W;
    }
  }
  return impulses;
}

int advance_within_ranges(const ArticulatedBody& body, Stepper& stepper, double t, double dt,
                          std::vector<BodyState>& states, const RangeRule& rule, const WrenchField& wrenches,
                          const Closing& close) {
  if (!(dt > 0)) throw std::invalid_argument("ranges are kept forwards in time: dt must be > 0");
  const double end = t + dt;
  for (int impacts = 0; impacts <= kMostImpacts; ++impacts) {
    std::vector<Wrench> applied;
    if (wrenches) {
      applied.resize(states.size());
      wrenches(t, states, applied);
    }
    const std::vector<std::size_t> held = leaning(body, states, applied);
    const AccelerationField field = constrained_field(body, wrenches, held);
    const auto after = [&](double h) {
      std::vector<BodyState> moved = states;
      if (h > 0) stepper.step(field, t, h, moved);
      if (h > 0 && close) close(moved, held);
      return moved;
    };
    std::vector<BodyState> moved = after(end - t);
    if (!(least_room(body, held, moved) < -kMeet)) {
      states = moved;
      return impacts;
    }
    // Cut the step: inside at `early`, beyond at `late`. False position, halving now and then so that it never stalls.
    double early = 0, late = end - t;
    double room_early = std::max(0.0, least_room(body, held, states)), room_late = least_room(body, held, moved);
    std::vector<BodyState> inside = states;
    for (int trial = 0; trial < 100 && late - early > 1e-15 * (1 + std::abs(t)); ++trial) {
      const bool halve = trial % 3 == 2 || room_early == 0;
      const double h = halve ? (early + late) / 2 : early + (late - early) * room_early / (room_early - room_late);
      moved = after(h);
      const double room_now = least_room(body, held, moved);
      if (room_now >= 0) {
        early = h;
        room_early = room_now;
        inside = moved;
      } else {
        late = h;
        room_late = room_now;
        if (room_now > -kMeet) {
          early = h;
          inside = moved;
          break;
        }
      }
      if (room_early > 0 && room_early < kMeet && late - early < 1e-9) break;
    }
    states = inside;
    t += early;
    stepper.restart();
    resolve_range_impacts(body, states, rule);
    if (!(end - t > 0)) return impacts + 1;
  }
  throw std::runtime_error("more than 100 impacts at joint limits in one step: raise rest_speed or lower dt");
}

}  // namespace plumbline
