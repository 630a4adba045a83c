// Box2D behind the door of core/engine.hpp. Its plane is the x-z plane of the scenario.
#include <box2d/box2d.h>

#include <cfloat>
#include <cmath>
#include <stdexcept>

#include "plumbline/adapters/knob_table.hpp"
#include "plumbline/adapters/planar_frame.hpp"
#include "plumbline/adapters/planar_joint.hpp"
#include "plumbline/core/engine.hpp"

namespace plumbline {
namespace {

float real(double x) { return static_cast<float>(x); }
b2Vec2 vec2(double x, double z) { return {real(x), real(z)}; }
b2Vec2 vec2(const Vec3& v) { return vec2(v.x(), v.z()); }
b2Vec2 vec2(const PlanarVector& v) { return vec2(v.x, v.z); }

struct Knobs {
  bool sleeping;
  int velocity_iterations, position_iterations;
  bool warm_starting, continuous;
  double restitution_threshold, linear_damping, angular_damping, polygon_skin, ground_skin, ground_half_length;
};

const KnobTable<Knobs>& knob_table() {
  static const KnobTable<Knobs> table =
      KnobTable<Knobs>()
          .add(&Knobs::sleeping, "sleeping", true, false, "", "stops bodies that have been slow for 0.5 s")
          .add(&Knobs::velocity_iterations, "velocity_iterations", 8, 8, "", "sweeps over the velocities in a step")
          .add(&Knobs::position_iterations, "position_iterations", 3, 3, "", "sweeps over the positions in a step")
          .add(&Knobs::warm_starting, "warm_starting", true, true, "", "starts from the impulses of the step before")
          .add(&Knobs::continuous, "continuous", true, true, "",
               "stops moving bodies at the time of impact with fixed ones, b2_linearSlop too high; without it a ball "
               "that is fast for its size passes the ground, which is an edge without an inside")
          .add(&Knobs::restitution_threshold, "restitution_threshold", 1, 0, "m/s",
               "slower impacts have e = 0; the scenario states no such threshold")
          .add(&Knobs::linear_damping, "linear_damping", 0, 0, "1/s", "decay rate of the velocity")
          .at_least(0)
          .add(&Knobs::angular_damping, "angular_damping", 0, 0, "1/s", "decay rate of the angular velocity")
          .at_least(0)
          .add(&Knobs::polygon_skin, "polygon_skin", double{b2_polygonRadius}, double{b2_linearSlop}, "m",
               "shell around boxes; matched to the penetration that the solver leaves alone")
          .at_least(0)
          .add(&Knobs::ground_skin, "ground_skin", double{b2_polygonRadius}, 0, "m",
               "shell around the ground: a ball touches that much early")
          .at_least(0)
          .add(&Knobs::ground_half_length, "ground_half_length", 1000, 1000, "m",
               "a half-space is an edge that ends here on either side")
          .at_least(0);
  return table;
}

class Box2dWorld final : public World {
 public:
  Box2dWorld(const Scenario& scenario, const Knobs& knobs) : knobs_(knobs), world_(vec2(scenario.gravity)) {
    world_.SetAllowSleeping(knobs.sleeping);
    world_.SetWarmStarting(knobs.warm_starting);
    world_.SetContinuousPhysics(knobs.continuous);
    for (const Body& body : scenario.bodies) add(body, scenario.contact);
    for (const Joint& joint : scenario.joints) add(scenario, joint);
    for (const Spring& spring : scenario.springs) add(scenario, spring);
  }

  void apply(std::span<const Wrench> wrenches) override {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Vec3 &f = wrenches[i].f_W, &tau = wrenches[i].tau_W;
      // In single precision, and so that its square is finite too: a speed whose square is not is one of 0 to Box2D.
      const b2Vec2 acceleration = (bodies_[i]->GetType() == b2_staticBody ? 0 : 1 / bodies_[i]->GetMass()) * vec2(f);
      if (!f.allFinite() || !tau.allFinite() || !std::isfinite(acceleration.LengthSquared())) {
        throw std::runtime_error("the force or torque on body " + std::to_string(i) + " is too large or not finite");
      }
      bodies_[i]->ApplyForceToCenter(vec2(f), true);
      bodies_[i]->ApplyTorque(real(planar_torque(tau)), true);
    }
  }

  // Box2D clears the forces at the end of the step.
  void step(double dt) override {
    world_.Step(real(dt), knobs_.velocity_iterations, knobs_.position_iterations);
    for (const b2Body* body : bodies_) require_unclamped(*body, dt);
  }

  void read(std::span<BodyState> states) const override {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const b2Body& body = *bodies_[i];
      const b2Vec2 p = body.GetWorldCenter(), v = body.GetLinearVelocity();
      states[i] = in_space({p.x, p.y, body.GetAngle(), v.x, v.y, body.GetAngularVelocity()}, initial_[i]);
    }
  }

 private:
  // Box2D takes speed from whatever would go farther than that within one step, and says nothing.
  static void require_unclamped(const b2Body& body, double dt) {
    constexpr double kRounding = 1e-6;  // a few units of the clamped speed's last place
    if (double{body.GetLinearVelocity().Length()} * dt < (1 - kRounding) * double{b2_maxTranslation} &&
        std::abs(double{body.GetAngularVelocity()}) * dt < (1 - kRounding) * double{b2_maxRotation}) {
      return;
    }
    throw std::runtime_error(
        "Box2D limits a step to 2 m and a quarter turn, and a body is as fast as that; smaller steps help");
  }

  void add(const Body& body, const std::optional<ContactMaterial>& contact) {
    const PlanarState state = in_plane(initial_.emplace_back(body.initial));
    b2BodyDef def;
    def.type = body.fixed ? b2_staticBody : b2_dynamicBody;
    def.position = vec2(state.x, state.z);
    def.angle = real(state.angle);
    if (!body.fixed) {
      def.linearVelocity = vec2(state.vx, state.vz);
      def.angularVelocity = real(state.w);
    }
    def.linearDamping = real(knobs_.linear_damping);
    def.angularDamping = real(knobs_.angular_damping);
    b2Body* created = bodies_.emplace_back(world_.CreateBody(&def));
    if (contact) add_fixture(*created, body.shape, *contact);
    if (!body.fixed) {
      const b2MassData mass = {real(body.mass), b2Vec2(0, 0), real(planar_inertia(body))};
      created->SetMassData(&mass);
    }
  }

  void add_fixture(b2Body& created, const Shape& shape, const ContactMaterial& contact) {
    // Every fixture carries the coefficients of the pair. Box2D's rules, sqrt(mu mu) and max(e, e), give back just
    // those: the correctly rounded root of a rounded square is the number itself.
    b2FixtureDef def;
    def.density = 0;  // the mass is stated, not derived
    def.restitution = real(contact.restitution);
    def.friction = real(contact.friction);
    def.restitutionThreshold = real(knobs_.restitution_threshold);
    b2CircleShape circle;
    b2PolygonShape polygon;
    b2EdgeShape edge;
    if (const auto* sphere = std::get_if<Sphere>(&shape)) {
      circle.m_radius = real(sphere->radius);
      def.shape = &circle;
    } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
      circle.m_radius = real(cylinder->radius);
      def.shape = &circle;
    } else if (const auto* box = std::get_if<Box>(&shape)) {
      polygon.SetAsBox(real(0.5 * box->size.x()), real(0.5 * box->size.z()));
      polygon.m_radius = real(knobs_.polygon_skin);
      def.shape = &polygon;
    } else {
      // The surface as one long edge through the body's position, in the body's frame. The normal is stated in W,
      // whatever the attitude of its body.
      const b2Vec2 n = created.GetLocalVector(vec2(std::get<HalfSpace>(shape).normal));
      const double length = knobs_.ground_half_length;
      edge.SetTwoSided(vec2(-length * double{n.y}, length * double{n.x}),
                       vec2(length * double{n.y}, -length * double{n.x}));
      edge.m_radius = real(knobs_.ground_skin);
      def.shape = &edge;
    }
    created.CreateFixture(&def);
  }

  void add(const Scenario& scenario, const Joint& joint) {
    const PlanarJoint planar = planar_joint(scenario, joint);
    switch (joint.kind) {
      case JointKind::kBall:
      case JointKind::kHinge: {
        b2RevoluteJointDef def;
        def.referenceAngle = real(planar.turn);
        if (planar.range) {
          def.enableLimit = true;
          def.lowerAngle = real(planar.range->low);
          def.upperAngle = real(planar.range->high);
        }
        tie(def, joint.a, joint.b, planar.on_a, planar.on_b);
        break;
      }
      case JointKind::kSlider: {
        b2PrismaticJointDef def;
        def.localAxisA = vec2(planar.axis);
        def.referenceAngle = real(planar.turn);
        if (planar.range) {
          def.enableLimit = true;
          def.lowerTranslation = real(planar.range->low);
          def.upperTranslation = real(planar.range->high);
        }
        tie(def, joint.a, joint.b, planar.on_a, planar.on_b);
        break;
      }
      case JointKind::kFixed: {
        b2WeldJointDef def;
        def.referenceAngle = real(planar.turn);
        tie(def, joint.a, joint.b, planar.on_a, planar.on_b);
        break;
      }
      case JointKind::kDistance: {
        if (!(joint.length > double{b2_linearSlop})) {
          throw std::invalid_argument("joint '" + joint.name + "': Box2D would make a rod longer than " +
                                      shortest(double{b2_linearSlop}) + " m of it; use a ball joint");
        }
        // No play and no stiffness: a rod, not a spring.
        b2DistanceJointDef def;
        def.length = def.minLength = def.maxLength = real(joint.length);
        tie(def, joint.a, joint.b, planar.on_a, planar.on_b);
        break;
      }
    }
  }

  void add(const Scenario& scenario, const Spring& spring) {
    if (!(spring.length > double{b2_linearSlop})) {
      throw std::invalid_argument("spring '" + spring.name + "': Box2D would make one at rest at " +
                                  shortest(double{b2_linearSlop}) + " m of it; give it a length, or a force law");
    }
    const PlanarSpring planar = planar_spring(scenario, spring);
    b2DistanceJointDef def;
    def.length = real(spring.length);
    def.minLength = 0;
    def.maxLength = FLT_MAX;
    def.stiffness = real(spring.stiffness);
    def.damping = real(spring.damping);
    def.collideConnected = true;
    tie(def, spring.a, spring.b, planar.on_a, planar.on_b);
  }

  // Bodies that a joint ties do not collide, unless its definition says so.
  template <typename Definition>
  void tie(Definition def, std::size_t a, std::size_t b, const PlanarVector& on_a, const PlanarVector& on_b) {
    if (a == kWorld && frame_ == nullptr) {
      const b2BodyDef standing;
      frame_ = world_.CreateBody(&standing);
    }
    def.bodyA = a == kWorld ? frame_ : bodies_[a];
    def.bodyB = bodies_[b];
    def.localAnchorA = vec2(on_a);
    def.localAnchorB = vec2(on_b);
    world_.CreateJoint(&def);
  }

  Knobs knobs_;
  b2World world_;
  std::vector<BodyState> initial_;
  std::vector<b2Body*> bodies_;  // owned by world_, and so is
  b2Body* frame_ = nullptr;      // the body that stands for W, if a joint asks for it
};

class Box2dEngine final : public Engine {
 public:
  Box2dEngine() {
    info_.name = "box2d";
    info_.library = "Box2D";
    info_.version = std::to_string(b2_version.major) + "." + std::to_string(b2_version.minor) + "." +
                    std::to_string(b2_version.revision);
    info_.precision = Precision::kSingle;
    info_.dimension = 2;
    info_.scheme = "semi-implicit Euler";
    info_.features = FeatureSet::joints();
    for (Feature feature :
         {Feature::kForce, Feature::kTorque, Feature::kSphereSphere, Feature::kSphereBox, Feature::kSphereHalfSpace,
          Feature::kBoxHalfSpace, Feature::kBoxBox, Feature::kRestitution, Feature::kFriction,
          Feature::kJointsAndContact, Feature::kCylinderHalfSpace, Feature::kCylinderCylinder, Feature::kCylinderOther,
          Feature::kJointRange, Feature::kSpring}) {
      info_.features.insert(feature);
    }
    info_.settings = knob_table().rows();
  }

  const EngineInfo& info() const override { return info_; }

  std::unique_ptr<World> create(const Scenario& scenario, const Settings& settings) const override {
    return std::make_unique<Box2dWorld>(scenario, knob_table().read(settings));
  }

 private:
  EngineInfo info_;
};

}  // namespace

std::vector<std::unique_ptr<Engine>> make_engines() {
  std::vector<std::unique_ptr<Engine>> engines;
  engines.push_back(std::make_unique<Box2dEngine>());
  return engines;
}

}  // namespace plumbline
