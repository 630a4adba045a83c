// Ball joint: the two anchors are one point.
#include "joint_conditions.hpp"

namespace plumbline {

void append_ball(const PlacedJoint& joint, std::vector<JointRow>& rows) {
  for (int k = 0; k < 3; ++k) rows.push_back(no_gap_along(joint, Vec3::Unit(k)));
}

}  // namespace plumbline
