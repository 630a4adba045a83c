// Hinge: a ball joint whose z axes stay parallel. z_B must not lean towards x_A nor y_A.
#include "joint_conditions.hpp"

namespace plumbline {

void append_hinge(const PlacedJoint& joint, std::vector<JointRow>& rows) {
  append_ball(joint, rows);
  const Vec3 z_B = joint.axes_B.col(2);
  rows.push_back(right_angle(joint, joint.axes_A.col(0), z_B));
  rows.push_back(right_angle(joint, joint.axes_A.col(1), z_B));
}

}  // namespace plumbline
