// Bullet: dynamic bounding-volume tree, sequential impulses with 10 sweeps; sleeping off, e = 1 at every speed.
#include <btBulletDynamicsCommon.h>

#include <vector>

#include "elastic_gas_peer.hpp"

namespace plumbline::bench {
namespace {

btVector3 vector(const Vec3& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}
Vec3 vec3(const btVector3& v) { return {double{v.x()}, double{v.y()}, double{v.z()}}; }

class BulletGas final : public GasWorld {
 public:
  explicit BulletGas(const SphereBoxScene& scene) {
    world_.setGravity(btVector3(0, 0, 0));
    world_.getSolverInfo().m_restitutionVelocityThreshold = 0;
    const Vec3 middle = 0.5 * (scene.lower_W + scene.upper_W), half = 0.5 * (scene.upper_W - scene.lower_W);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 size = half + Vec3::Constant(2 * kHalfWall);
      size[axis] = kHalfWall;
      shapes_.push_back(std::make_unique<btBoxShape>(vector(size)));
      for (const double side : {-1.0, 1.0}) {
        add(*shapes_.back(), middle + side * (half[axis] + kHalfWall) * Vec3::Unit(axis), Vec3::Zero(), 0);
      }
    }
    walls_ = bodies_.size();
    shapes_.push_back(std::make_unique<btSphereShape>(static_cast<btScalar>(scene.spheres.front().radius)));
    for (const SteppedSphere& s : scene.spheres) add(*shapes_.back(), s.p_W, s.v_W, s.mass);
  }
  ~BulletGas() override {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }

  void step(double dt) override { world_.stepSimulation(static_cast<btScalar>(dt), 0); }
  void read(std::span<SteppedSphere> spheres) const override {
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      spheres[i].p_W = vec3(bodies_[walls_ + i]->getWorldTransform().getOrigin());
      spheres[i].v_W = vec3(bodies_[walls_ + i]->getLinearVelocity());
    }
  }

 private:
  void add(btCollisionShape& shape, const Vec3& p, const Vec3& v, double mass) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(static_cast<btScalar>(mass), inertia);
    btRigidBody::btRigidBodyConstructionInfo info(static_cast<btScalar>(mass), nullptr, &shape, inertia);
    info.m_startWorldTransform = btTransform(btQuaternion::getIdentity(), vector(p));
    info.m_restitution = 1;
    info.m_friction = 0;
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    if (mass > 0) bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
    bodies_.back()->setLinearVelocity(vector(v));
    world_.addRigidBody(bodies_.back().get());
  }

  btDefaultCollisionConfiguration collision_;
  btCollisionDispatcher dispatcher_{&collision_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &collision_};
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::size_t walls_ = 0;
};

}  // namespace

std::unique_ptr<GasWorld> make_bullet_gas(const SphereBoxScene& scene) { return std::make_unique<BulletGas>(scene); }

}  // namespace plumbline::bench
