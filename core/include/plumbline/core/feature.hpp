// What a scenario needs, what an engine offers, and the difference between the two.
#pragma once

#include <array>
#include <bitset>
#include <string>
#include <string_view>

#include "plumbline/core/scenario.hpp"

namespace plumbline {

enum class Feature : std::size_t {
  kSpatial,       // motion in three dimensions
  kForce,         // a force at the centre of mass, new at every step
  kTorque,        // a torque, new at every step
  kSphereSphere,  // contact between two spheres that do not both stand still
  kSphereHalfSpace,
  kSphereBox,
  kBoxHalfSpace,
  kBoxBox,
  kCylinderHalfSpace,
  kCylinderCylinder,
  kCylinderOther,  // with a sphere or a box
  kRestitution,    // e > 0
  kFriction,       // mu > 0
  kBallJoint,
  kHinge,
  kSlider,
  kFixedJoint,
  kDistanceJoint,
  kJointRange,        // limits of a joint's coordinate
  kJointLoop,         // joints that close a loop, over the world or not
  kJointsAndContact,  // joints and contact in one scenario
  // Offered, never needed: force elements that the engine computes itself, within its step. For an engine without them
  // they are evaluated at the start of each step and handed to it as forces (force_element.hpp).
  kSpring,       // springs and dampers between two points
  kJointSpring,  // springs and dampers on the coordinate of a hinge or slider
  kCount,
};
inline constexpr std::size_t kFeatureCount = static_cast<std::size_t>(Feature::kCount);

class FeatureSet {
 public:
  FeatureSet() = default;
  FeatureSet(std::initializer_list<Feature> features) {
    for (Feature f : features) insert(f);
  }
  static FeatureSet all();
  static FeatureSet joints();  // of every kind, loops included
  void insert(Feature f) { bits_.set(static_cast<std::size_t>(f)); }
  bool contains(Feature f) const { return bits_.test(static_cast<std::size_t>(f)); }
  bool empty() const { return bits_.none(); }
  FeatureSet without(const FeatureSet& other) const;
  // "friction, contact of a box with a box"; empty for the empty set.
  std::string describe() const;
  bool operator==(const FeatureSet&) const = default;

 private:
  std::bitset<kFeatureCount> bits_;
};

std::string_view feature_name(Feature feature);

// How a scenario looks to an engine that only knows the x-z plane.
enum class Planarity {
  kPlanar,      // nothing ever leaves the plane
  kProjection,  // there is motion along y, but it does not influence the motion in the plane
  kSpatial,     // truly three-dimensional
};
struct PlanarView {
  Planarity planarity = Planarity::kSpatial;
  std::string reason;  // what couples the plane to the rest; empty unless kSpatial
};
PlanarView planar_view(const Scenario& scenario);

// Derived from bodies, forces and contact rules, never listed by hand. Includes kSpatial only when the planar
// view is kSpatial.
FeatureSet needs(const Scenario& scenario);

}  // namespace plumbline
