// A joint of a scenario as a planar engine knows it: points and one direction in the bodies' own planar axes.
//
// Ball joints and hinges are the same pin in the plane. What would leave the plane does not come here: such scenarios
// are spatial (planar_view).
#pragma once

#include <optional>

#include "plumbline/core/scenario.hpp"

namespace plumbline {

struct PlanarVector {
  double x = 0, z = 0;
};

struct PlanarJoint {
  PlanarVector on_a,
      on_b;           // the anchors, from the centres of mass, in the axes that turn with planar_frame's angle [m]
  PlanarVector axis;  // z axis of a's frame, in a's axes
  double turn = 0;    // angle of b less that of a, at the start [rad]
  double sense = 1;  // of the engine's angle of b less that of a and less `turn`, as a multiple of a hinge's coordinate
  // Of that angle, or of the travel along `axis`.
  std::optional<JointRange> range;
};

PlanarJoint planar_joint(const Scenario& scenario, const Joint& joint);

// The ends of a spring, as the anchors of a joint.
struct PlanarSpring {
  PlanarVector on_a, on_b;
};

PlanarSpring planar_spring(const Scenario& scenario, const Spring& spring);

}  // namespace plumbline
