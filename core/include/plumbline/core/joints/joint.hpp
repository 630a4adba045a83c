// Joints between rigid bodies: ball, hinge, slider, fixed and distance, as plain values (course slides 32 and 35).
//
// A joint ties a body B to a body A, or to the world. On each of the two it has a frame: an anchor and three axes
// x, y, z that are fixed to that body. What the joint demands of the two frames:
//
//   ball      the anchors coincide                                         3 numbers held, 3 free
//   hinge     the anchors coincide, and so do the z axes                   5 held; free: the angle about z
//   slider    the axes coincide, B's anchor lies on the z axis of A        5 held; free: the travel along z
//   fixed     anchors and axes coincide                                    6 held
//   distance  the anchors keep their distance, as if a rod without mass     1 held
//             with a ball joint at either end tied them
//
// Conventions: body frames have their origin at the centre of mass, as BodyState has. Angles in [rad], lengths in [m].
// Source: Featherstone, Rigid Body Dynamics Algorithms, 2008, section 4.4; Goldstein, Classical Mechanics, section 1.3.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plumbline/core/state.hpp"

namespace plumbline {

// Stands where the number of a body would, for a joint to the world, whose frame is W.
inline constexpr std::size_t kWorld = std::numeric_limits<std::size_t>::max();

struct JointFrame {
  Vec3 anchor = Vec3::Zero();        // in body axes, from the centre of mass [m]
  Quat attitude = Quat::Identity();  // x_body = attitude * x_frame, unit
  Vec3 axis() const { return attitude * Vec3::UnitZ(); }
};

// The frame at that anchor whose z axis is `axis`, any length but 0; x is the shortest turn's. Two frames made from
// directions that are parallel in the starting pose need not agree about x: give attitudes where the angle matters.
JointFrame frame_along(const Vec3& anchor, const Vec3& axis);

enum class JointKind { kBall, kHinge, kSlider, kFixed, kDistance };

// "ball", "hinge", "slider", "fixed", "distance": the word that scenario files use.
std::string_view joint_name(JointKind kind);

// Bounds of the joint's coordinate (joint_equations.hpp): the angle of a hinge, within (-pi, pi); the travel of a
// slider; the angle between the two z axes of a ball joint, whose lower bound must be 0.
struct JointRange {
  double low = 0;
  double high = 0;
};

struct Joint {
  JointKind kind = JointKind::kBall;
  std::size_t a = kWorld;  // parent
  std::size_t b = 0;       // child, never the world
  JointFrame on_a, on_b;
  std::optional<JointRange> range;
  double length = 0;  // of a distance joint's rod, > 0 [m]
  std::string name;   // for people; may be empty
};

// The joint of that kind that holds where the bodies stand now: anchor and z axis are given in W, and the coordinate is
// 0 there. `axis_W` is not used by ball joints without a range, nor by fixed ones. Throws std::invalid_argument for an
// axis of length 0.
Joint joint_at(JointKind kind, std::size_t a, std::size_t b, const std::vector<BodyState>& states, const Vec3& anchor_W,
               const Vec3& axis_W = Vec3::UnitZ());

// The distance joint that holds where the bodies stand now, between a point of A and a point of B, both given in W.
// Throws std::invalid_argument when they are the same point: a rod needs a length.
Joint rod_between(std::size_t a, std::size_t b, const std::vector<BodyState>& states, const Vec3& end_a_W,
                  const Vec3& end_b_W);

// The same joint seen from its other body: a and b change places. Not for joints to the world.
Joint reversed(const Joint& joint);

struct BodyInertia {
  double mass = 0;                // [kg]
  Mat3 inertia_B = Mat3::Zero();  // about the centre of mass, in body axes [kg m^2]
};

// Bodies and what ties them. Loops, redundant joints and several separate groups are allowed.
struct ArticulatedBody {
  std::vector<BodyInertia> bodies;
  std::vector<Joint> joints;
  Vec3 gravity_W = Vec3::Zero();  // [m/s^2]
};

// Throws std::invalid_argument, naming body or joint and the way out: masses that are not > 0, inertias that are not
// positive definite, joints of bodies that do not exist or of one body with itself, frames that are not unit, ranges
// that are empty or that the kind cannot have.
void require_valid(const ArticulatedBody& body);

// Mechanical energy [J]: sum of m v^2/2 + w.I w/2 - m g.p. Linear momentum [kg m/s]; angular momentum about the origin
// of W [kg m^2/s].
double mechanical_energy(const ArticulatedBody& body, const std::vector<BodyState>& states);
Vec3 linear_momentum(const ArticulatedBody& body, const std::vector<BodyState>& states);
Vec3 angular_momentum(const ArticulatedBody& body, const std::vector<BodyState>& states);

}  // namespace plumbline
