// Homogeneous solids: volume, centre of mass and inertia tensor in closed form (course slide 7, step 1).
//
//   solid (frame)                                        volume                along z              across z, about com
//   Sphere, Box: body.hpp, origin at the centre          4/3 pi r^3, a b c     solid_inertia        solid_inertia
//   Cylinder: body.hpp, axis z                           pi r^2 h              m r^2/2              m (3 r^2 + h^2)/12
//   Capsule: cylinder of length h along z with half      pi r^2 h + 4/3 pi r^3 cylinder + 2 half spheres, see below
//     spheres on both ends, origin at the centre
//   Cone: base in z = 0, apex at z = h, com at h/4       pi r^2 h/3            3/10 m r^2           3/80 m (4 r^2 +
//   h^2)
//
// A half sphere has its centre of mass 3/8 r from its flat face, and about that point 83/320 m r^2 across its axis.
// Source: Goldstein, chapter 5, exercises; Beer and Johnston, Dynamics, appendix B. The tests integrate every one.
// Sizes must be finite and > 0 (a capsule may have h = 0), densities and masses too: std::invalid_argument.
#pragma once

#include <variant>

#include "plumbline/core/mass/mass_properties.hpp"

namespace plumbline {

struct Capsule {
  double radius;  // [m]
  double length;  // of the cylinder between the half spheres, along z [m]
};

struct Cone {
  double radius;  // of the base [m]
  double height;  // from base to apex, along z [m]
};

using Solid = std::variant<Sphere, Box, Cylinder, Capsule, Cone>;

double volume(const Solid& solid);                                    // [m^3]
MassProperties solid_of_mass(const Solid& solid, double mass);        // mass in [kg]
MassProperties solid_of_density(const Solid& solid, double density);  // density in [kg/m^3]

}  // namespace plumbline
