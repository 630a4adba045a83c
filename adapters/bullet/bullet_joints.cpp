#include "bullet_joints.hpp"

#include <cmath>
#include <stdexcept>

#include "bullet_conversions.hpp"

namespace plumbline {
namespace {

btTransform frame(const JointFrame& f) { return btTransform(quaternion(f.attitude), vector(f.anchor)); }

// Bullet's sliders go along x: x of the turned frame is z of the stated one, by a third of a turn about (-1, -1, -1).
btTransform sliding_frame(const JointFrame& f) {
  const Quat third_turn(0.5, -0.5, -0.5, -0.5);
  return btTransform(quaternion(f.attitude * third_turn), vector(f.anchor));
}

std::unique_ptr<btTypedConstraint> hinge(const Joint& joint, btRigidBody& a, btRigidBody& b, const BulletStops& stops) {
  auto hinge = std::make_unique<btHingeConstraint>(a, b, frame(joint.on_a), frame(joint.on_b));
  if (joint.range) {
    // Bullet counts the angle of a about b. The softness, here its own 0.9, is read nowhere.
    hinge->setLimit(real(-joint.range->high), real(-joint.range->low), real(0.9), real(stops.hinge_stop_bias),
                    real(stops.hinge_stop_bounce));
    hinge->setParam(BT_CONSTRAINT_STOP_ERP, real(stops.stop_erp));
  }
  return hinge;
}

std::unique_ptr<btTypedConstraint> slider(const Joint& joint, btRigidBody& a, btRigidBody& b,
                                          const BulletStops& stops) {
  auto slider = std::make_unique<btSliderConstraint>(a, b, sliding_frame(joint.on_a), sliding_frame(joint.on_b), true);
  // No bounds on the travel: a lower one above the upper one. No rotation.
  slider->setLowerLinLimit(1);
  slider->setUpperLinLimit(-1);
  slider->setLowerAngLimit(0);
  slider->setUpperAngLimit(0);
  if (joint.range) {
    slider->setLowerLinLimit(real(joint.range->low));
    slider->setUpperLinLimit(real(joint.range->high));
    // What is set here also multiplies the correction as a softness: its square is what acts.
    slider->setParam(BT_CONSTRAINT_STOP_ERP, real(std::sqrt(stops.stop_erp)), 0);
  }
  return slider;
}

}  // namespace

std::unique_ptr<btTypedConstraint> bullet_joint(const Joint& joint, btRigidBody& a, btRigidBody& b,
                                                const BulletStops& stops) {
  switch (joint.kind) {
    case JointKind::kBall:
      return std::make_unique<btPoint2PointConstraint>(a, b, vector(joint.on_a.anchor), vector(joint.on_b.anchor));
    case JointKind::kHinge:
      return hinge(joint, a, b, stops);
    case JointKind::kSlider:
      return slider(joint, a, b, stops);
    case JointKind::kFixed:
      return std::make_unique<btFixedConstraint>(a, b, frame(joint.on_a), frame(joint.on_b));
    case JointKind::kDistance:
      break;
  }
  throw std::invalid_argument("Bullet has no joint that keeps a distance");
}

}  // namespace plumbline
