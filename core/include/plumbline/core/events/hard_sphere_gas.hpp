// A gas of equal elastic hard spheres in a periodic box, event by event: the fast path for many thousand bodies.
//
// Between collisions the spheres fly straight, so nothing needs a time step (course slide 24, the simple motion
// simulator): the next collision is found from a quadratic equation, everything is exact up to it, the two spheres
// exchange their velocities along the line of centres, and only what involves these two is predicted anew. The rules
// are those of Alder and Wainwright, J. Chem. Phys. 31 (1959) 459. What makes it fast is bookkeeping alone:
//
//   one event a sphere    its earliest collision and with whom (Lubachevsky, J. Comput. Phys. 94 (1991) 255)
//   own clocks            a sphere is moved when something happens to it, never to keep the others company
//   cells                 a little wider than one diameter: whoever can be hit next is in one of 27
//   a calendar            events in buckets of time (Brown, Commun. ACM 31 (1988) 1220; Paul, J. Comput. Phys. 221
//                         (2007) 615): insert, move and take out at a cost that does not depend on their number
//
// The cost of a collision hardly depends on the number of spheres (docs/benchmarks.md).
//
// Units: SI [m, m/s, s]; since only ratios matter, a diameter of 1 and a mean square velocity of 3 (kT/m = 1) are just
// as good. The mass, equal for all, drops out.
//
// Range of validity: box edges of at least 4 diameters, and fluid to solid density: memory and time go with the
// number of cells, which is about the volume over the diameter cubed, so that below 5 % of close packing the empty
// cells dominate. Simultaneous collisions of different pairs are taken in the order of the spheres' storage; they do
// not influence each other. Three spheres that touch at one instant are two collisions, one after the other.
//
// Accuracy: collision times and positions carry the rounding of a few cell widths, however long the run: positions
// are kept relative to the cell, times relative to a clock that is set back again and again. Energy is kept to
// rounding at each collision. Like every gas of hard spheres it is chaotic: two codes, or two roundings, agree on the
// sequence of collisions only for some tens of collisions a sphere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "plumbline/core/spatial.hpp"

namespace plumbline {

// Who met whom, and when. `a` and `b` number the spheres as the constructor was given them.
struct HardSphereCollision {
  double time;  // since the start [s]
  std::size_t a, b;
};

struct HardSphereStatistics {
  std::uint64_t collisions = 0;
  std::uint64_t predictions = 0;  // searches through all 27 cells around a sphere
  std::uint64_t crossings = 0;    // of a sphere from cell to cell
  double virial = 0;              // sum over the collisions of |r_ab . v_ab|, diameter times speed of approach [m^2/s]
  double contact_error = 0;       // largest | |r_ab| - diameter | / diameter at a collision
};

class HardSphereGas {
 public:
  // Centres [m] (anywhere: the box repeats), velocities [m/s], diameter [m], edges of the box [m].
  // Throws std::invalid_argument for lists of different length, numbers that are not finite, a diameter that is not
  // > 0, edges below 4 diameters, and spheres that overlap by more than 1e-9 of the diameter.
  HardSphereGas(std::span<const Vec3> positions, std::span<const Vec3> velocities, double diameter, const Vec3& box);
  ~HardSphereGas();
  HardSphereGas(HardSphereGas&&) noexcept;
  HardSphereGas& operator=(HardSphereGas&&) noexcept;

  // Goes on to the next collision and through it.
  // Throws std::runtime_error if there is none within the range of the clock: spheres at rest never collide.
  HardSphereCollision collide_next();
  // The same, that many times.
  void run_events(std::uint64_t collisions);
  // Goes on to the time t >= time() since the start [s]. Stopping in between changes no bit of what follows.
  void run_until(double t);

  double time() const;  // since the start [s]
  std::size_t size() const;
  const HardSphereStatistics& statistics() const;
  // Pressure over that of an ideal gas, Z = p V / (N kT), averaged since the start: the virial theorem gives
  // Z = 1 + sum |r_ab . v_ab| / (N <v^2> t). It is 1 at time 0.
  double compressibility() const;

  // At time(), in the order of the constructor. Positions lie in the box, 0 <= p < edge.
  std::vector<Vec3> positions() const;   // [m]
  std::vector<Vec3> velocities() const;  // [m/s]
  double velocity_square_sum() const;    // twice the kinetic energy of unit masses [m^2/s^2]
  double smallest_gap() const;           // over all pairs of neighbours at time(), in diameters; negative: overlap

 private:
  class Machine;
  std::unique_ptr<Machine> machine_;
};

}  // namespace plumbline
