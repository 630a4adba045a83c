// Obstacles: fixed solids that particles and links must stay out of (course slides 32 and 35).
//
// Both functions give a signed distance [m], negative inside, and the unit normal n along which moving away gains most:
// moved by -distance along n, whatever was inside just touches.
//
//   sphere      |p - c| - R; the nearest point of a link to c
//   half-space  n . (p - p0); the deeper end of a link
//   box         a point inside leaves through the nearest face; outside, the distance to the nearest point of the box.
//               A link is measured along the separating axes of segment and box, 3 face normals and 3 cross products
//               of the link with the edges (Gottschalk, Lin, Manocha, SIGGRAPH 1996): inside, the largest of these
//               signed gaps is the exact depth; outside it is a lower bound of the distance, positive if and only if
//               the two do not touch.
#pragma once

#include "plumbline/core/body.hpp"

namespace plumbline {

struct Obstacle {
  Shape shape;
  Vec3 p_WO = Vec3::Zero();      // centre of sphere and box; a point of the surface of a half-space
  Quat q_WO = Quat::Identity();  // attitude of a box
};

struct PointGap {
  double distance;  // [m]
  Vec3 normal_W;    // d(distance)/dp; at the centre of a sphere, where there is none, the z axis
};
PointGap gap_to_point(const Obstacle& obstacle, const Vec3& p_W);

struct LinkGap {
  double distance;  // [m]
  Vec3 normal_W;
  double s;  // where on the link, a (1 - s) + b s: 0 to 1; the middle when all of a link lies equally deep
};
LinkGap gap_to_link(const Obstacle& obstacle, const Vec3& a_W, const Vec3& b_W);

}  // namespace plumbline
