// Fixed joint: a ball joint that does not turn either. Three right angles, x_A y_B, y_A z_B, z_A x_B, leave no freedom.
#include "joint_conditions.hpp"

namespace plumbline {

void append_fixed(const PlacedJoint& joint, std::vector<JointRow>& rows) {
  append_ball(joint, rows);
  const Mat3 &A = joint.axes_A, &B = joint.axes_B;
  for (int k = 0; k < 3; ++k) rows.push_back(right_angle(joint, A.col(k), B.col((k + 1) % 3)));
}

}  // namespace plumbline
