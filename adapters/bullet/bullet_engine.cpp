// Bullet behind the door of core/engine.hpp. Compiled twice: btScalar is float or double.
#include <btBulletDynamicsCommon.h>

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include <stdexcept>

#include "plumbline/core/engine.hpp"

namespace plumbline {
namespace {

constexpr bool kIsDouble = sizeof(btScalar) == sizeof(double);
// Bullet's own default for "never": BT_LARGE_FLOAT, the same in both precisions.
constexpr double kNever = 1e18;

btScalar real(double x) { return static_cast<btScalar>(x); }
btVector3 vector(const Vec3& v) { return {real(v.x()), real(v.y()), real(v.z())}; }
btQuaternion quaternion(const Quat& q) { return {real(q.x()), real(q.y()), real(q.z()), real(q.w())}; }
Vec3 vec3(const btVector3& v) { return {double{v.x()}, double{v.y()}, double{v.z()}}; }

// Every body carries the coefficients of the pair, so the pair's value is that of either of them; Bullet itself
// would multiply the two.
btScalar pair_restitution(const btCollisionObject* a, const btCollisionObject*) { return a->getRestitution(); }
btScalar pair_friction(const btCollisionObject* a, const btCollisionObject*) { return a->getFriction(); }

int gyroscopic_flags(const std::string& model) {
  if (model == "none") return 0;
  if (model == "explicit") return BT_ENABLE_GYROSCOPIC_FORCE_EXPLICIT;
  if (model == "implicit_world") return BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_WORLD;
  if (model == "implicit_body") return BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY;
  throw std::invalid_argument("setting 'gyroscopic' must be none, explicit, implicit_body or implicit_world");
}

struct Knobs {
  explicit Knobs(const Settings& s)
      : sleeping(setting_bool(s, "sleeping")),
        sleeping_linear_speed(setting_number(s, "sleeping_linear_speed")),
        sleeping_angular_speed(setting_number(s, "sleeping_angular_speed")),
        linear_damping(setting_number(s, "linear_damping")),
        angular_damping(setting_number(s, "angular_damping")),
        gyroscopic(gyroscopic_flags(setting_text(s, "gyroscopic"))),
        solver_iterations(static_cast<int>(setting_number(s, "solver_iterations"))),
        warm_starting(setting_bool(s, "warm_starting")),
        restitution_threshold(setting_number(s, "restitution_threshold")),
        split_impulse(setting_bool(s, "split_impulse")),
        split_impulse_penetration_threshold(setting_number(s, "split_impulse_penetration_threshold")),
        erp2(setting_number(s, "erp2")),
        linear_slop(setting_number(s, "linear_slop")),
        contact_processing_threshold(setting_number(s, "contact_processing_threshold")),
        plane_contact_iterations(static_cast<int>(setting_number(s, "plane_contact_iterations"))) {}

  bool sleeping;
  double sleeping_linear_speed, sleeping_angular_speed, linear_damping, angular_damping;
  int gyroscopic, solver_iterations;
  bool warm_starting;
  double restitution_threshold;
  bool split_impulse;
  double split_impulse_penetration_threshold, erp2, linear_slop, contact_processing_threshold;
  int plane_contact_iterations;
};

std::unique_ptr<btCollisionShape> make_shape(const Body& body) {
  if (const auto* sphere = std::get_if<Sphere>(&body.shape)) {
    return std::make_unique<btSphereShape>(real(sphere->radius));
  }
  if (const auto* box = std::get_if<Box>(&body.shape)) {
    return std::make_unique<btBoxShape>(vector(0.5 * box->size));
  }
  return std::make_unique<btStaticPlaneShape>(vector(std::get<HalfSpace>(body.shape).normal), real(0));
}

class BulletWorld final : public World {
 public:
  BulletWorld(const Scenario& scenario, const Knobs& knobs) {
    if (knobs.plane_contact_iterations > 1) {
      collision_.setPlaneConvexMultipointIterations(knobs.plane_contact_iterations, knobs.plane_contact_iterations);
    }
    btContactSolverInfo& solver = world_.getSolverInfo();
    solver.m_numIterations = knobs.solver_iterations;
    solver.m_solverMode = SOLVER_SIMD | (knobs.warm_starting ? SOLVER_USE_WARMSTARTING : 0);
    solver.m_restitutionVelocityThreshold = real(knobs.restitution_threshold);
    solver.m_splitImpulse = knobs.split_impulse ? 1 : 0;
    solver.m_splitImpulsePenetrationThreshold = real(knobs.split_impulse_penetration_threshold);
    solver.m_erp2 = real(knobs.erp2);
    solver.m_linearSlop = real(knobs.linear_slop);
    world_.setGravity(vector(scenario.gravity));
    for (const Body& body : scenario.bodies) add(body, scenario.contact, knobs);
  }

  ~BulletWorld() override {
    for (const Resident& r : residents_) world_.removeRigidBody(r.body.get());
  }

  void apply(std::span<const Wrench> wrenches) override {
    for (std::size_t i = 0; i < residents_.size(); ++i) {
      residents_[i].body->applyCentralForce(vector(wrenches[i].f_W));
      residents_[i].body->applyTorque(vector(wrenches[i].tau_W));
    }
  }

  // Zero sub-steps at most means one step of exactly dt. Bullet clears the forces at its end.
  void step(double dt) override { world_.stepSimulation(real(dt), 0); }

  void read(std::span<BodyState> states) const override {
    for (std::size_t i = 0; i < residents_.size(); ++i) {
      const btRigidBody& body = *residents_[i].body;
      if (body.isStaticObject()) {
        states[i] = residents_[i].fixed;
        continue;
      }
      const btQuaternion q = body.getWorldTransform().getRotation();
      states[i].p_WB = vec3(body.getWorldTransform().getOrigin());
      states[i].q_WB = Quat(double{q.w()}, double{q.x()}, double{q.y()}, double{q.z()}).normalized();
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

  void add(const Body& body, const std::optional<ContactMaterial>& contact, const Knobs& knobs) {
    const bool half_space = std::holds_alternative<HalfSpace>(body.shape);
    const bool fixed = body.fixed || half_space;
    if (!fixed && !(body.mass > 0 && body.inertia.minCoeff() > 0)) {
      throw std::invalid_argument("body '" + body.name + "' moves, so its mass and inertia must be > 0");
    }
    Resident r;
    r.shape = make_shape(body);
    // Mass 0 is how Bullet says "fixed".
    btRigidBody::btRigidBodyConstructionInfo info(fixed ? real(0) : real(body.mass), nullptr, r.shape.get(),
                                                  fixed ? btVector3(0, 0, 0) : vector(body.inertia));
    // The normal of a half-space is stated in W, whatever the attitude of its body.
    const Quat attitude = half_space ? Quat(Quat::Identity()) : body.initial.q_WB;
    info.m_startWorldTransform = btTransform(quaternion(attitude), vector(body.initial.p_WB));
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

  btDefaultCollisionConfiguration collision_;
  btCollisionDispatcher dispatcher_{&collision_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &collision_};
  std::vector<Resident> residents_;
};

std::vector<Setting> setting_table() {
  return {
      {"sleeping", true, false, "", "stops bodies that have been slow for 2 s; a force on a sleeping body is lost"},
      {"sleeping_linear_speed", 0.8, 0.8, "m/s", "slower than this counts as slow"},
      {"sleeping_angular_speed", 1.0, 1.0, "rad/s", "slower than this counts as slow"},
      {"linear_damping", 0.0, 0.0, "1", "share of the velocity lost per second"},
      {"angular_damping", 0.0, 0.0, "1", "share of the angular velocity lost per second"},
      {"gyroscopic", std::string("implicit_body"), std::string("implicit_body"), "",
       "how w x I w is integrated: none, explicit, implicit_body, implicit_world"},
      {"solver_iterations", 10.0, 50.0, "",
       "sweeps of projected Gauss-Seidel over the contacts in a step; more, so that the contacts of one body agree"},
      {"warm_starting", true, true, "", "starts from the impulses of the step before"},
      {"restitution_threshold", 0.2, 0.0, "m/s", "slower impacts have e = 0; the scenario states no such threshold"},
      {"split_impulse", true, true, "", "corrects penetration with velocities that are forgotten after the step"},
      {"split_impulse_penetration_threshold", -0.04, 0.0, "m",
       "shallower penetration is corrected by real velocity: an impact seen at depth d rebounds with e + erp2 d/(v dt) "
       "instead of e; 0: never"},
      {"erp2", 0.2, 0.2, "1", "share of the penetration that a step corrects"},
      {"linear_slop", 0.0, 0.0, "m", "penetration that is left alone"},
      {"contact_processing_threshold", kNever, 0.0, "m",
       "contacts farther apart are ignored; above 0 bodies are braked before they touch and do not rebound"},
      {"plane_contact_iterations", 1.0, 4.0, "",
       "support points sought per step between a box and a plane; with one a box that lands flat tumbles"},
  };
}

class BulletEngine final : public Engine {
 public:
  BulletEngine() {
    info_.name = kIsDouble ? "bullet-f64" : "bullet-f32";
    info_.library = "Bullet";
    info_.version = std::to_string(btGetVersion() / 100) + "." + std::to_string(btGetVersion() % 100);
    info_.precision = kIsDouble ? Precision::kDouble : Precision::kSingle;
    info_.scheme = "semi-implicit Euler";
    info_.features = {Feature::kSpatial,     Feature::kForce,           Feature::kTorque,       Feature::kSphereSphere,
                      Feature::kSphereBox,   Feature::kSphereHalfSpace, Feature::kBoxHalfSpace, Feature::kBoxBox,
                      Feature::kRestitution, Feature::kFriction};
    info_.settings = setting_table();
  }

  const EngineInfo& info() const override { return info_; }

  std::unique_ptr<World> create(const Scenario& scenario, const Settings& settings) const override {
    gCalculateCombinedRestitutionCallback = pair_restitution;
    gCalculateCombinedFrictionCallback = pair_friction;
    return std::make_unique<BulletWorld>(scenario, Knobs(settings));
  }

 private:
  EngineInfo info_;
};

}  // namespace

std::vector<std::unique_ptr<Engine>> make_engines() {
  std::vector<std::unique_ptr<Engine>> engines;
  engines.push_back(std::make_unique<BulletEngine>());
  return engines;
}

}  // namespace plumbline
