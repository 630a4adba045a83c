// Initial states of the hard-sphere gas: a crystal that melts.
//
// Units of the literature: mass m = 1, diameter sigma = 1, thermal energy kT = 1; so a velocity component has the
// variance 1 and a time unit is sigma sqrt(m/kT).
#pragma once

#include <cstdint>
#include <vector>

#include "plumbline/core/spatial.hpp"

namespace plumbline {

// Equal spheres in a cube whose opposite faces are the same face (a periodic box).
struct HardSphereState {
  std::vector<Vec3> positions;   // of the centres, each in [0, box_length)^3 [m]
  std::vector<Vec3> velocities;  // [m/s]
  double diameter = 1;           // [m]
  double box_length = 0;         // edge of the cube [m]
};

// 4 cells^3 spheres of diameter 1 on a face-centred cubic lattice of number density `density` = n sigma^3 / L^3, with
// velocities of the Maxwell distribution, shifted to total momentum 0 and scaled to kT = 1: sum m v^2 = 3 (n - 1) kT.
// (n - 1, since three of the 3 n velocities are used up by the momentum; then the mean square of the relative velocity
// of two spheres is 6 kT/m, as in the infinite system, and the collision rate has no such correction of order 1/n.)
// The same seed gives the same state on every platform up to the rounding of log and cos.
// A crystal is not a fluid: let it melt for some ten collisions per sphere before anything is measured.
// Throws std::invalid_argument unless cells >= 2 and 0 < density < sqrt 2, where the spheres of the lattice touch.
HardSphereState hard_sphere_crystal(int cells, double density, std::uint64_t seed);

}  // namespace plumbline
