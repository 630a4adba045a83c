#include "ode_joints.hpp"

#include <stdexcept>

namespace plumbline {
namespace {

Vec3 in_world(dBodyID body, const Vec3& p_body) {
  if (body == nullptr) return p_body;
  dVector3 p;
  dBodyGetRelPointPos(body, p_body.x(), p_body.y(), p_body.z(), p);
  return {p[0], p[1], p[2]};
}

Vec3 direction_in_world(dBodyID body, const Vec3& v_body) {
  dVector3 v;
  dBodyVectorToWorld(body, v_body.x(), v_body.y(), v_body.z(), v);
  return {v[0], v[1], v[2]};
}

dJointID create(dWorldID world, JointKind kind) {
  switch (kind) {
    case JointKind::kBall:
      return dJointCreateBall(world, nullptr);
    case JointKind::kHinge:
      return dJointCreateHinge(world, nullptr);
    case JointKind::kSlider:
      return dJointCreateSlider(world, nullptr);
    case JointKind::kFixed:
      return dJointCreateFixed(world, nullptr);
    case JointKind::kDistance:
      return dJointCreateDBall(world, nullptr);
  }
  throw std::logic_error("a joint of no kind");
}

// With b for the first body ODE's coordinate has our sign and zero. Stops are plastic: no bounce.
template <typename SetParam>
void set_stops(dJointID id, const JointRange& range, double stop_erp, SetParam set) {
  set(id, dParamLoStop, range.low);
  set(id, dParamHiStop, range.high);
  set(id, dParamBounce, 0);
  set(id, dParamStopERP, stop_erp);
}

}  // namespace

void add_ode_joint(dWorldID world, const Joint& joint, dBodyID a, dBodyID b, double stop_erp) {
  const dJointID id = create(world, joint.kind);
  dJointAttach(id, b, a);
  // ODE takes anchors and axes in W and remembers where they are on both bodies.
  const Vec3 p = in_world(b, joint.on_b.anchor), axis = direction_in_world(b, joint.on_b.axis());
  switch (joint.kind) {
    case JointKind::kBall:
      dJointSetBallAnchor(id, p.x(), p.y(), p.z());
      break;
    case JointKind::kHinge:
      dJointSetHingeAnchor(id, p.x(), p.y(), p.z());
      dJointSetHingeAxis(id, axis.x(), axis.y(), axis.z());
      if (joint.range) set_stops(id, *joint.range, stop_erp, dJointSetHingeParam);
      break;
    case JointKind::kSlider:
      dJointSetSliderAxis(id, axis.x(), axis.y(), axis.z());
      if (joint.range) set_stops(id, *joint.range, stop_erp, dJointSetSliderParam);
      break;
    case JointKind::kFixed:
      dJointSetFixed(id);
      break;
    case JointKind::kDistance: {
      const Vec3 q = in_world(a, joint.on_a.anchor);
      dJointSetDBallAnchor1(id, p.x(), p.y(), p.z());
      dJointSetDBallAnchor2(id, q.x(), q.y(), q.z());
      dJointSetDBallDistance(id, joint.length);
      break;
    }
  }
}

}  // namespace plumbline
