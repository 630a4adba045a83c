// Gazebo's physics layer behind the door of core/engine.hpp: its plugin for DART.
#include <ignition/physics/config.hh>

#include "gz_world.hpp"
#include "plumbline/adapters/knob_table.hpp"

namespace plumbline {
namespace {

// Names that the layer itself takes.
std::vector<std::pair<std::string, std::string>> names(const std::vector<std::string>& words) {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const std::string& word : words) pairs.emplace_back(word, word);
  return pairs;
}

KnobTable<GzKnobs> knob_table() {
  return KnobTable<GzKnobs>()
      .choose(&GzKnobs::detector, "collision_detector", names({"ode", "bullet", "fcl", "dart"}), "ode", "ode",
              "who finds contacts")
      .choose(&GzKnobs::solver, "solver",
              {{"dantzig", std::string("DantzigBoxedLcpSolver")}, {"pgs", std::string("PgsBoxedLcpSolver")}}, "dantzig",
              "dantzig", "who solves them; pgs sweeps 30 times and is less exact");
}

class GzEngine final : public Engine {
 public:
  GzEngine() : knobs_(knob_table()) {
    info_.name = "gz-dartsim";
    info_.library = "Gazebo physics with DART";
    info_.version = IGNITION_PHYSICS_VERSION_FULL;  // the header's: the library cannot tell
    info_.scheme = "semi-implicit Euler in joint coordinates, each step rounded to whole nanoseconds";
    info_.features = {Feature::kSpatial,      Feature::kForce,      Feature::kTorque,
                      Feature::kSphereSphere, Feature::kSphereBox,  Feature::kSphereHalfSpace,
                      Feature::kBoxHalfSpace, Feature::kBoxBox,     Feature::kRestitution,
                      Feature::kFriction,     Feature::kBallJoint,  Feature::kHinge,
                      Feature::kSlider,       Feature::kFixedJoint, Feature::kJointsAndContact};
    info_.settings = knobs_.rows();
  }

  const EngineInfo& info() const override { return info_; }

  std::unique_ptr<World> create(const Scenario& scenario, const Settings& settings) const override {
    return make_gz_world(scenario, knobs_.read(settings));
  }

 private:
  KnobTable<GzKnobs> knobs_;
  EngineInfo info_;
};

}  // namespace

std::vector<std::unique_ptr<Engine>> make_engines() {
  std::vector<std::unique_ptr<Engine>> engines;
  engines.push_back(std::make_unique<GzEngine>());
  return engines;
}

}  // namespace plumbline
