// MuJoCo behind the door of core/engine.hpp: one adapter, a row for each of its integrators.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mujoco_model.hpp"
#include "plumbline/adapters/knob_table.hpp"
#include "plumbline/core/engine.hpp"

namespace plumbline {
namespace {

enum class Response { kSolref, kOneStep };

struct Knobs {
  Response response;
  double time_constant, damping_ratio;
  double impedance_min, impedance_max, impedance_width;
  double sliding_damping, recovery_time, drift_share;
  mjtCone cone;
  double friction_impedance;
  mjtSolver solver;
  int iterations;
  double tolerance;
};

// A constraint of MuJoCo asks for the acceleration -b v - k r at velocity v and violation r, and gets d of it, 0 < d <
// 1; the rest is what the bodies would do without it. Euler's step then leaves v (1 - b dt) - k r dt: b = (1 + e)/dt is
// Newton's restitution, exact for any e and at any dt, where a contact stands alone. b is divided by d within MuJoCo.
const KnobTable<Knobs>& knob_table() {
  static const KnobTable<Knobs> table =
      KnobTable<Knobs>()
          .choose(&Knobs::response, "response", {{"solref", Response::kSolref}, {"one_step", Response::kOneStep}},
                  "solref", "one_step",
                  "what contacts, stops of joints and closed loops ask for: solref, the spring and damper of MuJoCo's "
                  "parameter of that "
                  "name, the same for every material; one_step, the velocity that restitution states at the end of the "
                  "step, also along the surface where friction would hold: a contact has one damping")
          .add(&Knobs::time_constant, "time_constant", 0.02, 0.02, "s", "of solref; MuJoCo takes 2 dt at least")
          .add(&Knobs::damping_ratio, "damping_ratio", 1, 1, "1", "of solref")
          .add(&Knobs::impedance_min, "impedance_min", 0.9, 0.9999, "1",
               "share of what a constraint asks for that it gets at the first touch; 0.9999 is the most MuJoCo takes")
          .add(&Knobs::impedance_max, "impedance_max", 0.95, 0.9999, "1", "the same at the depth impedance_width")
          .add(&Knobs::impedance_width, "impedance_width", 0.001, 0.001, "m", "depth of the transition between the two")
          .add(&Knobs::sliding_damping, "sliding_damping", 10, 10, "1/s",
               "b of one_step where there is friction and no restitution: MuJoCo's convex law throws up what slides "
               "at v, by mu b v; less than g, it stays on the ground, and impacts take 1/b")
          .add(&Knobs::recovery_time, "recovery_time", 0.25, 0.25, "s",
               "of one_step: contacts push penetration out with (1 - e) depth/recovery_time where there is gravity; "
               "without it nothing rests, and the correction would only be a rebound")
          .add(&Knobs::drift_share, "drift_share", 1, 1, "1",
               "of one_step: share of the drift of a closed loop or a rod that a step corrects; MuJoCo leaves out the "
               "acceleration that turning ties need, so a rod drifts by v^2 dt^2/(length share)")
          .choose(&Knobs::cone, "cone", {{"pyramidal", mjCONE_PYRAMIDAL}, {"elliptic", mjCONE_ELLIPTIC}}, "pyramidal",
                  "elliptic", "shape of the friction law; the pyramid's edges lie within Coulomb's cone")
          .add(&Knobs::friction_impedance, "friction_impedance", 1, 1, "1",
               "impratio: how much stiffer friction is than the normal direction, of the elliptic cone")
          .choose(&Knobs::solver, "solver", {{"pgs", mjSOL_PGS}, {"cg", mjSOL_CG}, {"newton", mjSOL_NEWTON}}, "newton",
                  "newton", "of the convex problem of each step")
          .add(&Knobs::iterations, "iterations", 100, 100, "", "of the solver, at most")
          .add(&Knobs::tolerance, "tolerance", 1e-8, 0.0, "1",
               "improvement at which the solver stops; at 1e-8 stiff contacts keep momentum to 1e-13 only");
  return table;
}

class MujocoWorld final : public World {
 public:
  MujocoWorld(const Scenario& scenario, const Knobs& knobs, mjtIntegrator integrator)
      : knobs_(knobs),
        restitution_(scenario.contact ? scenario.contact->restitution : 0),
        tree_(joint_tree(scenario)),
        model_(mujoco_model(scenario, tree_)),
        data_(mj_makeData(model_.get())),
        view_(mj_makeData(model_.get())) {
    mjOption& option = model_->opt;
    std::copy_n(scenario.gravity.data(), 3, option.gravity);
    option.integrator = integrator;
    option.cone = knobs.cone;
    option.impratio = knobs.friction_impedance;
    option.solver = knobs.solver;
    option.iterations = knobs.iterations;
    option.tolerance = knobs.tolerance;
    sliding_ = restitution_ == 0 && scenario.contact && scenario.contact->friction > 0;
    // A Runge-Kutta step with b dt = 2 stops at half of it and stays. A rebound it cannot give at any b: its four
    // evaluations see the contact at four depths, some of them none.
    damping_ = integrator == mjINT_RK4 ? 2 : 1 + restitution_;
    recovers_ = scenario.gravity.norm() > 0;
    for (const Body& body : scenario.bodies) fixed_.push_back({body.initial.p_WB, body.initial.q_WB});
    for (const TreeLink& link : tree_.links) start(scenario, link);
  }

  void apply(std::span<const Wrench> wrenches) override {
    for (const Resident& r : residents_) {
      std::copy_n(wrenches[r.body].f_W.data(), 3, data_->xfrc_applied + 6 * r.id);
      std::copy_n(wrenches[r.body].tau_W.data(), 3, data_->xfrc_applied + 6 * r.id + 3);
    }
  }

  void step(double dt) override {
    if (dt != model_->opt.timestep || !prepared_) prepare(dt);
    mj_step(model_.get(), data_.get());
    mju_zero(data_->xfrc_applied, 6 * model_->nbody);  // would act for ever
    for (int i = 0; i < mjNWARNING; ++i) {
      if (data_->warning[i].number == 0) continue;
      // It goes on from its initial state, or without the contacts that found no room.
      throw std::runtime_error(std::string("MuJoCo warns: ") +
                               mju_warningText(i, static_cast<std::size_t>(data_->warning[i].lastinfo)));
    }
  }

  void read(std::span<BodyState> states) const override {
    std::copy(fixed_.begin(), fixed_.end(), states.begin());
    // Derived quantities lag behind after a step, and computing them in place would change the next one.
    mju_copy(view_->qpos, data_->qpos, model_->nq);
    mju_copy(view_->qvel, data_->qvel, model_->nv);
    mj_kinematics(model_.get(), view_.get());
    mj_comPos(model_.get(), view_.get());
    mj_comVel(model_.get(), view_.get());
    for (const Resident& r : residents_) {
      BodyState& s = states[r.body];
      const mjtNum* q = r.free ? data_->qpos + r.position + 3 : view_->xquat + 4 * r.id;
      std::copy_n(r.free ? data_->qpos + r.position : view_->xpos + 3 * r.id, 3, s.p_WB.data());
      s.q_WB = Quat(q[0], q[1], q[2], q[3]);
      if (r.free) {  // linear in W, angular in the body's own axes
        std::copy_n(data_->qvel + r.velocity, 3, s.v_WB.data());
        mju_rotVecQuat(s.w_WB.data(), data_->qvel + r.velocity + 3, q);
      } else {
        mjtNum twist[6];
        mj_objectVelocity(model_.get(), view_.get(), mjOBJ_BODY, r.id, twist, 0);
        std::copy_n(twist, 3, s.w_WB.data());
        std::copy_n(twist + 3, 3, s.v_WB.data());
      }
    }
  }

 private:
  struct Resident {
    std::size_t body;                // in the scenario
    int id;                          // in the model
    bool free;                       // it floats: the coordinates are those of the body itself
    int position = 0, velocity = 0;  // first place in qpos and qvel
  };

  void start(const Scenario& scenario, const TreeLink& link) {
    const std::string name = mujoco_name(link.body);
    Resident r{link.body, mj_name2id(model_.get(), mjOBJ_BODY, name.c_str()), !link.joint};
    const int joint = mj_name2id(model_.get(), mjOBJ_JOINT, name.c_str());
    if (joint >= 0) {
      r.position = model_->jnt_qposadr[joint];
      r.velocity = model_->jnt_dofadr[joint];
    }
    mjtNum* qvel = data_->qvel + r.velocity;
    const BodyState& s = scenario.bodies[link.body].initial;
    if (r.free) {
      mjtNum* qpos = data_->qpos + r.position;
      const mjtNum q[4] = {s.q_WB.w(), s.q_WB.x(), s.q_WB.y(), s.q_WB.z()};
      mjtNum back[4];
      mju_negQuat(back, q);
      std::copy_n(s.p_WB.data(), 3, qpos);
      std::copy_n(q, 4, qpos + 3);
      std::copy_n(s.v_WB.data(), 3, qvel);
      mju_rotVecQuat(qvel + 3, s.w_WB.data(), back);
    } else if (link.joint->kind == JointKind::kBall) {
      std::copy_n(initial_relative_rotation(scenario, *link.joint).data(), 3, qvel);
    } else if (joint >= 0) {
      *qvel = initial_rate(scenario, *link.joint);
    }
    residents_.push_back(r);
  }

  // What a constraint asks for depends on the length of the step.
  void prepare(double dt) {
    if (!(dt > 0 && std::isfinite(dt))) throw std::invalid_argument("a step needs dt > 0, is " + shortest(dt));
    const bool solref = knobs_.response == Response::kSolref;
    const auto set = [&](mjtNum* ref, mjtNum* imp, int count, double k, double b) {
      for (int i = 0; i < count; ++i) {
        ref[mjNREF * i] = solref ? knobs_.time_constant : -k;  // two negative numbers are stiffness and damping
        ref[mjNREF * i + 1] = solref ? knobs_.damping_ratio : -b;
        const mjtNum impedance[] = {knobs_.impedance_min, knobs_.impedance_max, knobs_.impedance_width};
        std::copy_n(impedance, 3, imp + mjNIMP * i);
      }
    };
    const double b = sliding_ ? std::min(knobs_.sliding_damping, damping_ / dt) : damping_ / dt;
    const double k = recovers_ ? (1 - restitution_) * std::min(b / knobs_.recovery_time, b * b / 4) : 0;
    set(model_->pair_solref, model_->pair_solimp, model_->npair, k, b);
    // The stops of joints are plastic, whatever the contacts are.
    const double stop = (model_->opt.integrator == mjINT_RK4 ? 2 : 1) / dt;
    set(model_->jnt_solref, model_->jnt_solimp, model_->njnt,
        recovers_ ? std::min(stop / knobs_.recovery_time, stop * stop / 4) : 0, stop);
    set(model_->eq_solref, model_->eq_solimp, model_->neq, knobs_.drift_share / (dt * dt), 1 / dt);
    model_->opt.timestep = dt;
    prepared_ = true;
  }

  Knobs knobs_;
  double restitution_, damping_ = 0;
  bool recovers_ = false, sliding_ = false;
  JointTree tree_;
  MujocoModel model_;
  MujocoData data_, view_;
  std::vector<BodyState> fixed_;
  std::vector<Resident> residents_;
  bool prepared_ = false;
};

void raise(const char* message) { throw std::runtime_error(std::string("MuJoCo stops: ") + message); }

class MujocoEngine final : public Engine {
 public:
  MujocoEngine(std::string row, std::string scheme, mjtIntegrator integrator) : integrator_(integrator) {
    // Unset, they write a file into the working directory, and an error ends the process.
    mju_user_error = raise;
    mju_user_warning = [](const char*) {};
    info_.name = std::move(row);
    info_.library = "MuJoCo";
    info_.version = mj_versionString();
    info_.scheme = std::move(scheme);
    info_.features = FeatureSet::joints();
    for (Feature f : {Feature::kSpatial, Feature::kForce, Feature::kTorque, Feature::kSphereSphere, Feature::kSphereBox,
                      Feature::kSphereHalfSpace, Feature::kBoxHalfSpace, Feature::kBoxBox, Feature::kFriction,
                      Feature::kJointsAndContact, Feature::kCylinderHalfSpace, Feature::kCylinderCylinder,
                      Feature::kCylinderOther, Feature::kJointRange, Feature::kSpring, Feature::kJointSpring}) {
      info_.features.insert(f);
    }
    if (integrator != mjINT_RK4) info_.features.insert(Feature::kRestitution);
    info_.settings = knob_table().rows();
  }

  const EngineInfo& info() const override { return info_; }

  std::unique_ptr<World> create(const Scenario& scenario, const Settings& settings) const override {
    return std::make_unique<MujocoWorld>(scenario, knob_table().read(settings), integrator_);
  }

 private:
  mjtIntegrator integrator_;
  EngineInfo info_;
};

}  // namespace

std::vector<std::unique_ptr<Engine>> make_engines() {
  std::vector<std::unique_ptr<Engine>> engines;
  engines.push_back(std::make_unique<MujocoEngine>("mujoco-euler", "semi-implicit Euler", mjINT_EULER));
  engines.push_back(std::make_unique<MujocoEngine>(
      "mujoco-implicit", "semi-implicit Euler, implicit in the forces of rotation", mjINT_IMPLICIT));
  engines.push_back(std::make_unique<MujocoEngine>("mujoco-rk4", "Runge-Kutta of fourth order", mjINT_RK4));
  return engines;
}

}  // namespace plumbline
