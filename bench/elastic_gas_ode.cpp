// ODE: sweep and prune, QuickStep with 20 sweeps; bounce 1 at every speed, no friction.
#include <ode/ode.h>

#include <vector>

#include "elastic_gas_peer.hpp"

namespace plumbline::bench {
namespace {

class OdeGas final : public GasWorld {
 public:
  explicit OdeGas(const SphereBoxScene& scene) {
    dInitODE2(0);
    world_ = dWorldCreate();
    space_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
    contacts_ = dJointGroupCreate(0);
    const Vec3 middle = 0.5 * (scene.lower_W + scene.upper_W), half = 0.5 * (scene.upper_W - scene.lower_W);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 size = 2 * half + Vec3::Constant(4 * kHalfWall);
      size[axis] = 2 * kHalfWall;
      for (const double side : {-1.0, 1.0}) {
        const Vec3 p = middle + side * (half[axis] + kHalfWall) * Vec3::Unit(axis);
        dGeomSetPosition(dCreateBox(space_, size.x(), size.y(), size.z()), p.x(), p.y(), p.z());
      }
    }
    for (const SteppedSphere& s : scene.spheres) {
      const dBodyID body = dBodyCreate(world_);
      dMass mass;
      dMassSetSphereTotal(&mass, s.mass, s.radius);
      dBodySetMass(body, &mass);
      dGeomSetBody(dCreateSphere(space_, s.radius), body);
      dBodySetPosition(body, s.p_W.x(), s.p_W.y(), s.p_W.z());
      dBodySetLinearVel(body, s.v_W.x(), s.v_W.y(), s.v_W.z());
      bodies_.push_back(body);
    }
  }
  ~OdeGas() override {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
    dCloseODE();
  }

  void step(double dt) override {
    dSpaceCollide(space_, this, &OdeGas::touch);
    dWorldQuickStep(world_, dt);
    dJointGroupEmpty(contacts_);
  }
  void read(std::span<SteppedSphere> spheres) const override {
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      const dReal *p = dBodyGetPosition(bodies_[i]), *v = dBodyGetLinearVel(bodies_[i]);
      spheres[i].p_W = Vec3(p[0], p[1], p[2]);
      spheres[i].v_W = Vec3(v[0], v[1], v[2]);
    }
  }

 private:
  static void touch(void* self, dGeomID a, dGeomID b) {
    auto& gas = *static_cast<OdeGas*>(self);
    if (dGeomGetBody(a) == nullptr && dGeomGetBody(b) == nullptr) return;
    dContact contact = {};
    if (dCollide(a, b, 1, &contact.geom, sizeof(dContact)) == 0) return;
    contact.surface.mode = dContactBounce;
    contact.surface.bounce = 1;
    dJointAttach(dJointCreateContact(gas.world_, gas.contacts_, &contact), dGeomGetBody(a), dGeomGetBody(b));
  }

  dWorldID world_;
  dSpaceID space_;
  dJointGroupID contacts_;
  std::vector<dBodyID> bodies_;
};

}  // namespace

std::unique_ptr<GasWorld> make_ode_gas(const SphereBoxScene& scene) { return std::make_unique<OdeGas>(scene); }

}  // namespace plumbline::bench
