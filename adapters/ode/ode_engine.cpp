// ODE behind the door of core/engine.hpp: one adapter, a row for each of its two solvers.
#include <ode/ode.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <stdexcept>

#include "ode_joints.hpp"
#include "ode_knobs.hpp"
#include "plumbline/core/engine.hpp"

namespace plumbline {
namespace {

constexpr int kMaxContactsPerPair = 8;  // box on box, the most of all pairs here
constexpr unsigned long kSeed = 1;

Vec3 vec3(const dReal* v) { return {v[0], v[1], v[2]}; }

// ODE says on standard error when a solver has failed, and goes on with whatever forces it has. A run that goes on from
// there would be a wrong one, so what is said is kept and thrown.
thread_local std::string complaint;

void keep_message(int number, const char* format, va_list arguments) {
  char text[256];
  std::vsnprintf(text, sizeof text, format, arguments);
  if (complaint.empty()) complaint = "ODE message " + std::to_string(number) + ": " + text;
}

class OdeWorld final : public World {
 public:
  OdeWorld(const Scenario& scenario, const OdeKnobs& knobs, OdeSolver solver)
      : knobs_(knobs), solver_(solver), gravity_(scenario.gravity.norm()), contact_(scenario.contact) {
    dWorldSetGravity(world_, scenario.gravity.x(), scenario.gravity.y(), scenario.gravity.z());
    dWorldSetERP(world_, knobs.erp);
    dWorldSetCFM(world_, knobs.cfm);
    dWorldSetContactMaxCorrectingVel(world_, knobs.max_correcting_velocity);
    dWorldSetContactSurfaceLayer(world_, knobs.surface_layer);
    dWorldSetAutoDisableFlag(world_, knobs.auto_disable);
    dWorldSetLinearDamping(world_, knobs.linear_damping);
    dWorldSetAngularDamping(world_, knobs.angular_damping);
    if (solver == OdeSolver::kQuickStep) {
      dWorldSetQuickStepNumIterations(world_, knobs.iterations);
      dWorldSetQuickStepW(world_, knobs.over_relaxation);
    }
    try {
      for (const Body& body : scenario.bodies) add(body);
      for (const Joint& joint : scenario.joints) {
        add_ode_joint(world_, joint, joint.a == kWorld ? nullptr : residents_[joint.a].body, residents_[joint.b].body,
                      knobs.stop_erp);
      }
    } catch (...) {
      destroy();
      throw;
    }
  }

  ~OdeWorld() override { destroy(); }

  void apply(std::span<const Wrench> wrenches) override {
    for (std::size_t i = 0; i < residents_.size(); ++i) {
      if (residents_[i].body == nullptr) continue;
      const Vec3 &f = wrenches[i].f_W, &tau = wrenches[i].tau_W;
      dBodyAddForce(residents_[i].body, f.x(), f.y(), f.z());
      dBodyAddTorque(residents_[i].body, tau.x(), tau.y(), tau.z());
    }
  }

  void step(double dt) override {
    if (!(dt > 0)) throw std::invalid_argument("dt must be > 0, is " + shortest(dt));
    if (knobs_.correct_within_gravity_step) {
      dWorldSetContactMaxCorrectingVel(world_, std::min(knobs_.max_correcting_velocity, gravity_ * dt));
    }
    if (contact_) dSpaceCollide(space_, this, &OdeWorld::touch);
    // QuickStep shuffles its constraints with a random generator that the whole process shares. Each world keeps its
    // own place in the sequence, so that a run gives the same bits whatever else has run.
    dRandSetSeed(seed_);
    complaint.clear();
    const int done = solver_ == OdeSolver::kStep ? dWorldStep(world_, dt) : dWorldQuickStep(world_, dt);
    seed_ = dRandGetSeed();
    dJointGroupEmpty(contacts_);
    if (done == 0) throw std::runtime_error("the step failed: ODE could not allocate its working memory");
    if (!complaint.empty()) throw std::runtime_error("the step failed: " + complaint);
  }

  void read(std::span<BodyState> states) const override {
    for (std::size_t i = 0; i < residents_.size(); ++i) {
      const dBodyID body = residents_[i].body;
      if (body == nullptr) {
        states[i] = residents_[i].fixed;
        continue;
      }
      const dReal* q = dBodyGetQuaternion(body);
      states[i].p_WB = vec3(dBodyGetPosition(body));
      states[i].q_WB = Quat(q[0], q[1], q[2], q[3]);
      states[i].v_WB = vec3(dBodyGetLinearVel(body));
      states[i].w_WB = vec3(dBodyGetAngularVel(body));
    }
  }

 private:
  struct Resident {
    dBodyID body = nullptr;  // none: fixed
    BodyState fixed;         // what read() says of a body that never moves
  };

  void add(const Body& body) {
    const Vec3& p = body.initial.p_WB;
    const Quat& q_WB = body.initial.q_WB;
    const dQuaternion q = {q_WB.w(), q_WB.x(), q_WB.y(), q_WB.z()};
    dGeomID geometry = nullptr;
    Resident r;
    r.fixed.p_WB = p;
    r.fixed.q_WB = q_WB;
    if (const auto* half = std::get_if<HalfSpace>(&body.shape)) {
      const Vec3& n = half->normal;
      dCreatePlane(space_, n.x(), n.y(), n.z(), n.dot(p));
      residents_.push_back(r);
      return;
    }
    if (const auto* sphere = std::get_if<Sphere>(&body.shape)) {
      geometry = dCreateSphere(space_, sphere->radius);
    } else if (const auto* cylinder = std::get_if<Cylinder>(&body.shape)) {
      geometry = dCreateCylinder(space_, cylinder->radius, cylinder->height);
    } else {
      const Vec3& size = std::get<Box>(body.shape).size;
      geometry = dCreateBox(space_, size.x(), size.y(), size.z());
    }
    if (!body.fixed) {
      dMass mass;
      dMassSetParameters(&mass, body.mass, 0, 0, 0, body.inertia.x(), body.inertia.y(), body.inertia.z(), 0, 0, 0);
      const Vec3 &v = body.initial.v_WB, &w = body.initial.w_WB;
      r.body = dBodyCreate(world_);
      dBodySetMass(r.body, &mass);
      dBodySetGyroscopicMode(r.body, knobs_.gyroscopic);
      dBodySetLinearVel(r.body, v.x(), v.y(), v.z());
      dBodySetAngularVel(r.body, w.x(), w.y(), w.z());
      dGeomSetBody(geometry, r.body);
    }
    // Through the geometry: it moves its body with it.
    dGeomSetPosition(geometry, p.x(), p.y(), p.z());
    dGeomSetQuaternion(geometry, q);
    residents_.push_back(r);
  }

  static void touch(void* self, dGeomID a, dGeomID b) { static_cast<OdeWorld*>(self)->connect(a, b); }

  void connect(dGeomID a, dGeomID b) {
    const dBodyID body_a = dGeomGetBody(a), body_b = dGeomGetBody(b);
    if (body_a == nullptr && body_b == nullptr) return;
    if (body_a != nullptr && body_b != nullptr && dAreConnectedExcluding(body_a, body_b, dJointTypeContact)) return;
    dContact contacts[kMaxContactsPerPair] = {};
    const int count = dCollide(a, b, kMaxContactsPerPair, &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      dContact& c = contacts[i];
      c.surface.mode = dContactBounce;
      c.surface.bounce = contact_->restitution;
      c.surface.bounce_vel = knobs_.bounce_threshold;
      c.surface.mu = contact_->friction;
      if (knobs_.friction != OdeFriction::kForceLimit) c.surface.mode |= dContactApprox1;
      if (knobs_.friction == OdeFriction::kAlignedPyramid) align_friction(c, body_a, body_b);
      dJointAttach(dJointCreateContact(world_, contacts_, &c), body_a, body_b);
    }
  }

  // Turns the friction pyramid so that its first axis is the direction of sliding. A pyramid along the world's axes
  // would brake by up to sqrt(2) too much.
  static void align_friction(dContact& c, dBodyID body_a, dBodyID body_b) {
    const dReal* p = c.geom.pos;
    const auto point_velocity = [p](dBodyID body) -> Vec3 {
      if (body == nullptr) return Vec3::Zero();
      dVector3 v;
      dBodyGetPointVel(body, p[0], p[1], p[2], v);
      return vec3(v);
    };
    const Vec3 n = vec3(c.geom.normal);
    const Vec3 v = point_velocity(body_a) - point_velocity(body_b);
    const Vec3 slip = v - v.dot(n) * n;
    // Below the rounding of v the direction of what is left of it means nothing.
    if (!(slip.norm() > 1e-12 * (1 + v.norm()))) return;
    const Vec3 direction = slip.normalized();
    c.surface.mode |= dContactFDir1;
    std::copy_n(direction.data(), 3, c.fdir1);
  }

  void destroy() {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);  // and the geometries in it
    dWorldDestroy(world_);  // and the bodies in it
  }

  OdeKnobs knobs_;
  OdeSolver solver_;
  double gravity_;  // magnitude [m/s^2]
  std::optional<ContactMaterial> contact_;
  unsigned long seed_ = kSeed;
  dWorldID world_ = dWorldCreate();
  dSpaceID space_ = dSimpleSpaceCreate(nullptr);
  dJointGroupID contacts_ = dJointGroupCreate(0);
  std::vector<Resident> residents_;
};

class OdeEngine final : public Engine {
 public:
  explicit OdeEngine(OdeSolver solver) : solver_(solver), knobs_(ode_knob_table(solver)) {
    // Once per process, before any other call; ODE cannot be initialised anew after it was closed.
    static const bool ready = dInitODE2(0) != 0 && dAllocateODEDataForThread(dAllocateMaskAll) != 0;
    if (!ready) throw std::runtime_error("ODE could not be initialised");
    info_.name = solver == OdeSolver::kStep ? "ode-step" : "ode-quickstep";
    info_.library = "Open Dynamics Engine";
    info_.version = dODE_VERSION;  // the header's: the library cannot tell
    info_.precision = sizeof(dReal) == sizeof(double) ? Precision::kDouble : Precision::kSingle;
    info_.scheme = "semi-implicit Euler";
    dSetMessageHandler(keep_message);
    using enum Feature;
    info_.features = {kSpatial,         kForce,        kTorque,    kSphereSphere,      kSphereBox,
                      kSphereHalfSpace, kBoxHalfSpace, kBoxBox,    kCylinderHalfSpace, kCylinderCylinder,
                      kCylinderOther,   kRestitution,  kFriction,  kBallJoint,         kHinge,
                      kSlider,          kFixedJoint,   kJointLoop, kDistanceJoint,     kJointRange,
                      kJointsAndContact};
    info_.settings = knobs_.rows();
  }

  const EngineInfo& info() const override { return info_; }

  std::unique_ptr<World> create(const Scenario& scenario, const Settings& settings) const override {
    return std::make_unique<OdeWorld>(scenario, knobs_.read(settings), solver_);
  }

 private:
  OdeSolver solver_;
  KnobTable<OdeKnobs> knobs_;
  EngineInfo info_;
};

}  // namespace

std::vector<std::unique_ptr<Engine>> make_engines() {
  std::vector<std::unique_ptr<Engine>> engines;
  engines.push_back(std::make_unique<OdeEngine>(OdeSolver::kStep));
  engines.push_back(std::make_unique<OdeEngine>(OdeSolver::kQuickStep));
  return engines;
}

}  // namespace plumbline
