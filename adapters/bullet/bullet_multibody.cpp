// Trees of joints in reduced coordinates: btMultiBody in a btMultiBodyDynamicsWorld. Every moving body is the base or a
// link of a btMultiBody, as Bullet's own importers of robots make them; a body without joints is a base without links.
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <stdexcept>

#include "bullet_conversions.hpp"
#include "bullet_joints.hpp"
#include "bullet_knobs.hpp"
#include "bullet_tree.hpp"
#include "plumbline/core/engine.hpp"

namespace plumbline {
namespace {

struct MultibodyKnobs : BulletContactKnobs {
  bool sleeping, gyroscopic, warm_starting;
  double linear_damping, angular_damping, max_coordinate_velocity, stop_erp, stop_max_impulse;
};

KnobTable<MultibodyKnobs> knob_table() {
  using K = MultibodyKnobs;
  // Bullet writes its damping as a float, in double precision too.
  constexpr double kDamping = 0.04f;
  KnobTable<K> table;
  table
      .add(&K::sleeping, "sleeping", true, false, "",
           "stops bodies that have been slow for 2 s; a force on a sleeping body is lost")
      .add(&K::linear_damping, "linear_damping", kDamping, 0, "1/s",
           "drag k (1 + |v|) v per mass, which no scenario states: on by default, unlike that of rigid bodies")
      .add(&K::angular_damping, "angular_damping", kDamping, 0, "1/s", "drag k (1 + |w|) w per moment of inertia")
      .add(&K::max_coordinate_velocity, "max_coordinate_velocity", 100, kBulletNever, "m/s or rad/s",
           "faster coordinates are cut to this, silently")
      .add(&K::gyroscopic, "gyroscopic", true, true, "", "integrates w x I w");
  return add_bullet_contact_knobs(table)
      .add(&K::stop_erp, "stop_erp", 0.2, 0, "1",
           "share of what a limit of a joint was passed by that a step corrects, by real velocity: a stop reached at "
           "depth d throws back with stop_erp d/dt; without it the joint stays that far beyond")
      .add(&K::stop_max_impulse, "stop_max_impulse", 100, kBulletNever, "N s or N m s",
           "the most that a limit of a joint gives in a step")
      .add(&K::warm_starting, "warm_starting", false, false, "", "starts from the impulses of the step before")
      .add(&K::erp2, "erp2", 0.2, 0, "1",
           "share of the penetration that a step corrects, always by real velocity: split impulses are not for "
           "multibodies, so that an impact seen at depth d rebounds with e + erp2 d/(v dt); without it penetration "
           "stays");
}

class MultibodyWorld final : public World {
 public:
  MultibodyWorld(const Scenario& scenario, const MultibodyKnobs& knobs)
      : contact_(scenario.contact), threshold_(real(knobs.contact_processing_threshold)) {
    set_bullet_contact(knobs, collision_, world_.getSolverInfo());
    if (knobs.warm_starting) world_.getSolverInfo().m_solverMode |= SOLVER_USE_ARTICULATED_WARMSTARTING;
    world_.getSolverInfo().m_erp = real(knobs.stop_erp);  // of limits alone: joints are held by their coordinates
    world_.setGravity(vector(scenario.gravity));
    for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
      if (scenario.bodies[i].fixed) add_fixed(i, scenario.bodies[i]);
    }
    places_.resize(scenario.bodies.size());
    for (const auto& links : bullet_trees(scenario)) add_tree(scenario, knobs, links);
  }

  ~MultibodyWorld() override {
    for (const auto& collider : colliders_) world_.removeCollisionObject(collider.get());
    for (const auto& stop : stops_) world_.removeMultiBodyConstraint(stop.get());
    for (const Tree& tree : trees_) world_.removeMultiBody(tree.multibody.get());
  }

  void apply(std::span<const Wrench> wrenches) override {
    for (const Tree& tree : trees_) {
      for (std::size_t k = 0; k < tree.bodies.size(); ++k) {
        if (tree.bodies[k] == kWorld) continue;
        const btVector3 f = vector(wrenches[tree.bodies[k]].f_W), tau = vector(wrenches[tree.bodies[k]].tau_W);
        if (k == 0) {
          tree.multibody->addBaseForce(f);
          tree.multibody->addBaseTorque(tau);
        } else {
          tree.multibody->addLinkForce(static_cast<int>(k) - 1, f);
          tree.multibody->addLinkTorque(static_cast<int>(k) - 1, tau);
        }
      }
    }
  }

  // Zero sub-steps at most means one step of exactly dt. Bullet clears the forces at its end.
  void step(double dt) override {
    if (!(dt > 0)) throw std::invalid_argument("dt must be > 0, is " + shortest(dt));
    world_.stepSimulation(real(dt), 0);
    for (const auto& collider : colliders_) require_simulated(*collider);
  }

  void read(std::span<BodyState> states) const override {
    for (const Fixed& f : fixed_) states[f.body] = f.state;
    btAlignedObjectArray<btQuaternion> to_link;
    btAlignedObjectArray<btVector3> origin, v, w;
    for (const Tree& tree : trees_) {
      btMultiBody& multibody = *tree.multibody;
      const int count = static_cast<int>(tree.bodies.size());
      v.resize(count);
      w.resize(count);
      multibody.forwardKinematics(to_link, origin);
      multibody.compTreeLinkVelocities(&w[0], &v[0]);  // each in its own axes
      for (int k = 0; k < count; ++k) {
        const std::size_t body = tree.bodies[static_cast<std::size_t>(k)];
        if (body == kWorld) continue;
        const btQuaternion to_world = to_link[k].inverse();
        states[body].p_WB = vec3(origin[k]);
        states[body].q_WB = quat(to_world);
        // The base keeps its velocities in W: turning them there and back would round them.
        states[body].v_WB = vec3(k == 0 ? multibody.getBaseVel() : quatRotate(to_world, v[k]));
        states[body].w_WB = vec3(k == 0 ? multibody.getBaseOmega() : quatRotate(to_world, w[k]));
      }
    }
  }

 private:
  struct Tree {
    std::unique_ptr<btMultiBody> multibody;
    std::vector<std::size_t> bodies;  // the base, kWorld for one that stands still, then the links
  };
  struct Fixed {
    std::size_t body;
    BodyState state;  // what read() says of it
  };
  struct Place {
    btMultiBody* multibody = nullptr;
    int link = -1;  // the base
  };

  void add_fixed(std::size_t i, const Body& body) {
    shapes_.push_back(bullet_shape(body));
    // Mass 0 is how Bullet says "fixed".
    auto post = std::make_unique<btRigidBody>(real(0), nullptr, shapes_.back().get());
    post->setWorldTransform(bullet_pose(body));
    add(std::move(post), btBroadphaseProxy::StaticFilter);
    fixed_.push_back({i, {body.initial.p_WB, body.initial.q_WB, Vec3::Zero(), Vec3::Zero()}});
  }

  void add_tree(const Scenario& scenario, const MultibodyKnobs& knobs, const std::vector<TreeLink>& links) {
    const bool floats = !links.front().joint;
    const Body& root = scenario.bodies[links.front().body];
    Tree tree;
    if (!floats) tree.bodies.push_back(kWorld);
    for (const TreeLink& link : links) tree.bodies.push_back(link.body);
    tree.multibody =
        std::make_unique<btMultiBody>(static_cast<int>(tree.bodies.size()) - 1, floats ? real(root.mass) : real(0),
                                      floats ? vector(root.inertia) : btVector3(0, 0, 0), !floats, knobs.sleeping);
    btMultiBody& multibody = *tree.multibody;
    for (const TreeLink& link : links) {
      const int number = static_cast<int>(&link - links.data()) - (floats ? 1 : 0);
      places_[link.body] = {&multibody, number};
      if (link.joint) {
        const int parent = link.joint->a == kWorld ? -1 : places_[link.joint->a].link;
        set_up_link(multibody, number, parent, scenario, link);
      }
    }
    multibody.finalizeMultiDof();
    multibody.setLinearDamping(real(knobs.linear_damping));
    multibody.setAngularDamping(real(knobs.angular_damping));
    multibody.setMaxCoordinateVelocity(real(knobs.max_coordinate_velocity));
    multibody.setUseGyroTerm(knobs.gyroscopic);
    if (floats) {
      multibody.setBasePos(vector(root.initial.p_WB));
      multibody.setWorldToBaseRot(quaternion(root.initial.q_WB.conjugate()));
      multibody.setBaseVel(vector(root.initial.v_WB));
      multibody.setBaseOmega(vector(root.initial.w_WB));
    }
    for (const TreeLink& link : links) {
      if (link.joint) set_initial_rate(multibody, places_[link.body].link, scenario, *link.joint);
    }
    world_.addMultiBody(&multibody);
    for (const TreeLink& link : links) {
      if (!link.joint || !link.joint->range) continue;
      stops_.push_back(bullet_stop(multibody, places_[link.body].link, *link.joint->range, knobs.stop_max_impulse));
      world_.addMultiBodyConstraint(stops_.back().get());
    }
    for (const TreeLink& link : links) add_collider(multibody, places_[link.body].link, scenario.bodies[link.body]);
    trees_.push_back(std::move(tree));
  }

  void add_collider(btMultiBody& multibody, int link, const Body& body) {
    shapes_.push_back(bullet_shape(body));
    auto collider = std::make_unique<btMultiBodyLinkCollider>(&multibody, link);
    collider->setCollisionShape(shapes_.back().get());
    collider->setWorldTransform(bullet_pose(body));
    (link < 0 ? multibody.setBaseCollider(collider.get()) : void(multibody.getLink(link).m_collider = collider.get()));
    add(std::move(collider), btBroadphaseProxy::DefaultFilter);
  }

  void add(std::unique_ptr<btCollisionObject> object, int group) {
    object->setRestitution(contact_ ? real(contact_->restitution) : real(0));
    object->setFriction(contact_ ? real(contact_->friction) : real(0));
    object->setContactProcessingThreshold(threshold_);
    // Without contact in no group, looking for none. Said in any case: Bullet takes such objects for static ones.
    const bool fixed = group == btBroadphaseProxy::StaticFilter;
    const int others =
        fixed ? btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter : btBroadphaseProxy::AllFilter;
    world_.addCollisionObject(object.get(), contact_ ? group : 0, contact_ ? others : 0);
    colliders_.push_back(std::move(object));
  }

  std::optional<ContactMaterial> contact_;
  btScalar threshold_;  // [m]
  btDefaultCollisionConfiguration collision_;
  btCollisionDispatcher dispatcher_{&collision_};
  btDbvtBroadphase broadphase_;
  btMultiBodyConstraintSolver solver_;
  btMultiBodyDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &collision_};
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> colliders_;
  std::vector<Fixed> fixed_;
  std::vector<Place> places_;  // of each body
  std::vector<Tree> trees_;
  std::vector<std::unique_ptr<btMultiBodyConstraint>> stops_;
};

class MultibodyEngine final : public Engine {
 public:
  MultibodyEngine() {
    info_.name = "bullet-multibody";
    info_.library = "Bullet";
    info_.version = std::to_string(btGetVersion() / 100) + "." + std::to_string(btGetVersion() % 100);
    info_.precision = kBulletIsDouble ? Precision::kDouble : Precision::kSingle;
    info_.scheme = "semi-implicit Euler in joint coordinates";
    using enum Feature;
    info_.features = {
        kSpatial,         kForce,      kTorque,      kSphereSphere,     kSphereBox,         kSphereHalfSpace,
        kBoxHalfSpace,    kBoxBox,     kRestitution, kFriction,         kBallJoint,         kHinge,
        kSlider,          kFixedJoint, kJointRange,  kJointsAndContact, kCylinderHalfSpace, kCylinderOther,
        kCylinderCylinder};
    info_.settings = knobs_.rows();
  }

  const EngineInfo& info() const override { return info_; }

  std::unique_ptr<World> create(const Scenario& scenario, const Settings& settings) const override {
    return std::make_unique<MultibodyWorld>(scenario, knobs_.read(settings));
  }

 private:
  const KnobTable<MultibodyKnobs> knobs_ = knob_table();
  EngineInfo info_;
};

}  // namespace

std::vector<std::unique_ptr<Engine>> make_engines() {
  take_material_of_the_pair();
  std::vector<std::unique_ptr<Engine>> engines;
  engines.push_back(std::make_unique<MultibodyEngine>());
  return engines;
}

}  // namespace plumbline
