// Box2D behind the door of core/engine.hpp. Its plane is the x-z plane of the scenario.
//
// Box2D's (x, y) are the scenario's (x, z). A positive rotation about +y turns z towards x, a positive one in Box2D
// turns x towards its y, that is z: angle = -(angle about +y), and likewise for angular velocity and torque.
#include <box2d/box2d.h>

#include <cmath>
#include <stdexcept>

#include "plumbline/core/engine.hpp"

namespace plumbline {
namespace {

float real(double x) { return static_cast<float>(x); }
b2Vec2 in_plane(const Vec3& v) { return {real(v.x()), real(v.z())}; }
Vec3 vec3(const b2Vec2& v) { return {double{v.x}, 0, double{v.y}}; }

// The turn about y that is left when rotation out of the plane is dropped (the twist of q about y) [rad].
double angle_about_y(const Quat& q) { return 2 * std::atan2(q.y(), q.w()); }

struct Knobs {
  explicit Knobs(const Settings& s)
      : sleeping(setting_bool(s, "sleeping")),
        velocity_iterations(static_cast<int>(setting_number(s, "velocity_iterations"))),
        position_iterations(static_cast<int>(setting_number(s, "position_iterations"))),
        warm_starting(setting_bool(s, "warm_starting")),
        continuous(setting_bool(s, "continuous")),
        restitution_threshold(setting_number(s, "restitution_threshold")),
        linear_damping(setting_number(s, "linear_damping")),
        angular_damping(setting_number(s, "angular_damping")),
        polygon_skin(setting_number(s, "polygon_skin")),
        ground_skin(setting_number(s, "ground_skin")),
        ground_half_length(setting_number(s, "ground_half_length")) {}

  bool sleeping;
  int velocity_iterations, position_iterations;
  bool warm_starting, continuous;
  double restitution_threshold, linear_damping, angular_damping, polygon_skin, ground_skin, ground_half_length;
};

class Box2dWorld final : public World {
 public:
  Box2dWorld(const Scenario& scenario, const Knobs& knobs) : knobs_(knobs), world_(in_plane(scenario.gravity)) {
    world_.SetAllowSleeping(knobs.sleeping);
    world_.SetWarmStarting(knobs.warm_starting);
    world_.SetContinuousPhysics(knobs.continuous);
    for (const Body& body : scenario.bodies) add(body, scenario.contact);
  }

  void apply(std::span<const Wrench> wrenches) override {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      bodies_[i]->ApplyForceToCenter(in_plane(wrenches[i].f_W), true);
      bodies_[i]->ApplyTorque(real(-wrenches[i].tau_W.y()), true);
    }
  }

  // Box2D clears the forces at the end of the step.
  void step(double dt) override { world_.Step(real(dt), knobs_.velocity_iterations, knobs_.position_iterations); }

  void read(std::span<BodyState> states) const override {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const b2Body& body = *bodies_[i];
      states[i].p_WB = vec3(body.GetWorldCenter());
      states[i].q_WB = rotation_by(Vec3(0, -double{body.GetAngle()}, 0));
      states[i].v_WB = vec3(body.GetLinearVelocity());
      states[i].w_WB = Vec3(0, -double{body.GetAngularVelocity()}, 0);
    }
  }

 private:
  void add(const Body& body, const std::optional<ContactMaterial>& contact) {
    const bool fixed = body.fixed || std::holds_alternative<HalfSpace>(body.shape);
    if (!fixed && !(body.mass > 0 && body.inertia.y() > 0)) {
      throw std::invalid_argument("body '" + body.name + "' moves, so its mass and inertia must be > 0");
    }
    b2BodyDef def;
    def.type = fixed ? b2_staticBody : b2_dynamicBody;
    def.position = in_plane(body.initial.p_WB);
    def.angle = real(-angle_about_y(body.initial.q_WB));
    if (!fixed) {
      def.linearVelocity = in_plane(body.initial.v_WB);
      def.angularVelocity = real(-body.initial.w_WB.y());
    }
    def.linearDamping = real(knobs_.linear_damping);
    def.angularDamping = real(knobs_.angular_damping);
    b2Body* created = world_.CreateBody(&def);
    if (contact) add_fixture(*created, body, *contact);
    if (!fixed) {
      const b2MassData mass = {real(body.mass), b2Vec2(0, 0), real(body.inertia.y())};
      created->SetMassData(&mass);
    }
    bodies_.push_back(created);
  }

  void add_fixture(b2Body& created, const Body& body, const ContactMaterial& contact) {
    // Every fixture carries the coefficients of the pair. Box2D's rules, sqrt(mu mu) and max(e, e), give back just
    // those: the correctly rounded root of a rounded square is the number itself.
    b2FixtureDef def;
    def.density = 0;  // the mass is stated, not derived
    def.restitution = real(contact.restitution);
    def.friction = real(contact.friction);
    def.restitutionThreshold = real(knobs_.restitution_threshold);
    if (const auto* sphere = std::get_if<Sphere>(&body.shape)) {
      b2CircleShape circle;
      circle.m_radius = real(sphere->radius);
      def.shape = &circle;
      created.CreateFixture(&def);
    } else if (const auto* box = std::get_if<Box>(&body.shape)) {
      b2PolygonShape polygon;
      polygon.SetAsBox(real(0.5 * box->size.x()), real(0.5 * box->size.z()));
      polygon.m_radius = real(knobs_.polygon_skin);
      def.shape = &polygon;
      created.CreateFixture(&def);
    } else {
      // The surface as one long edge through the body's position, in the body's frame.
      const Vec3 n = created_frame(created, std::get<HalfSpace>(body.shape).normal);
      const Vec3 along = knobs_.ground_half_length * Vec3(n.z(), 0, -n.x());
      b2EdgeShape edge;
      edge.SetTwoSided(in_plane(-along), in_plane(along));
      edge.m_radius = real(knobs_.ground_skin);
      def.shape = &edge;
      created.CreateFixture(&def);
    }
  }

  // The normal of a half-space is stated in W, whatever the attitude of its body.
  static Vec3 created_frame(const b2Body& created, const Vec3& n_W) {
    return vec3(created.GetLocalVector(in_plane(n_W)));
  }

  Knobs knobs_;
  b2World world_;
  std::vector<b2Body*> bodies_;  // owned by world_
};

std::vector<Setting> setting_table() {
  return {
      {"sleeping", true, false, "", "stops bodies that have been slow for 0.5 s"},
      {"velocity_iterations", 8.0, 8.0, "", "sweeps over the contact velocities in a step"},
      {"position_iterations", 3.0, 3.0, "", "sweeps over the contact positions in a step"},
      {"warm_starting", true, true, "", "starts from the impulses of the step before"},
      {"continuous", true, true, "",
       "stops moving bodies at the time of impact with fixed ones, b2_linearSlop too high; without it a ball that is "
       "fast for its size passes the ground, which is an edge without an inside"},
      {"restitution_threshold", 1.0, 0.0, "m/s", "slower impacts have e = 0; the scenario states no such threshold"},
      {"linear_damping", 0.0, 0.0, "1/s", "decay rate of the velocity"},
      {"angular_damping", 0.0, 0.0, "1/s", "decay rate of the angular velocity"},
      {"polygon_skin", double{b2_polygonRadius}, double{b2_linearSlop}, "m",
       "shell around boxes; matched to the penetration that the solver leaves alone"},
      {"ground_skin", double{b2_polygonRadius}, 0.0, "m", "shell around the ground: a ball touches that much early"},
      {"ground_half_length", 1000.0, 1000.0, "m", "a half-space is an edge that ends here on either side"},
  };
}

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
    info_.features = {Feature::kForce,     Feature::kTorque,          Feature::kSphereSphere,
                      Feature::kSphereBox, Feature::kSphereHalfSpace, Feature::kBoxHalfSpace,
                      Feature::kBoxBox,    Feature::kRestitution,     Feature::kFriction};
    info_.settings = setting_table();
  }

  const EngineInfo& info() const override { return info_; }

  std::unique_ptr<World> create(const Scenario& scenario, const Settings& settings) const override {
    const Knobs knobs(settings);
    const PlanarView view = planar_view(scenario);
    if (view.planarity == Planarity::kSpatial) {
      throw std::invalid_argument("Box2D lives in the x-z plane, but " + view.reason);
    }
    return std::make_unique<Box2dWorld>(scenario, knobs);
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
