#include "plumbline/core/joints/joint_projection.hpp"

#include <algorithm>
#include <cmath>

#include "plumbline/core/integration/attitude.hpp"
#include "plumbline/core/metric.hpp"

namespace plumbline {
namespace {

// The rows of all joints, and of the coordinates that are beyond their range, whose error is counted from the limit.
std::vector<JointRow> violated_rows(const ArticulatedBody& body, std::span<const BodyState> states) {
  std::vector<JointRow> rows = joint_rows(body, states);
  for (const Joint& joint : body.joints) {
    if (!joint.range) continue;
    JointRow row = coordinate_row(joint, states);
    row.error -= std::clamp(row.error, joint.range->low, joint.range->high);
    if (row.error != 0) rows.push_back(row);
  }
  return rows;
}

std::vector<JointRow> held_rows(const ArticulatedBody& body, std::span<const BodyState> states,
                                std::span<const std::size_t> held_ranges) {
  std::vector<JointRow> rows = joint_rows(body, states);
  for (const std::size_t k : held_ranges) {
    const JointRange& range = body.joints.at(k).range.value();
    JointRow row = coordinate_row(body.joints[k], states);
    const double from_low = row.error - range.low, from_high = row.error - range.high;
    row.error = std::abs(from_low) < std::abs(from_high) ? from_low : from_high;
    rows.push_back(row);
  }
  return rows;
}

template <class Rows>
Projection closed(const ArticulatedBody& body, std::span<BodyState> states, double tolerance, int max_sweeps,
                  Rows rows_of) {
  Projection done;
  for (;;) {
    const std::vector<JointRow> rows = rows_of();
    Eigen::VectorXd C(static_cast<Eigen::Index>(rows.size()));
    done.error = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      C[static_cast<Eigen::Index>(k)] = rows[k].error;
      done.error = max_or_nan(done.error, std::abs(rows[k].error));
    }
    // Written so that NaN goes on to the limit of sweeps and is reported.
    if (done.error <= tolerance || done.sweeps == max_sweeps) return done;
    const LeastChange solved = least_change(body, states, rows, -C);
    for (std::size_t i = 0; i < states.size(); ++i) {
      states[i].p_WB += solved.change[i].linear_W;
      states[i].q_WB = turned(states[i].q_WB, solved.change[i].angular_W);
    }
    ++done.sweeps;
  }
}

}  // namespace

Projection project_positions(const ArticulatedBody& body, std::span<BodyState> states, double tolerance,
                             int max_sweeps) {
  return closed(body, states, tolerance, max_sweeps, [&] { return violated_rows(body, states); });
}

Projection project_positions_held(const ArticulatedBody& body, std::span<BodyState> states,
                                  std::span<const std::size_t> held_ranges, double tolerance, int max_sweeps) {
  return closed(body, states, tolerance, max_sweeps, [&] { return held_rows(body, states, held_ranges); });
}

double project_velocities(const ArticulatedBody& body, std::span<BodyState> states,
                          std::span<const std::size_t> held_ranges) {
  const std::vector<JointRow> rows = held_rows(body, states, held_ranges);
  Eigen::VectorXd b(static_cast<Eigen::Index>(rows.size()));
  double largest = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    b[static_cast<Eigen::Index>(k)] = -rate(rows[k], states);
    largest = max_or_nan(largest, std::abs(b[static_cast<Eigen::Index>(k)]));
  }
  const LeastChange solved = least_change(body, states, rows, b);
  for (std::size_t i = 0; i < states.size(); ++i) {
    states[i].v_WB += solved.change[i].linear_W;
    states[i].w_WB += solved.change[i].angular_W;
  }
  return largest;
}

}  // namespace plumbline
