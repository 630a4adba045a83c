#include "extended_joints.hpp"

#include <algorithm>
#include <cmath>

namespace plumbline::extended {
namespace {

const Placed& body_at(std::size_t body, std::span<const Placed> bodies) {
  static const Placed kStill;
  return body == kWorld ? kStill : bodies[body];
}

int rows_of(JointKind kind) {
  switch (kind) {
    case JointKind::kBall:
      return 3;
    case JointKind::kHinge:
    case JointKind::kSlider:
      return 5;
    case JointKind::kFixed:
      return 6;
    case JointKind::kDistance:
      return 1;
  }
  return 0;
}

// NaN sticks.
Real larger(Real a, Real b) { return b > a || std::isnan(b) ? b : a; }

// A vector that moves, with its derivatives where no body accelerates.
struct Moving {
  Vector3 value, rate, bend;
};

Moving turning(const Vector3& value, const Vector3& w) {
  const Vector3 rate = w.cross(value);
  return {value, rate, w.cross(rate)};
}

Real bias(const Moving& a, const Moving& b) {
  return a.bend.dot(b.value) + 2 * a.rate.dot(b.rate) + a.value.dot(b.bend);
}

// Joints in the order of elimination: neighbours close to each other, so that the envelope is narrow (Cuthill and
// McKee, reversed). A tree without branches is eliminated without any fill.
std::vector<std::size_t> elimination_order(const std::vector<Joint>& joints) {
  const auto meet = [&](const Joint& j, const Joint& k) {
    const auto is_end = [&](std::size_t body) { return body != kWorld && (body == k.a || body == k.b); };
    return is_end(j.a) || is_end(j.b);
  };
  std::vector<std::vector<std::size_t>> neighbours(joints.size());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    for (std::size_t k = 0; k < joints.size(); ++k) {
      if (j != k && meet(joints[j], joints[k])) neighbours[j].push_back(k);
    }
  }
  const auto fewer = [&](std::size_t j, std::size_t k) { return neighbours[j].size() < neighbours[k].size(); };
  std::vector<std::size_t> starts(joints.size()), order;
  for (std::size_t j = 0; j < joints.size(); ++j) starts[j] = j;
  std::stable_sort(starts.begin(), starts.end(), fewer);
  std::vector<bool> seen(joints.size(), false);
  for (const std::size_t start : starts) {
    if (seen[start]) continue;
    seen[start] = true;
    order.push_back(start);
    for (std::size_t done = order.size() - 1; done < order.size(); ++done) {
      std::vector<std::size_t> next;
      for (const std::size_t k : neighbours[order[done]]) {
        if (!seen[k]) next.push_back(k);
        seen[k] = true;
      }
      std::stable_sort(next.begin(), next.end(), fewer);
      order.insert(order.end(), next.begin(), next.end());
    }
  }
  std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace

// The two frames in W, and the way between the anchors.
struct JointSystem::Ends {
  const Placed &A, &B;
  Vector3 r_A, r_B;
  Matrix3 axes_A, axes_B;
  Moving d;

  Moving axis_A(int i) const { return turning(axes_A.col(i), A.w_W); }
  Moving axis_B(int i) const { return turning(axes_B.col(i), B.w_W); }

  Condition condition(const Vector3& force, const Vector3& torque_A_W, const Vector3& torque_B_W) const {
    return {force, A.R.transpose() * torque_A_W, B.R.transpose() * torque_B_W, 0, 0};
  }
  // e.d with e at rest in W
  Condition along(const Vector3& e) const {
    Condition c = condition(e, e.cross(r_A), r_B.cross(e));
    c.value = e.dot(d.value);
    c.bias = e.dot(d.bend);
    return c;
  }
  // a.d with a at rest in A
  Condition along(const Moving& a) const {
    Condition c = condition(a.value, a.value.cross(d.value + r_A), r_B.cross(a.value));
    c.value = a.value.dot(d.value);
    c.bias = bias(a, d);
    return c;
  }
  // a.b with a at rest in A, b at rest in B
  Condition across(const Moving& a, const Moving& b) const {
    const Vector3 normal = a.value.cross(b.value);
    Condition c = condition(Vector3::Zero(), normal, -normal);
    c.value = a.value.dot(b.value);
    c.bias = bias(a, b);
    return c;
  }
};

JointSystem::JointSystem(const std::vector<Joint>& joints) : place_(joints.size()) {
  const auto frame = [](const JointFrame& f) {
    const Quaternion q = Quaternion(f.attitude.cast<Real>()).normalized();
    return Frame{f.anchor.cast<Real>(), q.toRotationMatrix()};
  };
  Eigen::Index rows = 0;
  for (const std::size_t k : elimination_order(joints)) {
    const Joint& joint = joints[k];
    place_[k] = joints_.size();
    joints_.push_back({joint.kind, joint.a, joint.b, frame(joint.on_a), frame(joint.on_b), joint.length, rows});
    rows += rows_of(joint.kind);
  }
  std::vector<Eigen::Index> first;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    Eigen::Index begin = joints_[j].first_row;
    for (std::size_t k = 0; k <= j; ++k) {
      for (const bool as_b : {false, true}) {
        const std::size_t body = as_b ? joints_[j].b : joints_[j].a;
        if (body == kWorld) continue;
        for (const bool other_as_b : {false, true}) {
          if (body != (other_as_b ? joints_[k].b : joints_[k].a)) continue;
          meetings_.push_back({j, k, body, as_b, other_as_b});
          begin = std::min(begin, joints_[k].first_row);
        }
      }
    }
    first.insert(first.end(), static_cast<std::size_t>(rows_of(joints_[j].kind)), begin);
  }
  rows_.resize(static_cast<std::size_t>(rows));
  solver_ = SemidefiniteSolver(std::move(first));
  right_ = Column::Zero(rows);
}

JointSystem::Ends JointSystem::ends(const Tie& tie, std::span<const Placed> bodies) const {
  const Placed &A = body_at(tie.a, bodies), &B = body_at(tie.b, bodies);
  Ends e{A, B, A.R * tie.on_a.anchor, B.R * tie.on_b.anchor, A.R * tie.on_a.axes, B.R * tie.on_b.axes, {}};
  const Moving a = turning(e.r_A, A.w_W), b = turning(e.r_B, B.w_W);
  e.d = {B.p + b.value - A.p - a.value, B.v + b.rate - A.v - a.rate, b.bend - a.bend};
  return e;
}

void JointSystem::write(const Tie& tie, std::span<const Placed> bodies) {
  const Ends e = ends(tie, bodies);
  Condition* row = &rows_[static_cast<std::size_t>(tie.first_row)];
  if (tie.kind == JointKind::kBall || tie.kind == JointKind::kHinge || tie.kind == JointKind::kFixed) {
    for (int i = 0; i < 3; ++i) *row++ = e.along(Vector3::Unit(i));
  }
  switch (tie.kind) {
    case JointKind::kBall:
      return;
    case JointKind::kHinge:
      for (int i = 0; i < 2; ++i) *row++ = e.across(e.axis_A(i), e.axis_B(2));
      return;
    case JointKind::kSlider:
      for (int i = 0; i < 2; ++i) *row++ = e.along(e.axis_A(i));
      for (int i = 0; i < 2; ++i) *row++ = e.across(e.axis_A(i), e.axis_B(2));
      *row = e.across(e.axis_A(0), e.axis_B(1));
      return;
    case JointKind::kFixed:
      for (int i = 0; i < 3; ++i) *row++ = e.across(e.axis_A((i + 1) % 3), e.axis_B((i + 2) % 3));
      return;
    case JointKind::kDistance: {
      // (d.d)' = 2 d.d', so that along(d at rest) has the right rows; its bias lacks d'.d'.
      const Vector3 d = e.d.value;
      *row = e.condition(d / tie.length, d.cross(e.r_A) / tie.length, e.r_B.cross(d) / tie.length);
      row->value = (d.squaredNorm() / tie.length - tie.length) / 2;
      row->bias = (e.d.rate.squaredNorm() + d.dot(e.d.bend)) / tie.length;
      return;
    }
  }
}

void JointSystem::factor(std::span<const Placed> bodies) {
  for (const Tie& tie : joints_) write(tie, bodies);
  solver_.clear();
  for (const Meeting& m : meetings_) {
    const Tie &mine = joints_[m.joint], &other = joints_[m.other];
    const Placed& body = bodies[m.body];
    const Real inverse_mass = m.as_b == m.other_as_b ? body.inverse_mass : -body.inverse_mass;
    for (int i = 0; i < rows_of(mine.kind); ++i) {
      const Eigen::Index r = mine.first_row + i;
      const Condition& row = rows_[static_cast<std::size_t>(r)];
      const Vector3 force = inverse_mass * row.force;
      const Vector3 torque = body.inverse_inertia.cwiseProduct(m.as_b ? row.torque_B : row.torque_A);
      const Eigen::Index end = std::min(r + 1, other.first_row + rows_of(other.kind));
      for (Eigen::Index k = other.first_row; k < end; ++k) {
        const Condition& column = rows_[static_cast<std::size_t>(k)];
        solver_.at(r, k) += force.dot(column.force) + torque.dot(m.other_as_b ? column.torque_B : column.torque_A);
      }
    }
  }
  solver_.factor();
}

void JointSystem::push(std::span<const Placed> bodies, Column& change) {
  solver_.solve(right_);
  for (const Tie& tie : joints_) {
    for (int i = 0; i < rows_of(tie.kind); ++i) {
      const Condition& row = rows_[static_cast<std::size_t>(tie.first_row + i)];
      const Real lambda = right_[tie.first_row + i];
      const auto act = [&](std::size_t body, Real sign, const Vector3& torque) {
        const auto at = static_cast<Eigen::Index>(6 * body);
        change.segment<3>(at) += (sign * lambda * bodies[body].inverse_mass) * row.force;
        change.segment<3>(at + 3) += lambda * bodies[body].inverse_inertia.cwiseProduct(torque);
      };
      act(tie.b, 1, row.torque_B);
      if (tie.a != kWorld) act(tie.a, -1, row.torque_A);
    }
  }
}

Real JointSystem::rate(const Condition& c, const Placed& A, const Placed& B) {
  return c.force.dot(B.v - A.v) + c.torque_A.dot(A.w_B) + c.torque_B.dot(B.w_B);
}

Real JointSystem::rate_of(const Tie& tie, Eigen::Index row, std::span<const Placed> bodies) const {
  return rate(rows_[static_cast<std::size_t>(row)], body_at(tie.a, bodies), body_at(tie.b, bodies));
}

void JointSystem::accelerate(std::span<const Placed> bodies, Column& a) {
  if (empty()) return;
  factor(bodies);
  for (const Tie& tie : joints_) {
    for (Eigen::Index r = tie.first_row; r < tie.first_row + rows_of(tie.kind); ++r) {
      const Condition& row = rows_[static_cast<std::size_t>(r)];
      const auto at = [](std::size_t body) { return static_cast<Eigen::Index>(6 * body); };
      Real second = row.bias + row.force.dot(a.segment<3>(at(tie.b))) + row.torque_B.dot(a.segment<3>(at(tie.b) + 3));
      if (tie.a != kWorld) {
        second += row.torque_A.dot(a.segment<3>(at(tie.a) + 3)) - row.force.dot(a.segment<3>(at(tie.a)));
      }
      right_[r] = -second;
    }
  }
  push(bodies, a);
}

Real JointSystem::close_places(std::span<const Placed> bodies, Column& displacement) {
  factor(bodies);
  Real largest = 0;
  for (Eigen::Index r = 0; r < right_.size(); ++r) {
    right_[r] = -rows_[static_cast<std::size_t>(r)].value;
    largest = larger(largest, std::abs(right_[r]));
  }
  push(bodies, displacement);
  return largest;
}

Real JointSystem::close_velocities(std::span<const Placed> bodies, Column& change) {
  factor(bodies);
  Real largest = 0;
  for (const Tie& tie : joints_) {
    for (Eigen::Index r = tie.first_row; r < tie.first_row + rows_of(tie.kind); ++r) {
      right_[r] = -rate_of(tie, r, bodies);
      largest = larger(largest, std::abs(right_[r]));
    }
  }
  push(bodies, change);
  return largest;
}

Condition JointSystem::coordinate(std::size_t joint, std::span<const Placed> bodies) const {
  const Tie& tie = joints_[place_[joint]];
  const Ends e = ends(tie, bodies);
  if (tie.kind == JointKind::kSlider) return e.along(e.axis_A(2));
  const Vector3 z = e.axes_A.col(2), x_B = e.axes_B.col(0);
  Condition c = e.condition(Vector3::Zero(), -z, z);
  c.value = std::atan2(e.axes_A.col(1).dot(x_B), e.axes_A.col(0).dot(x_B));
  return c;
}

}  // namespace plumbline::extended
