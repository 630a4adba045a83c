// Distance joint: the rod between the anchors keeps its length, C = |gap| - length.
//
// With u = gap/|gap|, dC/dt = u . gap'. The direction turns with u' = (gap' - u (u . gap'))/|gap|, so that what is left
// of d2C/dt2 when neither body accelerates is u . gap'' plus the square of the speed across the rod over its length:
// the centripetal acceleration of one end about the other.
#include "joint_conditions.hpp"

namespace plumbline {

void append_distance(const PlacedJoint& joint, double length, std::vector<JointRow>& rows) {
  const double distance = joint.gap.norm();
  // Ends that have met have no direction; any one serves until they part.
  const Vec3 u = distance > 0 ? Vec3(joint.gap / distance) : Vec3(Vec3::UnitZ());
  JointRow row = no_gap_along(joint, u);
  row.error = distance - length;
  if (distance > 0) row.bias += (joint.gap_rate - u * u.dot(joint.gap_rate)).squaredNorm() / distance;
  rows.push_back(row);
}

}  // namespace plumbline
