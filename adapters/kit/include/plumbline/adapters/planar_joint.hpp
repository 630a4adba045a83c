// A joint of a scenario as a planar engine knows it: points and one direction in the bodies' own planar axes.
//
// Ball joints and hinges are the same pin in the plane. What would leave the plane does not come here: such scenarios
// are spatial (planar_view).
#pragma once

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
};

PlanarJoint planar_joint(const Scenario& scenario, const Joint& joint);

}  // namespace plumbline
