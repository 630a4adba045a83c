#include "plumbline/core/feature.hpp"

#include <cmath>

namespace plumbline {
namespace {

constexpr std::string_view kNames[kFeatureCount] = {
    "three dimensions",
    "external forces",
    "external torques",
    "contact of a sphere with a sphere",
    "contact of a sphere with a half-space",
    "contact of a sphere with a box",
    "contact of a box with a half-space",
    "contact of a box with a box",
    "restitution",
    "friction",
};

bool turns_only_about_y(const Body& body) {
  const BodyState& s = body.initial;
  const bool spins_in_plane = s.w_WB.x() == 0 && s.w_WB.z() == 0;
  if (std::holds_alternative<Sphere>(body.shape)) return spins_in_plane;  // a ball's attitude does not matter
  return spins_in_plane && s.q_WB.x() == 0 && s.q_WB.z() == 0;
}

bool is_half_space(const Body& b) { return std::holds_alternative<HalfSpace>(b.shape); }

// The contact feature of two shapes; a pair of half-spaces never moves and needs none.
void insert_contact(FeatureSet& set, const Body& a, const Body& b) {
  if (is_half_space(a) && is_half_space(b)) return;
  const bool sphere_a = std::holds_alternative<Sphere>(a.shape), sphere_b = std::holds_alternative<Sphere>(b.shape);
  if (is_half_space(a) || is_half_space(b)) {
    set.insert((is_half_space(a) ? sphere_b : sphere_a) ? Feature::kSphereHalfSpace : Feature::kBoxHalfSpace);
  } else if (sphere_a && sphere_b) {
    set.insert(Feature::kSphereSphere);
  } else {
    set.insert(sphere_a || sphere_b ? Feature::kSphereBox : Feature::kBoxBox);
  }
}

}  // namespace

std::string_view feature_name(Feature feature) { return kNames[static_cast<std::size_t>(feature)]; }

FeatureSet FeatureSet::all() {
  FeatureSet set;
  set.bits_.set();
  return set;
}

FeatureSet FeatureSet::without(const FeatureSet& other) const {
  FeatureSet set;
  set.bits_ = bits_ & ~other.bits_;
  return set;
}

std::string FeatureSet::describe() const {
  std::string text;
  for (std::size_t i = 0; i < kFeatureCount; ++i) {
    if (!bits_.test(i)) continue;
    if (!text.empty()) text += ", ";
    text += kNames[i];
  }
  return text;
}

PlanarView planar_view(const Scenario& scenario) {
  const auto spatial = [](std::string reason) { return PlanarView{Planarity::kSpatial, std::move(reason)}; };
  bool leaves_plane = scenario.gravity.y() != 0;
  double y0 = 0;
  bool have_y0 = false;
  for (const Body& body : scenario.bodies) {
    if (const auto* half = std::get_if<HalfSpace>(&body.shape)) {
      if (scenario.contact && half->normal.y() != 0)
        return spatial("the surface of " + body.name + " is inclined out of the plane");
      continue;
    }
    if (!turns_only_about_y(body)) return spatial(body.name + " turns about an axis other than y");
    if (body.initial.v_WB.y() != 0) leaves_plane = true;
    if (!have_y0) y0 = body.initial.p_WB.y();
    have_y0 = true;
    if (scenario.contact && body.initial.p_WB.y() != y0)
      return spatial(body.name + " touches others outside its own x-z plane");
  }
  for (const ForceLaw& law : scenario.forces) {
    if (law.couples_out_of_plane)
      return spatial("the force on " + scenario.bodies[law.body].name + " couples the plane to motion along y");
  }
  // Forces along y are found by evaluating them: a law that does not couple may still push out of the plane.
  for (const ForceLaw& law : scenario.forces) {
    if (law.evaluate(0, scenario.bodies[law.body].initial).f_W.y() != 0) leaves_plane = true;
  }
  if (!leaves_plane) return {Planarity::kPlanar, ""};
  if (scenario.contact) return spatial("bodies that may touch move along y");
  return {Planarity::kProjection, ""};
}

FeatureSet needs(const Scenario& scenario) {
  FeatureSet set;
  if (planar_view(scenario).planarity == Planarity::kSpatial) set.insert(Feature::kSpatial);
  for (const ForceLaw& law : scenario.forces) {
    set.insert(Feature::kForce);
    if (law.has_torque) set.insert(Feature::kTorque);
  }
  if (scenario.contact) {
    for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
      for (std::size_t j = i + 1; j < scenario.bodies.size(); ++j) {
        if (scenario.bodies[i].fixed && scenario.bodies[j].fixed) continue;
        insert_contact(set, scenario.bodies[i], scenario.bodies[j]);
      }
    }
    if (scenario.contact->restitution > 0) set.insert(Feature::kRestitution);
    if (scenario.contact->friction > 0) set.insert(Feature::kFriction);
  }
  return set;
}

}  // namespace plumbline
