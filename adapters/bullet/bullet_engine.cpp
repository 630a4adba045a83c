// Bullet behind the door of core/engine.hpp. Compiled twice: btScalar is float or double.
#include <stdexcept>

#include "bullet_conversions.hpp"
#include "bullet_joints.hpp"
#include "bullet_knobs.hpp"
#include "plumbline/core/engine.hpp"

namespace plumbline {
namespace {

class BulletWorld final : public World {
 public:
  BulletWorld(const Scenario& scenario, const BulletRigidKnobs& knobs) {
    btContactSolverInfo& solver = world_.getSolverInfo();
    set_bullet_contact(knobs, collision_, solver);
    solver.m_solverMode = SOLVER_SIMD | (knobs.warm_starting ? SOLVER_USE_WARMSTARTING : 0);
    solver.m_splitImpulse = knobs.split_impulse ? 1 : 0;
    solver.m_splitImpulsePenetrationThreshold = real(knobs.split_impulse_penetration_threshold);
    solver.m_erp = real(knobs.erp);
    solver.m_globalCfm = real(knobs.cfm);
    world_.setGravity(vector(scenario.gravity));
    for (const Body& body : scenario.bodies) add(body, scenario.contact, knobs);
    for (const Joint& joint : scenario.joints) add(joint, knobs);
  }

  ~BulletWorld() override {
    for (const auto& joint : joints_) world_.removeConstraint(joint.get());
    for (const Resident& r : residents_) world_.removeRigidBody(r.body.get());
  }

  void apply(std::span<const Wrench> wrenches) override {
    for (std::size_t i = 0; i < residents_.size(); ++i) {
      residents_[i].body->applyCentralForce(vector(wrenches[i].f_W));
      residents_[i].body->applyTorque(vector(wrenches[i].tau_W));
    }
  }

  // Zero sub-steps at most means one step of exactly dt. Bullet clears the forces at its end.
  void step(double dt) override {
    if (!(dt > 0)) throw std::invalid_argument("dt must be > 0, is " + shortest(dt));
    world_.stepSimulation(real(dt), 0);
    for (const Resident& r : residents_) require_simulated(*r.body);
  }

  void read(std::span<BodyState> states) const override {
    for (std::size_t i = 0; i < residents_.size(); ++i) {
      const btRigidBody& body = *residents_[i].body;
      if (body.isStaticObject()) {
        states[i] = residents_[i].fixed;
        continue;
      }
      states[i].p_WB = vec3(body.getWorldTransform().getOrigin());
      states[i].q_WB = quat(body.getWorldTransform().getRotation());
      states[i].v_WB = vec3(body.getLinearVelocity());
      states[i].w_WB = vec3(body.getAngularVelocity());
    }
  }

 private:
  struct Resident {
    std::unique_ptr<btCollisionShape> shape;
    std::unique_ptr<btRigidBody> body;
    BodyState fixed;  // what read() says of a body that never moves
  };

  void add(const Body& body, const std::optional<ContactMaterial>& contact, const BulletRigidKnobs& knobs) {
    const bool half_space = std::holds_alternative<HalfSpace>(body.shape);
    const bool fixed = body.fixed || half_space;
    Resident r;
    r.shape = bullet_shape(body);
    // Mass 0 is how Bullet says "fixed".
    btRigidBody::btRigidBodyConstructionInfo info(fixed ? real(0) : real(body.mass), nullptr, r.shape.get(),
                                                  fixed ? btVector3(0, 0, 0) : vector(body.inertia));
    info.m_startWorldTransform = bullet_pose(body);
    info.m_linearDamping = real(knobs.linear_damping);
    info.m_angularDamping = real(knobs.angular_damping);
    info.m_linearSleepingThreshold = real(knobs.sleeping_linear_speed);
    info.m_angularSleepingThreshold = real(knobs.sleeping_angular_speed);
    info.m_restitution = contact ? real(contact->restitution) : real(0);
    info.m_friction = contact ? real(contact->friction) : real(0);
    r.body = std::make_unique<btRigidBody>(info);
    r.body->setFlags(knobs.gyroscopic);
    r.body->setContactProcessingThreshold(real(knobs.contact_processing_threshold));
    if (fixed) {
      r.fixed.p_WB = body.initial.p_WB;
      r.fixed.q_WB = body.initial.q_WB;
    } else {
      if (!knobs.sleeping) r.body->setActivationState(DISABLE_DEACTIVATION);
      r.body->setLinearVelocity(vector(body.initial.v_WB));
      r.body->setAngularVelocity(vector(body.initial.w_WB));
    }
    if (contact) {
      world_.addRigidBody(r.body.get());
    } else {
      world_.addRigidBody(r.body.get(), 0, 0);  // in no collision group, looking for none
    }
    residents_.push_back(std::move(r));
  }

  void add(const Joint& joint, const BulletStops& stops) {
    const bool to_world = joint.a == kWorld;
    btRigidBody& a = to_world ? btTypedConstraint::getFixedBody() : *residents_[joint.a].body;
    joints_.push_back(bullet_joint(joint, a, *residents_[joint.b].body, stops));
    // Bullet notes on both bodies that they do not collide. Its fixed body is shared by all worlds and collides with
    // nothing.
    world_.addConstraint(joints_.back().get(), !to_world);
  }

  btDefaultCollisionConfiguration collision_;
  btCollisionDispatcher dispatcher_{&collision_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &collision_};
  std::vector<Resident> residents_;
  std::vector<std::unique_ptr<btTypedConstraint>> joints_;
};

class BulletEngine final : public Engine {
 public:
  BulletEngine() {
    info_.name = kBulletIsDouble ? "bullet-f64" : "bullet-f32";
    info_.library = "Bullet";
    info_.version = std::to_string(btGetVersion() / 100) + "." + std::to_string(btGetVersion() % 100);
    info_.precision = kBulletIsDouble ? Precision::kDouble : Precision::kSingle;
    info_.scheme = "semi-implicit Euler";
    using enum Feature;
    info_.features = {kSpatial,      kForce,      kTorque,      kSphereSphere, kSphereBox,        kSphereHalfSpace,
                      kBoxHalfSpace, kBoxBox,     kRestitution, kFriction,     kBallJoint,        kHinge,
                      kSlider,       kFixedJoint, kJointLoop,   kJointRange,   kJointsAndContact, kCylinderHalfSpace};
    // In single precision the search for the nearest points leaves the normal of a round side two degrees off.
    if (kBulletIsDouble) {
      info_.features.insert(kCylinderCylinder);
      info_.features.insert(kCylinderOther);
    }
    info_.settings = knobs_.rows();
  }

  const EngineInfo& info() const override { return info_; }

  std::unique_ptr<World> create(const Scenario& scenario, const Settings& settings) const override {
    return std::make_unique<BulletWorld>(scenario, knobs_.read(settings));
  }

 private:
  const KnobTable<BulletRigidKnobs> knobs_ = bullet_rigid_knob_table();
  EngineInfo info_;
};

}  // namespace

std::vector<std::unique_ptr<Engine>> make_engines() {
  take_material_of_the_pair();
  std::vector<std::unique_ptr<Engine>> engines;
  engines.push_back(std::make_unique<BulletEngine>());
  return engines;
}

}  // namespace plumbline
