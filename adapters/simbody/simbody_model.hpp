// A scenario as a Simbody system: bodies, joints, gravity and outer forces. What the two rows share; contact is theirs.
#pragma once

// Simbody's headers are C++11. They compare two index numbers of one kind through conversions to int, which C++20 finds
// ambiguous unless there is a comparison that fits better. So this header comes before any of Simbody's.
namespace SimTK {
template <typename Index>
requires requires(const Index& i) { i.isValidExtended(); }
bool operator==(const Index& a, const Index& b) { return int{a} == int{b}; }
}  // namespace SimTK

#include <simbody/internal/Force_BuiltIns.h>
#include <simbody/internal/Force_DiscreteForces.h>
#include <simbody/internal/GeneralForceSubsystem.h>
#include <simbody/internal/MobilizedBody_BuiltIns.h>
#include <simbody/internal/MultibodySystem.h>
#include <simbody/internal/SimbodyMatterSubsystem.h>

#include "plumbline/core/scenario.hpp"

namespace plumbline {

inline SimTK::Vec3 simbody_vector(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
SimTK::Rotation simbody_rotation(const Quat& q);
std::string simbody_version();  // as the library tells it

class SimbodyModel {
 public:
  explicit SimbodyModel(const Scenario& scenario);

  // Joints that close a loop, and rods, as constraints beside the tree. Not for a stepper that ignores constraints.
  void close_loops(const Scenario& scenario);
  // Call when bodies, contacts and constraints are complete. The state holds the scenario's initial one.
  SimTK::State begin(const Scenario& scenario);

  // Simbody aborts the process on the way back in time. Throws std::invalid_argument.
  static double end_of_step(double now, double dt);
  // Simbody keeps forces until they are changed. Throws std::invalid_argument for one that is not finite.
  void apply(SimTK::State& state, std::span<const Wrench> wrenches) const;
  void read(const SimTK::State& state, std::span<BodyState> states) const;

  const SimTK::MultibodySystem& system() const { return system_; }
  SimTK::MultibodySystem& system() { return system_; }
  SimTK::SimbodyMatterSubsystem& matter() { return matter_; }
  // Ground for a body that is fixed.
  SimTK::MobilizedBody& body(std::size_t i) { return matter_.updMobilizedBody(bodies_[i]); }

 private:
  bool is_fixed(std::size_t i) const { return int{bodies_[i]} == 0; }
  // Disables the constraints when all of them only repeat what the tree holds, as the second hinge of a door does:
  // Simbody finds their forces from a matrix that is nothing but rounding then, and cannot step.
  void drop_void_constraints(SimTK::State& state) const;

  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_{system_};
  SimTK::GeneralForceSubsystem forces_{system_};
  SimTK::Force::DiscreteForces wrenches_{forces_, matter_};
  std::vector<SimTK::MobilizedBodyIndex> bodies_;  // 0, the ground, for a body that is fixed
  bool loops_closed_ = false;                      // by joints, without a rod
  std::vector<BodyState> fixed_;                   // what read() says of bodies that never move
};

}  // namespace plumbline
