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
    "contact of a cylinder with a half-space",
    "contact of a cylinder with a cylinder",
    "contact of a cylinder with a sphere or a box",
    "restitution",
    "friction",
    "ball joints",
    "hinges",
    "sliders",
    "fixed joints",
    "distance joints",
    "limits of joints",
    "joints that close a loop",
    "contact besides joints",
    "springs",
    "springs of joints",
};

bool turns_only_about_y(const Body& body) {
  const BodyState& s = body.initial;
  const bool spins_in_plane = s.w_WB.x() == 0 && s.w_WB.z() == 0;
  if (std::holds_alternative<Sphere>(body.shape)) return spins_in_plane;  // a ball's attitude does not matter
  if (std::holds_alternative<Cylinder>(body.shape)) {
    // A disc in the plane: its axis is y. Rounding of an attitude that was written as sqrt(1/2).
    constexpr double kRounding = 1e-12;
    return spins_in_plane && (s.q_WB * Vec3::UnitZ()).cross(Vec3::UnitY()).norm() <= kRounding;
  }
  return spins_in_plane && s.q_WB.x() == 0 && s.q_WB.z() == 0;
}

bool is_half_space(const Body& b) { return std::holds_alternative<HalfSpace>(b.shape); }

// The contact feature of two shapes; a pair of half-spaces never moves and needs none.
void insert_contact(FeatureSet& set, const Body& a, const Body& b) {
  if (is_half_space(a) && is_half_space(b)) return;
  const bool cylinder_a = std::holds_alternative<Cylinder>(a.shape);
  if (cylinder_a || std::holds_alternative<Cylinder>(b.shape)) {
    const Shape& other = cylinder_a ? b.shape : a.shape;
    set.insert(std::holds_alternative<HalfSpace>(other)  ? Feature::kCylinderHalfSpace
               : std::holds_alternative<Cylinder>(other) ? Feature::kCylinderCylinder
                                                         : Feature::kCylinderOther);
    return;
  }
  const bool sphere_a = std::holds_alternative<Sphere>(a.shape), sphere_b = std::holds_alternative<Sphere>(b.shape);
  if (is_half_space(a) || is_half_space(b)) {
    set.insert((is_half_space(a) ? sphere_b : sphere_a) ? Feature::kSphereHalfSpace : Feature::kBoxHalfSpace);
  } else if (sphere_a && sphere_b) {
    set.insert(Feature::kSphereSphere);
  } else {
    set.insert(sphere_a || sphere_b ? Feature::kSphereBox : Feature::kBoxBox);
  }
}

Feature joint_feature(JointKind kind) {
  switch (kind) {
    case JointKind::kBall:
      return Feature::kBallJoint;
    case JointKind::kHinge:
      return Feature::kHinge;
    case JointKind::kSlider:
      return Feature::kSlider;
    case JointKind::kFixed:
      return Feature::kFixedJoint;
    case JointKind::kDistance:
      return Feature::kDistanceJoint;
  }
  return Feature::kCount;
}

// What keeps the joints from being those of a plane mechanism; empty when nothing does.
std::string out_of_plane(const Scenario& scenario, const Joint& joint) {
  const auto in_W = [&](std::size_t body, const Vec3& v) {
    return body == kWorld ? v : Vec3(scenario.bodies[body].initial.q_WB * v);
  };
  // Rounding of a direction that was turned to a body's axes and back.
  constexpr double kRounding = 1e-12;
  const Vec3 axis_W = in_W(joint.b, joint.on_b.axis());
  if (joint.kind == JointKind::kHinge && axis_W.cross(Vec3::UnitY()).norm() > kRounding) {
    return "the axis of the hinge " + joint.name + " is not y";
  }
  if (joint.kind == JointKind::kSlider && std::abs(axis_W.y()) > kRounding) {
    return "the slider " + joint.name + " leaves the plane";
  }
  // A force beside the centre of mass, along y, would turn the body out of the plane unless the joint itself prevents
  // it.
  const bool beside = std::abs(in_W(joint.b, joint.on_b.anchor).y()) > kRounding ||
                      (joint.a != kWorld && std::abs(in_W(joint.a, joint.on_a.anchor).y()) > kRounding);
  if ((joint.kind == JointKind::kBall || joint.kind == JointKind::kDistance) && beside) {
    return "the joint " + joint.name + " pulls beside the plane of its body";
  }
  const auto y_of_end = [&](std::size_t body, const Vec3& anchor) {
    return in_W(body, anchor).y() + (body == kWorld ? 0 : scenario.bodies[body].initial.p_WB.y());
  };
  if (joint.kind == JointKind::kDistance &&
      std::abs(y_of_end(joint.b, joint.on_b.anchor) - y_of_end(joint.a, joint.on_a.anchor)) > kRounding) {
    return "the rod " + joint.name + " leads out of the plane";
  }
  return "";
}

// What keeps a spring from pulling within the plane; empty when nothing does.
std::string out_of_plane(const Scenario& scenario, const Spring& spring) {
  constexpr double kRounding = 1e-12;
  const auto arm_y = [&](std::size_t body, const Vec3& on_body) {
    return body == kWorld ? 0.0 : (scenario.bodies[body].initial.q_WB * on_body).y();
  };
  const auto end_y = [&](std::size_t body, const Vec3& on_body) {
    return body == kWorld ? on_body.y() : arm_y(body, on_body) + scenario.bodies[body].initial.p_WB.y();
  };
  if (std::abs(arm_y(spring.a, spring.on_a)) > kRounding || std::abs(arm_y(spring.b, spring.on_b)) > kRounding) {
    return "the spring " + spring.name + " pulls beside the plane of its body";
  }
  if (std::abs(end_y(spring.a, spring.on_a) - end_y(spring.b, spring.on_b)) > kRounding) {
    return "the spring " + spring.name + " leads out of the plane";
  }
  return "";
}

// Every joint ties two groups of bodies to one, unless they were one before.
bool joints_close_a_loop(const Scenario& scenario) {
  const std::size_t world = scenario.bodies.size();
  std::vector<std::size_t> group(world + 1);
  for (std::size_t i = 0; i < group.size(); ++i) group[i] = i;
  for (const Joint& joint : scenario.joints) {
    const std::size_t a = group[joint.a == kWorld ? world : joint.a], b = group[joint.b];
    if (a == b) return true;
    for (std::size_t& g : group) {
      if (g == b) g = a;
    }
  }
  return false;
}

}  // namespace

std::string_view feature_name(Feature feature) { return kNames[static_cast<std::size_t>(feature)]; }

FeatureSet FeatureSet::all() {
  FeatureSet set;
  set.bits_.set();
  return set;
}

FeatureSet FeatureSet::joints() {
  return {Feature::kBallJoint,  Feature::kHinge,         Feature::kSlider,
          Feature::kFixedJoint, Feature::kDistanceJoint, Feature::kJointLoop};
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
  for (const Joint& joint : scenario.joints) {
    if (std::string reason = out_of_plane(scenario, joint); !reason.empty()) return spatial(std::move(reason));
  }
  for (const Spring& spring : scenario.springs) {
    if (std::string reason = out_of_plane(scenario, spring); !reason.empty()) return spatial(std::move(reason));
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
  if (!scenario.joints.empty()) return spatial("bodies that joints hold move along y");
  if (!scenario.springs.empty()) return spatial("bodies that springs pull move along y");
  return {Planarity::kProjection, ""};
}

FeatureSet needs(const Scenario& scenario) {
  FeatureSet set;
  if (planar_view(scenario).planarity == Planarity::kSpatial) set.insert(Feature::kSpatial);
  for (const ForceLaw& law : scenario.forces) {
    set.insert(Feature::kForce);
    if (law.has_torque) set.insert(Feature::kTorque);
  }
  for (const Spring& spring : scenario.springs) {
    set.insert(Feature::kForce);
    if (!spring.on_b.isZero(0) || (spring.a != kWorld && !spring.on_a.isZero(0))) set.insert(Feature::kTorque);
  }
  if (!scenario.joint_springs.empty() || !scenario.drives.empty()) {
    set.insert(Feature::kForce);
    set.insert(Feature::kTorque);
  }
  if (scenario.contact) {
    for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
      for (std::size_t j = i + 1; j < scenario.bodies.size(); ++j) {
        if ((scenario.bodies[i].fixed && scenario.bodies[j].fixed) || joined(scenario, i, j)) continue;
        insert_contact(set, scenario.bodies[i], scenario.bodies[j]);
      }
    }
    if (scenario.contact->restitution > 0) set.insert(Feature::kRestitution);
    if (scenario.contact->friction > 0) set.insert(Feature::kFriction);
    if (!scenario.joints.empty()) set.insert(Feature::kJointsAndContact);
  }
  for (const Joint& joint : scenario.joints) {
    set.insert(joint_feature(joint.kind));
    if (joint.range) set.insert(Feature::kJointRange);
  }
  if (joints_close_a_loop(scenario)) set.insert(Feature::kJointLoop);
  return set;
}

}  // namespace plumbline
