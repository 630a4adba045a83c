// Many thousand spheres in a box, step by step: the fast path of the time-stepping simulator.
//
// One step of dt takes the state (p, v) through what Simulator does under {kSemiImplicitEuler, kStepStart}:
//
//   v <- v + g dt                          the force first, as most engines do (scheme.hpp)
//   impulses where spheres touch or overlap each other or a wall, and approach
//   p <- p + v dt                          the velocity after the impulses
//
// An impact inside a step is noticed at the next one, and overlap is never pushed out: what a sphere has sunk in when
// the impact is noticed, it comes out of by itself. Two spheres that approach at u = -(v_a - v_b).n get the impulse
// (1 + e) u / (1/m_a + 1/m_b) along the line of centres n (course slides 19-23); a wall counts as infinitely heavy.
// There is no friction, so that spin never changes; it is left out.
//
// Resting. The same rule as the simulator's: an approach to a wall that one step of gravity explains, u <= 2 |g_n| dt,
// has e = 0.
//
// Where it differs from Simulator: several contacts of one body in one step get their impulses one after the other,
// each with the velocities that the one before has left, and not all at once. With e = 1 each of these keeps the
// energy. Where no body has two contacts at once, both give the same states to rounding.
//
// The cost of a step is proportional to the number of spheres: they are sorted into the cells of a grid at every step
// (counting sort), and since they hardly move within one, each cell's spheres and those of its neighbours stay
// together in memory. Cells must hold the largest sphere, so that a few large ones among many small ones make it slow.
// Green, "Particle simulation using CUDA", NVIDIA (2010), has the grid for graphics processors.
//
// Not for piles: nothing pushes overlap out, and under gravity spheres that lie on each other sink into each other.
//
// Range of validity: v dt well below the radius for all, or spheres pass through each other unseen; time-stepping
// conserves energy with e = 1, g = 0, but the instants of impact, and so the trajectories, are of first order in dt.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "plumbline/core/spatial.hpp"

namespace plumbline {

struct SteppedSphere {
  Vec3 p_W = Vec3::Zero();  // centre [m]
  Vec3 v_W = Vec3::Zero();  // [m/s]
  double radius = 0;        // [m]
  double mass = 0;          // [kg]
};

struct SphereBoxScene {
  std::vector<SteppedSphere> spheres;
  Vec3 lower_W = Vec3::Zero(), upper_W = Vec3::Zero();  // opposite corners of the box [m]; its six sides are walls
  Vec3 gravity = Vec3::Zero();                          // [m/s^2]
  double restitution = 1;                               // Newton's e in [0, 1], at walls as well
};

class SphereStepper {
 public:
  // Throws std::invalid_argument, naming the sphere, for radii and masses that are not > 0, for numbers that are not
  // finite, centres outside of the box, an empty box and a restitution outside of [0, 1].
  explicit SphereStepper(const SphereBoxScene& scene);

  // Advances by dt > 0 [s]; throws std::invalid_argument for any other dt.
  void step(double dt);

  std::size_t size() const { return number_.size(); }
  std::uint64_t impacts() const { return impacts_; }  // impulses given so far
  double kinetic_energy() const;                      // [J]
  // In the order of the scene, as after the last step.
  std::vector<SteppedSphere> spheres() const;

 private:
  // Structure of arrays: the search for contacts reads coordinates and radii, and little else.
  struct Columns {
    std::vector<double> x, y, z, vx, vy, vz, radius, inverse_mass;
    void resize(std::size_t n);
  };

  void choose_grid(double largest_radius);
  std::size_t cell_of(double x, double y, double z) const;
  void sort_and_kick(double dt);
  void meet_neighbours();
  void meet(std::size_t i, std::size_t first, std::size_t last);
  void meet_walls_and_move(double dt);

  Vec3 lower_, upper_, gravity_;
  double restitution_;
  int cells_[3] = {1, 1, 1};                           // along each axis
  Vec3 per_length_ = Vec3::Zero();                     // cells per unit of length [1/m]
  Columns now_, sorted_;                               // `sorted_` is where the next sorting writes
  std::vector<std::uint32_t> number_, sorted_number_;  // by which the scene knows the sphere
  std::vector<std::uint32_t> cell_;                    // of each sphere
  std::vector<std::uint32_t> begin_;                   // of each cell's spheres, and one more for the end
  std::uint64_t impacts_ = 0;
};

}  // namespace plumbline
