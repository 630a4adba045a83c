// Slider: no turning, and no gap across the z axis of A.
#include "joint_conditions.hpp"

namespace plumbline {

void append_slider(const PlacedJoint& joint, std::vector<JointRow>& rows) {
  const Mat3 &A = joint.axes_A, &B = joint.axes_B;
  rows.push_back(travel_along(joint, A.col(0)));
  rows.push_back(travel_along(joint, A.col(1)));
  for (int k = 0; k < 3; ++k) rows.push_back(right_angle(joint, A.col(k), B.col((k + 1) % 3)));
}

}  // namespace plumbline
