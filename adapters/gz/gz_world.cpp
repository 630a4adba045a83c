#include "gz_world.hpp"

#include <chrono>
#include <cmath>
#include <ignition/physics/FindFeatures.hh>
#include <ignition/physics/ForwardStep.hh>
#include <ignition/physics/FrameSemantics.hh>
#include <ignition/physics/FreeGroup.hh>
#include <ignition/physics/GetContacts.hh>
#include <ignition/physics/GetEntities.hh>
#include <ignition/physics/Joint.hh>
#include <ignition/physics/Link.hh>
#include <ignition/physics/RequestEngine.hh>
#include <ignition/physics/World.hh>
#include <ignition/physics/sdf/ConstructModel.hh>
#include <ignition/physics/sdf/ConstructWorld.hh>
#include <ignition/plugin/Loader.hh>
#include <mutex>
#include <sdf/Model.hh>
#include <sdf/Root.hh>
#include <sdf/World.hh>
#include <stdexcept>
#include <utility>
#include <vector>

#include "gz_profiler.hpp"
#include "gz_scene.hpp"

namespace plumbline {
namespace {

namespace gp = ignition::physics;

struct Needed
    : gp::FeatureList<gp::sdf::ConstructSdfWorld, gp::sdf::ConstructSdfModel, gp::CollisionDetector, gp::Solver,
                      gp::ForwardStep, gp::GetLinkFromModel, gp::GetJointFromModel, gp::LinkFrameSemantics,
                      gp::AddLinkExternalForceTorque, gp::FindFreeGroupFeature, gp::SetFreeGroupWorldVelocity,
                      gp::SetBasicJointState, gp::GetContactsFromLastStepFeature> {};

using Seconds = std::chrono::duration<double>;
using Ticks = std::chrono::steady_clock::duration;

void step_world(gp::World3d<Needed>& world, Ticks dt) {
  gp::ForwardStep::Input input;
  gp::ForwardStep::State state;
  gp::ForwardStep::Output output;
  input.Get<Ticks>() = dt;
  world.Step(output, state, input);
}

gp::Engine3dPtr<Needed> load_engine() {
  static ignition::plugin::Loader loader;  // keeps the plugin in memory from one world to the next
  for (const std::string& name : loader.LoadLib(PLUMBLINE_GZ_DARTSIM_PLUGIN)) {
    if (auto engine = gp::RequestEngine3d<Needed>::From(loader.Instantiate(name))) return engine;
  }
  throw std::runtime_error("no engine with the features that are needed in " PLUMBLINE_GZ_DARTSIM_PLUGIN);
}

gp::World3dPtr<Needed> empty_world(const sdf::World& stated) {
  sdf::World empty;
  empty.SetName(stated.Name());
  empty.SetGravity(stated.Gravity());
  return load_engine()->ConstructWorld(empty);
}

class GzWorld final : public World {
 public:
  GzWorld(const Scenario& scenario, const GzKnobs& knobs) : scenario_(scenario), links_(scenario.bodies.size()) {
    const std::vector<GzGroup> groups = gz_groups(scenario);
    sdf::Root root;
    for (const sdf::Error& error : root.LoadSdfString(gz_scene_text(scenario, groups))) {
      throw std::invalid_argument("SDF refuses the scene: " + error.Message());
    }
    const sdf::World& stated = *root.WorldByIndex(0);
    static std::once_flag first;
    std::call_once(first, [&] { keep_profiler_offline([&] { step_world(*empty_world(stated), Ticks(1)); }); });
    world_ = empty_world(stated);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const auto model = world_->ConstructModel(*stated.ModelByIndex(g));
      if (!model) throw std::runtime_error("the plugin made no model of the scene's group " + std::to_string(g));
      for (const TreeLink& tree_link : groups[g].links) {
        links_[tree_link.body] = model->GetLink(gz_link_name(tree_link.body));
      }
      start(*model, groups[g]);
    }
    // Only now that all shapes are there: those that a detector is given later it finds in an order that depends on
    // addresses in memory, and so would the results.
    // Names that the plugin does not know are left aside with a line on the console.
    world_->SetCollisionDetector(knobs.detector);
    world_->SetSolver(knobs.solver);
    require_taken(world_->GetCollisionDetector() == knobs.detector, "collision_detector", knobs.detector);
    require_taken(world_->GetSolver() == knobs.solver, "solver", knobs.solver);
  }

  void apply(std::span<const Wrench> wrenches) override {
    for (std::size_t i = 0; i < links_.size(); ++i) {
      if (scenario_.bodies[i].fixed) continue;
      // DART would end the process in an assertion.
      if (!wrenches[i].f_W.allFinite() || !wrenches[i].tau_W.allFinite()) {
        throw std::runtime_error("the force on body '" + scenario_.bodies[i].name + "' is not a number");
      }
      links_[i]->AddExternalForce(gp::RelativeForce3d(gp::FrameID::World(), wrenches[i].f_W),
                                  gp::RelativePosition3d(*links_[i], Vec3::Zero()));
      links_[i]->AddExternalTorque(gp::RelativeTorque3d(gp::FrameID::World(), wrenches[i].tau_W));
    }
  }

  void step(double dt) override {
    const Ticks ticks = in_ticks(dt);
    const double taken = Seconds(ticks).count();
    // The plugin would keep the step that it had.
    if (taken != last_dt_ && std::abs(taken - last_dt_) <= kUnnoticedChange) {
      throw std::runtime_error("the plugin overlooks a change of the time step by less than 1e-6 s, here from " +
                               shortest(last_dt_) + " s to " + shortest(dt) + " s");
    }
    last_dt_ = taken;
    step_world(*world_, ticks);
    if (world_->GetContactsFromLastStep().size() >= kMostContacts) {
      throw std::runtime_error("the step may have dropped contacts: the plugin keeps at most " +
                               std::to_string(kMostContacts));
    }
    if (scenario_.contact) require_ground_below();
  }

  void read(std::span<BodyState> states) const override {
    for (std::size_t i = 0; i < links_.size(); ++i) {
      if (scenario_.bodies[i].fixed) {
        states[i] = {scenario_.bodies[i].initial.p_WB, scenario_.bodies[i].initial.q_WB, Vec3::Zero(), Vec3::Zero()};
        continue;
      }
      const gp::FrameData3d body = links_[i]->FrameDataRelativeToWorld();
      states[i] = {body.pose.translation(), Quat(body.pose.linear()), body.linearVelocity, body.angularVelocity};
    }
  }

 private:
  static constexpr double kUnnoticedChange = 1e-6;  // [s]
  static constexpr std::size_t kMostContacts = 10000;
  static constexpr double kHalfPlane = 1050;  // [m]

  static void require_taken(bool taken, const std::string& setting, const std::string& value) {
    if (!taken) throw std::runtime_error("the plugin does not take '" + value + "' for setting '" + setting + "'");
  }

  static Ticks in_ticks(double dt) {
    constexpr double kLongest = 1e9;  // [s], well within what the clock counts
    if (!(dt > 0) || dt > kLongest) throw std::invalid_argument("Gazebo needs a time step in (0, 1e9] s");
    const Ticks ticks = std::chrono::round<Ticks>(Seconds(dt));
    if (ticks.count() == 0) {
      throw std::invalid_argument("Gazebo counts time in whole nanoseconds: a step of " + shortest(dt) + " s is none");
    }
    return ticks;
  }

  // A plane is a cube whose upper side is centred where the plane is stated: what passes its edge would fall on.
  void require_ground_below() const {
    for (const Body& ground : scenario_.bodies) {
      const auto* half = std::get_if<HalfSpace>(&ground.shape);
      if (half == nullptr) continue;
      const Quat q_PW = half_space_attitude(*half).inverse();
      for (std::size_t i = 0; i < links_.size(); ++i) {
        if (scenario_.bodies[i].fixed) continue;
        const Vec3 p_PB = q_PW * (links_[i]->FrameDataRelativeToWorld().pose.translation() - ground.initial.p_WB);
        const double reach = outer_radius(scenario_.bodies[i].shape);
        if (std::abs(p_PB.z()) > reach || p_PB.head<2>().cwiseAbs().maxCoeff() + reach < kHalfPlane) continue;
        throw std::runtime_error("body '" + scenario_.bodies[i].name + "' has come to the edge of half-space '" +
                                 ground.name + "', which reaches " + shortest(kHalfPlane) +
                                 " m from where it is stated");
      }
    }
  }

  static double outer_radius(const Shape& shape) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return sphere->radius;
    const auto* box = std::get_if<Box>(&shape);
    return box != nullptr ? box->size.norm() / 2 : 0;
  }

  void start(gp::Model<gp::FeaturePolicy3d, Needed>& model, const GzGroup& group) {
    for (const TreeLink& tree_link : group.links) {
      const Body& body = scenario_.bodies[tree_link.body];
      if (body.fixed) continue;
      if (!tree_link.joint) {
        const auto free = links_[tree_link.body]->FindFreeGroup();
        if (!free) throw std::runtime_error("body '" + body.name + "' does not float in the plugin");
        free->SetWorldLinearVelocity(body.initial.v_WB);
        free->SetWorldAngularVelocity(body.initial.w_WB);
        continue;
      }
      const auto joint = model.GetJoint(gz_joint_name(tree_link.stated));
      if (!joint) throw std::runtime_error("the plugin left out joint '" + tree_link.joint->name + "'");
      const JointKind kind = tree_link.joint->kind;
      if (kind == JointKind::kHinge || kind == JointKind::kSlider) {
        joint->SetVelocity(0, initial_rate(scenario_, *tree_link.joint));
      } else if (kind == JointKind::kBall) {
        const Vec3 w = initial_relative_rotation(scenario_, *tree_link.joint);
        for (int axis = 0; axis < 3; ++axis) joint->SetVelocity(static_cast<std::size_t>(axis), w[axis]);
      }
    }
  }

  Scenario scenario_;
  gp::World3dPtr<Needed> world_;
  std::vector<gp::Link3dPtr<Needed>> links_;  // in scenario order
  double last_dt_ = 1e-3;                     // DART's own until another is asked for [s]
};

}  // namespace

std::unique_ptr<World> make_gz_world(const Scenario& scenario, const GzKnobs& knobs) {
  return std::make_unique<GzWorld>(scenario, knobs);
}

}  // namespace plumbline
