// First touches: when, where, and along which normal two moving bodies meet.
#pragma once

#include "plumbline/core/spatial.hpp"

namespace plumbline {

struct Touch {
  double time = 0;                // [s] from the start of the motions
  Vec3 point_W = Vec3::Zero();    // where they touch at that time [m]; one of the points, if they touch along a line or
                                  // on a face
  Vec3 normal_W = Vec3::UnitZ();  // unit, from b to a, as in a Contact: the impulse on a points along it

  bool operator==(const Touch&) const = default;
};

}  // namespace plumbline
