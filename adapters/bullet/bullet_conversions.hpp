// The suite's numbers and shapes as Bullet's. btScalar is float or double: this is compiled once for each.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <stdexcept>

#include "plumbline/core/body.hpp"

namespace plumbline {

inline constexpr bool kBulletIsDouble = sizeof(btScalar) == sizeof(double);

inline btScalar real(double x) { return static_cast<btScalar>(x); }
inline btVector3 vector(const Vec3& v) { return {real(v.x()), real(v.y()), real(v.z())}; }
inline btQuaternion quaternion(const Quat& q) { return {real(q.x()), real(q.y()), real(q.z()), real(q.w())}; }
inline Vec3 vec3(const btVector3& v) { return {double{v.x()}, double{v.y()}, double{v.z()}}; }
inline Quat quat(const btQuaternion& q) {
  return Quat(double{q.w()}, double{q.x()}, double{q.y()}, double{q.z()}).normalized();
}

inline std::unique_ptr<btCollisionShape> bullet_shape(const Body& body) {
  if (const auto* sphere = std::get_if<Sphere>(&body.shape)) {
    return std::make_unique<btSphereShape>(real(sphere->radius));
  }
  if (const auto* box = std::get_if<Box>(&body.shape)) {
    return std::make_unique<btBoxShape>(vector(0.5 * box->size));
  }
  if (const auto* cylinder = std::get_if<Cylinder>(&body.shape)) {
    return std::make_unique<btCylinderShapeZ>(vector(Vec3(cylinder->radius, cylinder->radius, 0.5 * cylinder->height)));
  }
  return std::make_unique<btStaticPlaneShape>(vector(std::get<HalfSpace>(body.shape).normal), real(0));
}

// Where a body that never moves stands. The normal of a half-space is stated in W, whatever the attitude of its body.
inline btTransform bullet_pose(const Body& body) {
  const bool half_space = std::holds_alternative<HalfSpace>(body.shape);
  return btTransform(quaternion(half_space ? Quat(Quat::Identity()) : body.initial.q_WB), vector(body.initial.p_WB));
}

// Bullet takes a body whose bounding box is larger than 1e6 m out of the simulation, and says so on standard output at
// most. A run that went on from there would be a wrong one.
inline void require_simulated(const btCollisionObject& object) {
  if (object.getActivationState() != DISABLE_SIMULATION) return;
  throw std::runtime_error("Bullet took a body out of the simulation: its bounding box is larger than 1e6 m");
}

}  // namespace plumbline
