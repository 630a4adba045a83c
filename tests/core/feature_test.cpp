#include "plumbline/core/feature.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinetic_scenes.hpp"
#include "plumbline/core/kinetics/simulator.hpp"

namespace plumbline {
namespace {

using namespace scenes;

Body crate() { return solid("crate", Box{Vec3(1, 1, 1)}, 1, Vec3(0, 0, 2), Vec3::Zero()); }

TEST(Needs, NothingButGravityForABodyThatFallsInThePlane) {
  const Scenario s = free_flight(ball("ball", 1, 1, Vec3::Zero(), Vec3(1, 0, 2)), Vec3(0, 0, -kG), 1);
  EXPECT_TRUE(needs(s).empty()) << needs(s).describe();
}

TEST(Needs, FollowFromForces) {
  Scenario s = free_flight(ball("ball", 1, 1, Vec3::Zero(), Vec3::Zero()), Vec3::Zero(), 1);
  s.forces.push_back({0, [](double, const BodyState&) { return Wrench{}; }, false, false, ""});
  EXPECT_EQ(needs(s), FeatureSet({Feature::kForce}));
  s.forces[0].has_torque = true;
  EXPECT_EQ(needs(s), FeatureSet({Feature::kForce, Feature::kTorque}));
}

TEST(Needs, FollowFromShapesAndContactRules) {
  Scenario s = on_ground(crate(), 0, 0, 1);
  EXPECT_EQ(needs(s), FeatureSet({Feature::kBoxHalfSpace}));
  s.contact->restitution = 0.5;
  s.contact->friction = 0.1;
  EXPECT_EQ(needs(s), FeatureSet({Feature::kBoxHalfSpace, Feature::kRestitution, Feature::kFriction}));
  s.contact = ContactMaterial{};
  s.bodies.push_back(ball("ball", 1, 1, Vec3(3, 0, 3), Vec3::Zero()));
  EXPECT_EQ(needs(s), FeatureSet({Feature::kBoxHalfSpace, Feature::kSphereHalfSpace, Feature::kSphereBox}));
  s.bodies[1] = ball("other", 1, 1, Vec3(0, 0, 3), Vec3::Zero());
  EXPECT_EQ(needs(s), FeatureSet({Feature::kSphereSphere, Feature::kSphereHalfSpace}));
  s.contact.reset();
  EXPECT_TRUE(needs(s).empty());
}

TEST(Needs, FollowFromCylinders) {
  const Quat lying(std::sqrt(0.5), -std::sqrt(0.5), 0, 0);  // its axis along y
  Body log = solid("log", Cylinder{0.2, 1}, 1, Vec3(0, 0, 2), Vec3::Zero());
  EXPECT_TRUE(needs(free_flight(log, Vec3(0, 0, -kG), 1)).contains(Feature::kSpatial)) << "its axis is z";
  log.initial.q_WB = rotation_by(Vec3(0, 0.3, 0)) * lying;
  Scenario s = on_ground(log, 0, 0, 1);
  EXPECT_EQ(needs(s), FeatureSet({Feature::kCylinderHalfSpace}));
  s.bodies.push_back(log);
  EXPECT_EQ(needs(s), FeatureSet({Feature::kCylinderHalfSpace, Feature::kCylinderCylinder}));
  s.bodies[1] = ball("ball", 1, 1, Vec3(3, 0, 3), Vec3::Zero());
  EXPECT_EQ(needs(s), FeatureSet({Feature::kCylinderHalfSpace, Feature::kSphereHalfSpace, Feature::kCylinderOther}));
}

TEST(Needs, FollowFromSprings) {
  Scenario s = free_flight(ball("ball", 1, 1, Vec3(1, 0, 0), Vec3::Zero()), Vec3::Zero(), 1);
  s.springs = {{"spring", kWorld, 0, Vec3::Zero(), Vec3::Zero(), 1, 0, 1}};
  EXPECT_EQ(needs(s), FeatureSet({Feature::kForce})) << "who has no springs is given their force";
  s.springs[0].on_b = Vec3(0.5, 0, 0);
  EXPECT_EQ(needs(s), FeatureSet({Feature::kForce, Feature::kTorque}));
  s.springs[0].on_a = Vec3(0, 1, 0);
  EXPECT_NE(planar_view(s).reason.find("leads out of the plane"), std::string::npos) << planar_view(s).reason;
  s.springs[0].on_b = Vec3(0.5, 1, 0);
  EXPECT_NE(planar_view(s).reason.find("beside the plane"), std::string::npos) << planar_view(s).reason;
}

TEST(Needs, DoNotAskForContactOfBodiesThatNeverMove) {
  Scenario s = on_ground(crate(), 0, 0, 1);
  s.bodies[1].fixed = true;
  EXPECT_TRUE(needs(s).empty()) << needs(s).describe();
}

Scenario two_boxes() {
  Scenario s = free_flight(crate(), Vec3(0, 0, -kG), 1);
  s.bodies.push_back(crate());
  s.bodies[1].name = "other";
  s.bodies[1].initial.p_WB = Vec3(2, 0, 2);
  return s;
}

Joint joint_of(const Scenario& s, JointKind kind, std::size_t a, std::size_t b, const Vec3& anchor, const Vec3& axis) {
  return joint_at(kind, a, b, {s.bodies[0].initial, s.bodies[1].initial}, anchor, axis);
}

TEST(Needs, FollowFromJointsAndTheLoopsTheyClose) {
  Scenario s = two_boxes();
  s.joints = {joint_of(s, JointKind::kHinge, kWorld, 0, Vec3(0, 0, 3), Vec3::UnitY())};
  EXPECT_EQ(needs(s), FeatureSet({Feature::kHinge}));
  s.joints.push_back(joint_of(s, JointKind::kBall, 0, 1, Vec3(1, 0, 2), Vec3::UnitZ()));
  EXPECT_EQ(needs(s), FeatureSet({Feature::kHinge, Feature::kBallJoint}));
  // Two bodies tied to each other and both to the world: a loop over the world.
  s.joints.push_back(joint_of(s, JointKind::kSlider, kWorld, 1, Vec3(2, 0, 2), Vec3::UnitX()));
  EXPECT_EQ(needs(s), FeatureSet({Feature::kHinge, Feature::kBallJoint, Feature::kSlider, Feature::kJointLoop}));
}

TEST(Needs, NameTheLimitsOfAJoint) {
  Scenario s = two_boxes();
  s.joints = {joint_of(s, JointKind::kHinge, kWorld, 0, Vec3(0, 0, 3), Vec3::UnitY())};
  s.joints[0].range = JointRange{-1, 1};
  EXPECT_EQ(needs(s), FeatureSet({Feature::kHinge, Feature::kJointRange}));
}

TEST(Needs, NameContactBesideJointsAndNotThatOfTiedBodies) {
  Scenario s = two_boxes();
  s.contact = ContactMaterial{};
  EXPECT_EQ(needs(s), FeatureSet({Feature::kBoxBox}));
  s.joints = {joint_of(s, JointKind::kFixed, 1, 0, Vec3(1, 0, 2), Vec3::UnitZ())};
  EXPECT_EQ(needs(s), FeatureSet({Feature::kFixedJoint, Feature::kJointsAndContact}));
}

TEST(PlaneOfJoints, IsLeftByAxesAndPullsBesideIt) {
  const auto reason = [](JointKind kind, const Vec3& anchor, const Vec3& axis) {
    Scenario s = two_boxes();
    s.joints = {joint_of(s, kind, kWorld, 0, anchor, axis)};
    s.joints[0].name = "j";
    return planar_view(s).reason;
  };
  EXPECT_EQ(reason(JointKind::kHinge, Vec3(0, 1, 3), Vec3(0, -2, 0)), "");
  EXPECT_EQ(reason(JointKind::kHinge, Vec3(0, 0, 3), Vec3(0, 1, 1e-3)), "the axis of the hinge j is not y");
  EXPECT_EQ(reason(JointKind::kSlider, Vec3(0, 0, 3), Vec3(1, 0, 1)), "");
  EXPECT_EQ(reason(JointKind::kSlider, Vec3(0, 0, 3), Vec3(1, 1e-3, 1)), "the slider j leaves the plane");
  EXPECT_EQ(reason(JointKind::kBall, Vec3(0, 0, 3), Vec3::UnitZ()), "");
  EXPECT_EQ(reason(JointKind::kBall, Vec3(0, 0.1, 3), Vec3::UnitZ()), "the joint j pulls beside the plane of its body");
  EXPECT_EQ(reason(JointKind::kFixed, Vec3(0, 0.1, 3), Vec3::UnitZ()), "");
}

TEST(FeatureSets, SubtractAndDescribe) {
  const FeatureSet need({Feature::kFriction, Feature::kBoxBox}), have({Feature::kFriction});
  EXPECT_EQ(need.without(have).describe(), "contact of a box with a box");
  EXPECT_EQ(need.describe(), "contact of a box with a box, friction");
  EXPECT_TRUE(have.without(need).empty());
  EXPECT_EQ(FeatureSet().describe(), "");
  for (std::size_t k = 0; k < kFeatureCount; ++k) {
    EXPECT_TRUE(FeatureSet::all().contains(static_cast<Feature>(k)));
    EXPECT_FALSE(feature_name(static_cast<Feature>(k)).empty());
  }
}

TEST(FeatureSets, OfTheSimulatorAreWhatItDoesNotRefuse) {
  Scenario s = on_ground(crate(), 0, 0, 1);
  s.bodies.push_back(crate());
  s.bodies.push_back(ball("ball", 1, 1, Vec3(0, 0, 9), Vec3::Zero()));
  EXPECT_TRUE(needs(s).contains(Feature::kBoxBox));
  EXPECT_TRUE(needs(s).contains(Feature::kSphereBox));
  EXPECT_TRUE(needs(s).without(simulator_features()).empty());
  EXPECT_NO_THROW(Simulator(s, Scheme{}));
}

TEST(PlanarView, IsPlanarWhenNothingLeavesThePlane) {
  const Scenario s = on_ground(crate(), 0, 0, 1);
  EXPECT_EQ(planar_view(s).planarity, Planarity::kPlanar);
  EXPECT_EQ(planar_view(s).reason, "");
}

TEST(PlanarView, IsAProjectionWhenMotionAcrossIsUncoupled) {
  Scenario s = free_flight(crate(), Vec3(0, 0, -kG), 1);
  s.bodies[0].initial.v_WB.y() = 3;
  EXPECT_EQ(planar_view(s).planarity, Planarity::kProjection);
  s.bodies[0].initial.v_WB.y() = 0;
  s.gravity.y() = 1;
  EXPECT_EQ(planar_view(s).planarity, Planarity::kProjection);
  s.gravity.y() = 0;
  s.forces.push_back({0,
                      [](double, const BodyState&) {
                        return Wrench{Vec3(0, 1, 0), Vec3::Zero()};
                      },
                      false, false, ""});
  EXPECT_EQ(planar_view(s).planarity, Planarity::kProjection);
  EXPECT_FALSE(needs(s).contains(Feature::kSpatial));
}

TEST(PlanarView, IsSpatialWithTheReason) {
  const auto reason = [](const Scenario& s) {
    const PlanarView view = planar_view(s);
    EXPECT_EQ(view.planarity, Planarity::kSpatial);
    EXPECT_TRUE(needs(s).contains(Feature::kSpatial));
    return view.reason;
  };
  Scenario spins = free_flight(crate(), Vec3::Zero(), 1);
  spins.bodies[0].initial.w_WB.z() = 1;
  EXPECT_NE(reason(spins).find("crate turns about an axis other than y"), std::string::npos);

  Scenario coupled = free_flight(crate(), Vec3::Zero(), 1);
  coupled.forces.push_back({0, [](double, const BodyState&) { return Wrench{}; }, true, false, ""});
  EXPECT_NE(reason(coupled).find("couples"), std::string::npos);

  Scenario inclined = on_ground(crate(), 0, 0, 1);
  inclined.bodies[0].shape = HalfSpace{Vec3(0, 0.6, 0.8)};
  EXPECT_NE(reason(inclined).find("ground is inclined out of the plane"), std::string::npos);

  Scenario across = on_ground(crate(), 0, 0, 1);
  across.bodies[1].initial.v_WB.y() = 1;
  EXPECT_NE(reason(across).find("move along y"), std::string::npos);

  Scenario beside = on_ground(ball("one", 1, 1, Vec3(0, 0, 2), Vec3::Zero()), 0, 0, 1);
  beside.bodies.push_back(ball("two", 1, 1, Vec3(1, 1, 2), Vec3::Zero()));
  EXPECT_NE(reason(beside).find("two touches others outside"), std::string::npos);

  Scenario rod = free_flight(ball("bob", 1, 1, Vec3(3, 0, 0), Vec3::Zero()), Vec3::Zero(), 1);
  rod.joints = {rod_between(kWorld, 0, {rod.bodies[0].initial}, Vec3::Zero(), Vec3(3, 0, 0))};
  EXPECT_EQ(planar_view(rod).planarity, Planarity::kPlanar);
  rod.joints = {rod_between(kWorld, 0, {rod.bodies[0].initial}, Vec3(0, 4, 0), Vec3(3, 0, 0))};
  EXPECT_NE(reason(rod).find("leads out of the plane"), std::string::npos);
}

}  // namespace
}  // namespace plumbline
