// Bodies: shape, mass properties, initial state.
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "plumbline/core/state.hpp"

namespace plumbline {

struct Sphere {
  double radius;  // [m]
};

struct Box {
  Vec3 size;  // full edge lengths along the body axes [m]
};

// Everything on the far side of a plane: the points x with normal . (x - p_WB) <= 0. Always fixed.
struct HalfSpace {
  Vec3 normal;  // outward unit normal, in W
};

// Solid, its axis the z axis of the body, the origin at the centre.
struct Cylinder {
  double radius;  // [m]
  double height;  // along z [m]
};

using Shape = std::variant<Sphere, Box, HalfSpace, Cylinder>;

// "sphere", "box", "half_space", "cylinder": the word that scenario files use.
std::string_view shape_name(const Shape& shape);

struct Body {
  std::string name;
  Shape shape;
  bool fixed = false;           // never moves; mass and inertia are not used
  double mass = 0;              // [kg]
  Vec3 inertia = Vec3::Zero();  // principal moments about the centre of mass along the body axes [kg m^2]
  BodyState initial;
};

// Throws std::invalid_argument, naming the body, when it moves and has no mass > 0.
void require_mass(const Body& body);

// Principal moments [kg m^2] about the centre of mass of a homogeneous solid of that shape and mass [kg]:
// sphere 2/5 m r^2; box m/12 (b^2 + c^2) and its permutations; cylinder m r^2/2 about its axis and m (3 r^2 + h^2)/12
// across. A half-space has none: throws std::invalid_argument.
Vec3 solid_inertia(const Shape& shape, double mass);

// Inertia tensor about the centre of mass expressed in W [kg m^2]: R diag(inertia) R^T.
Mat3 inertia_in_world(const Body& body, const Quat& q_WB);

}  // namespace plumbline
