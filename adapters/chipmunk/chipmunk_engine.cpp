// Chipmunk behind the door of core/engine.hpp. Its plane is the x-z plane of the scenario.
#include <chipmunk/chipmunk.h>

#include <cmath>
#include <stdexcept>

#include "plumbline/adapters/knob_table.hpp"
#include "plumbline/adapters/planar_frame.hpp"
#include "plumbline/adapters/planar_joint.hpp"
#include "plumbline/core/engine.hpp"

namespace plumbline {
namespace {

cpVect vect(const PlanarVector& v) { return cpv(v.x, v.z); }

enum class Anchors { kStated, kBalanced };

struct Knobs {
  int iterations;
  double collision_slop, collision_bias;
  int collision_persistence;
  double joint_bias, damping, sleep_time, idle_speed, ground_half_length, ground_depth, groove_half_length;
  Anchors anchors;
};

const KnobTable<Knobs>& knob_table() {
  // Chipmunk's own defaults, whose tenths are those of single precision. The second is the share of an error that is
  // left after a second when a tenth of it goes in each of 60 frames.
  const double usual_slop = double{0.1f}, usual_bias = std::pow(double{1.0f - 0.1f}, 60);
  static const KnobTable<Knobs> table =
      KnobTable<Knobs>()
          .add(&Knobs::iterations, "iterations", 10, 50, "",
               "sweeps over contacts and joints in a step; more, so that the contacts of one body agree")
          .at_least(1)
          .add(&Knobs::collision_slop, "collision_slop", usual_slop, 1e-4, "m",
               "penetration that is left alone; made for pixels: a body of a metre sinks a tenth of its size")
          .add(&Knobs::collision_bias, "collision_bias", usual_bias, usual_bias, "1",
               "share of the penetration that is left after a second of correction, by velocities that are forgotten")
          .at_least(0)
          .add(&Knobs::collision_persistence, "collision_persistence", 3, 3, "",
               "steps that lost contacts are kept for")
          .add(&Knobs::joint_bias, "joint_bias", usual_bias, usual_bias, "1",
               "share of a joint's error that is left after a second of correction, by real velocity")
          .at_least(0)
          .add(&Knobs::damping, "damping", 1, 1, "1", "share of the velocity that is left after a second")
          .at_least(0)
          .add(&Knobs::sleep_time, "sleep_time", INFINITY, INFINITY, "s", "bodies that were idle that long are stopped")
          .add(&Knobs::idle_speed, "idle_speed", 0, 0, "m/s", "slower counts as idle; 0: Chipmunk's guess by gravity")
          .add(&Knobs::ground_half_length, "ground_half_length", 1000, 1000, "m",
               "a half-space is a slab that ends here on either side")
          .at_least(0)
          .add(&Knobs::ground_depth, "ground_depth", 1000, 1000, "m", "and this deep below its surface")
          .at_least(0)
          .add(&Knobs::groove_half_length, "groove_half_length", 1000, 1000, "m",
               "a slider is a groove that ends here on either side")
          .at_least(0)
          .choose(
              &Knobs::anchors, "anchors", {{"stated", Anchors::kStated}, {"balanced", Anchors::kBalanced}}, "stated",
              "balanced",
              "where sliders and fixed joints are pinned. A groove finds the impulse of a pin that cannot slide and "
              "drops the part along itself, which is right only where neither part turns a body as the other does; "
              "sweeps agree at once where a pin's impulse does not turn the bodies against each other");
  return table;
}

struct Free {
  void operator()(cpSpace* space) const { cpSpaceFree(space); }
  void operator()(cpBody* body) const { cpBodyFree(body); }
  void operator()(cpShape* shape) const { cpShapeFree(shape); }
  void operator()(cpConstraint* constraint) const { cpConstraintFree(constraint); }
};
template <typename T>
using Owned = std::unique_ptr<T, Free>;

// The coefficients are those of the pair. Chipmunk would multiply one of either shape, and no share of a coefficient
// multiplies back to just itself for every pair.
cpBool set_material(cpArbiter* contact, cpSpace*, void* material) {
  const auto& pair = *static_cast<const ContactMaterial*>(material);
  cpArbiterSetRestitution(contact, pair.restitution);
  cpArbiterSetFriction(contact, pair.friction);
  return cpTrue;
}

class ChipmunkWorld final : public World {
 public:
  ChipmunkWorld(const Scenario& scenario, const Knobs& knobs) : knobs_(knobs), contact_(scenario.contact) {
    cpSpace* space = space_.get();
    cpSpaceSetIterations(space, knobs.iterations);
    cpSpaceSetCollisionSlop(space, knobs.collision_slop);
    cpSpaceSetCollisionBias(space, knobs.collision_bias);
    cpSpaceSetCollisionPersistence(space, static_cast<cpTimestamp>(knobs.collision_persistence));
    cpSpaceSetDamping(space, knobs.damping);
    cpSpaceSetSleepTimeThreshold(space, knobs.sleep_time);
    cpSpaceSetIdleSpeedThreshold(space, knobs.idle_speed);
    cpSpaceSetGravity(space, cpv(scenario.gravity.x(), scenario.gravity.z()));
    if (contact_) {
      cpCollisionHandler* handler = cpSpaceAddDefaultCollisionHandler(space);
      handler->preSolveFunc = set_material;
      handler->userData = &*contact_;
    }
    for (const Body& body : scenario.bodies) add(body);
    for (const Joint& joint : scenario.joints) add(scenario, joint);
    for (const Spring& spring : scenario.springs) add(scenario, spring);
    for (const JointSpring& spring : scenario.joint_springs) add(scenario, spring);
  }

  void apply(std::span<const Wrench> wrenches) override {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      cpBody* body = bodies_[i].get();
      if (cpBodyGetType(body) != CP_BODY_TYPE_DYNAMIC) continue;
      const Vec3 &f = wrenches[i].f_W, &tau = wrenches[i].tau_W;
      // Chipmunk's own check would end the process.
      if (!f.allFinite() || !tau.allFinite()) {
        throw std::runtime_error("the force or torque on body " + std::to_string(i) + " is not finite");
      }
      cpBodySetForce(body, cpv(f.x(), f.z()));
      cpBodySetTorque(body, planar_torque(tau));
    }
  }

  // Chipmunk clears the forces in the middle of the step, where it uses them.
  void step(double dt) override { cpSpaceStep(space_.get(), dt); }

  void read(std::span<BodyState> states) const override {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const cpBody* body = bodies_[i].get();
      const cpVect p = cpBodyGetPosition(body), v = cpBodyGetVelocity(body);
      states[i] = in_space({p.x, p.y, cpBodyGetAngle(body), v.x, v.y, cpBodyGetAngularVelocity(body)}, initial_[i]);
    }
  }

 private:
  void add(const Body& body) {
    const PlanarState state = in_plane(initial_.emplace_back(body.initial));
    Owned<cpBody>& created =
        bodies_.emplace_back(body.fixed ? cpBodyNewStatic() : cpBodyNew(body.mass, planar_inertia(body)));
    cpBodySetPosition(created.get(), cpv(state.x, state.z));
    cpBodySetAngle(created.get(), state.angle);
    if (!body.fixed) {
      cpBodySetVelocity(created.get(), cpv(state.vx, state.vz));
      cpBodySetAngularVelocity(created.get(), state.w);
    }
    cpSpaceAddBody(space_.get(), created.get());
    if (contact_) cpSpaceAddShape(space_.get(), shapes_.emplace_back(make_shape(created.get(), body.shape)).get());
  }

  cpShape* make_shape(cpBody* body, const Shape& shape) const {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return cpCircleShapeNew(body, sphere->radius, cpvzero);
    if (const auto* cylinder = std::get_if<Cylinder>(&shape)) return cpCircleShapeNew(body, cylinder->radius, cpvzero);
    if (const auto* box = std::get_if<Box>(&shape)) return cpBoxShapeNew(body, box->size.x(), box->size.z(), 0);
    // A slab: on a line without an inside a fast ball would come out on the far side. The normal is stated in W,
    // whatever the attitude of its body.
    const Vec3& n_W = std::get<HalfSpace>(shape).normal;
    const cpVect n = cpvunrotate(cpv(n_W.x(), n_W.z()), cpBodyGetRotation(body));
    const cpVect along = cpvmult(cpvperp(n), knobs_.ground_half_length), down = cpvmult(n, -knobs_.ground_depth);
    const cpVect corners[] = {along, cpvadd(along, down), cpvsub(down, along), cpvneg(along)};
    return cpPolyShapeNewRaw(body, 4, corners, 0);
  }

  void add(const Scenario& scenario, const Joint& joint) {
    const PlanarJoint planar = planar_joint(scenario, joint);
    cpBody *a = body_at(joint.a), *b = body_at(joint.b);
    const cpVect on_a = vect(planar.on_a), on_b = vect(planar.on_b);
    switch (joint.kind) {
      case JointKind::kBall:
      case JointKind::kHinge:
        hold(cpPivotJointNew2(a, b, on_a, on_b));
        if (planar.range) {
          hold(cpRotaryLimitJointNew(a, b, planar.turn + planar.range->low, planar.turn + planar.range->high));
        }
        break;
      case JointKind::kSlider:
        hold(make_groove(a, b, planar));
        hold(cpGearJointNew(a, b, planar.turn, 1));
        break;
      case JointKind::kFixed:
        hold(make_weld(a, b, on_a, on_b));
        hold(cpGearJointNew(a, b, planar.turn, 1));
        break;
      case JointKind::kDistance:
        cpPinJointSetDist(hold(cpPinJointNew(a, b, on_a, on_b)), joint.length);
        break;
    }
  }

  // Bodies that do not turn against each other may be pinned beside the stated points: in a groove through a's centre
  // of mass, with the pin abreast of b's; and where the inverse moments balance.
  cpConstraint* make_groove(cpBody* a, cpBody* b, const PlanarJoint& planar) const {
    cpVect on_a = vect(planar.on_a), on_b = vect(planar.on_b);
    const cpVect axis = vect(planar.axis);
    double start = 0;  // where along the groove the pin is at the start
    if (knobs_.anchors == Anchors::kBalanced) {
      const cpVect axis_W = cpvrotate(axis, cpBodyGetRotation(a));
      const cpVect p_AB_W = cpvsub(cpBodyGetPosition(b), cpBodyGetPosition(a));
      on_a = cpvzero;
      on_b = cpvunrotate(cpvsub(cpvproject(p_AB_W, axis_W), p_AB_W), cpBodyGetRotation(b));
      start = cpvdot(p_AB_W, axis_W);
    }
    // The ends of a groove are stops.
    const JointRange reach = planar.range ? JointRange{start + planar.range->low, start + planar.range->high}
                                          : JointRange{-knobs_.groove_half_length, knobs_.groove_half_length};
    return cpGrooveJointNew(a, b, cpvadd(on_a, cpvmult(axis, reach.low)), cpvadd(on_a, cpvmult(axis, reach.high)),
                            on_b);
  }
  cpConstraint* make_weld(cpBody* a, cpBody* b, cpVect on_a, cpVect on_b) const {
    if (knobs_.anchors == Anchors::kBalanced) {
      const double of_a = 1 / cpBodyGetMoment(a), of_b = 1 / cpBodyGetMoment(b);  // of what never turns: 0
      const cpVect p_AB_W = cpvsub(cpBodyGetPosition(b), cpBodyGetPosition(a));
      on_a = cpvunrotate(cpvmult(p_AB_W, of_b / (of_a + of_b)), cpBodyGetRotation(a));
      on_b = cpvunrotate(cpvmult(p_AB_W, -of_a / (of_a + of_b)), cpBodyGetRotation(b));
    }
    return cpPivotJointNew2(a, b, on_a, on_b);
  }

  void add(const Scenario& scenario, const Spring& spring) {
    const PlanarSpring planar = planar_spring(scenario, spring);
    pull(cpDampedSpringNew(body_at(spring.a), body_at(spring.b), vect(planar.on_a), vect(planar.on_b), spring.length,
                           spring.stiffness, spring.damping));
  }

  void add(const Scenario& scenario, const JointSpring& spring) {
    const Joint& joint = scenario.joints[spring.joint];
    const PlanarJoint planar = planar_joint(scenario, joint);
    cpBody *a = body_at(joint.a), *b = body_at(joint.b);
    if (joint.kind == JointKind::kHinge) {
      // Its angle is that of a less that of b.
      pull(
          cpDampedRotarySpringNew(a, b, -(planar.turn + planar.sense * spring.rest), spring.stiffness, spring.damping));
      return;
    }
    // A spring has a length and a travel has a sign: the spring begins far down the axis, on which it stays.
    const double far = knobs_.groove_half_length;
    const cpVect begin = cpvsub(vect(planar.on_a), cpvmult(vect(planar.axis), far));
    pull(cpDampedSpringNew(a, b, begin, vect(planar.on_b), far + spring.rest, spring.stiffness, spring.damping));
  }

  cpBody* body_at(std::size_t body) const {
    return body == kWorld ? cpSpaceGetStaticBody(space_.get()) : bodies_[body].get();
  }

  // Bodies that a spring ties may collide.
  void pull(cpConstraint* spring) { cpSpaceAddConstraint(space_.get(), joints_.emplace_back(spring).get()); }

  cpConstraint* hold(cpConstraint* constraint) {
    joints_.emplace_back(constraint);
    cpConstraintSetCollideBodies(constraint, cpFalse);
    cpConstraintSetErrorBias(constraint, knobs_.joint_bias);
    return cpSpaceAddConstraint(space_.get(), constraint);
  }

  Knobs knobs_;
  std::optional<ContactMaterial> contact_;
  std::vector<BodyState> initial_;
  std::vector<Owned<cpBody>> bodies_;
  std::vector<Owned<cpShape>> shapes_;
  std::vector<Owned<cpConstraint>> joints_;
  Owned<cpSpace> space_{cpSpaceNew()};  // the last, since it looks at all others when it goes
};

class ChipmunkEngine final : public Engine {
 public:
  ChipmunkEngine() {
    info_.name = "chipmunk";
    info_.library = "Chipmunk";
    info_.version = cpVersionString;
    info_.precision = sizeof(cpFloat) == sizeof(double) ? Precision::kDouble : Precision::kSingle;
    info_.dimension = 2;
    info_.scheme = "explicit Euler: places move with the old velocities; contacts and joints act at the new places";
    info_.features = FeatureSet::joints();
    for (Feature feature :
         {Feature::kForce, Feature::kTorque, Feature::kSphereSphere, Feature::kSphereBox, Feature::kSphereHalfSpace,
          Feature::kBoxHalfSpace, Feature::kBoxBox, Feature::kRestitution, Feature::kFriction,
          Feature::kJointsAndContact, Feature::kCylinderHalfSpace, Feature::kCylinderCylinder, Feature::kCylinderOther,
          Feature::kJointRange, Feature::kSpring, Feature::kJointSpring}) {
      info_.features.insert(feature);
    }
    info_.settings = knob_table().rows();
  }

  const EngineInfo& info() const override { return info_; }

  std::unique_ptr<World> create(const Scenario& scenario, const Settings& settings) const override {
    return std::make_unique<ChipmunkWorld>(scenario, knob_table().read(settings));
  }

 private:
  EngineInfo info_;
};

}  // namespace

std::vector<std::unique_ptr<Engine>> make_engines() {
  std::vector<std::unique_ptr<Engine>> engines;
  engines.push_back(std::make_unique<ChipmunkEngine>());
  return engines;
}

}  // namespace plumbline
