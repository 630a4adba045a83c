// DART behind the door of core/engine.hpp: a row for each solver of contacts.
#include <dart/config.hpp>
#include <limits>
#include <stdexcept>

#include "dart_world.hpp"
#include "plumbline/adapters/knob_table.hpp"

namespace plumbline {
namespace {

KnobTable<DartKnobs> knob_table(LcpSolver solver) {
  using K = DartKnobs;
  const double unlimited = std::numeric_limits<double>::infinity();
  KnobTable<K> table;
  table
      .choose(
          &K::detector, "collision_detector", {{"ode", Detector::kOde}, {"fcl", Detector::kFcl}}, "ode", "ode",
          "who finds contacts; fcl is what World::create() has, but it knows no half-space and takes a sphere for a "
          "mesh, so that its users switch to ode")
      .choose(&K::friction_axis, "friction_axis", {{"fixed", FrictionAxis::kFixed}, {"motion", FrictionAxis::kMotion}},
              "fixed", "motion",
              "first axis of the square friction pyramid: along y or x, or the way that the first body of a pair would "
              "slide without friction, where the pyramid does what Coulomb's cone does")
      .add(&K::error_reduction, "error_reduction", 0.01, 0.2, "1",
           "share of the penetration that a step corrects, by real velocity")
      .add(&K::max_error_reduction_velocity, "max_error_reduction_velocity", 1e-3, unlimited, "m/s",
           "the most of that velocity; DART's own leaves bodies where they sank in for minutes")
      .add(&K::correct_within_gravity_step, "correct_within_gravity_step", false, true, "",
           "also limits that velocity to |g| dt, which gravity takes back within one step; without it e = 0 rebounds "
           "with up to error_reduction times the approach speed")
      .add(&K::error_allowance, "error_allowance", 0, 0, "m", "penetration that is left alone")
      .add(&K::force_mixing, "constraint_force_mixing", 1e-5, 1e-7, "1",
           "softness of contacts as a share of their inverse mass; with 1e-9, the least that DART takes, Dantzig's "
           "solver fails on the four corners of a box and leaves the work to its fallback")
      .add(&K::loop_error_reduction, "loop_error_reduction", 0.01, 0.2, "1",
           "share of the gap that a step closes in joints that close a loop");
  if (solver == LcpSolver::kDantzig) {
    table.add(&K::pgs_fallback, "pgs_fallback", true, true, "", "asks the PGS solver where Dantzig's fails");
  }
  return table
      .add(&K::pgs_iterations, "pgs_iterations", 30, 1000, "", "sweeps of PGS over the constraints of a step, at most")
      .add(&K::pgs_absolute_change, "pgs_absolute_change", 1e-6, 1e-14, "N s", "a smaller change ends the sweeps")
      .add(&K::pgs_relative_change, "pgs_relative_change", 1e-3, 1e-12, "1",
           "a smaller change, as a share of the impulse, ends the sweeps");
}

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument("setting " + what);
}

// DART would correct these, say so on its console and go on.
void require_range(const DartKnobs& k) {
  require(k.error_reduction >= 0 && k.error_reduction <= 1, "'error_reduction' must lie in [0, 1]");
  require(k.loop_error_reduction >= 0 && k.loop_error_reduction <= 1, "'loop_error_reduction' must lie in [0, 1]");
  require(k.max_error_reduction_velocity >= 0, "'max_error_reduction_velocity' must be >= 0");
  require(k.error_allowance >= 0, "'error_allowance' must be >= 0");
  require(k.force_mixing >= 1e-9 && k.force_mixing <= 1, "'constraint_force_mixing' must lie in [1e-9, 1]");
}

class DartEngine final : public Engine {
 public:
  explicit DartEngine(LcpSolver solver) : solver_(solver), knobs_(knob_table(solver)) {
    info_.name = solver == LcpSolver::kDantzig ? "dart-dantzig" : "dart-pgs";
    info_.library = "DART";
    info_.version = DART_VERSION;  // the header's: the library cannot tell
    info_.scheme = "semi-implicit Euler in joint coordinates";
    info_.features = {
        Feature::kSpatial,          Feature::kForce,           Feature::kTorque,           Feature::kSphereSphere,
        Feature::kSphereBox,        Feature::kSphereHalfSpace, Feature::kBoxHalfSpace,     Feature::kBoxBox,
        Feature::kRestitution,      Feature::kFriction,        Feature::kBallJoint,        Feature::kHinge,
        Feature::kSlider,           Feature::kFixedJoint,      Feature::kJointsAndContact, Feature::kCylinderHalfSpace,
        Feature::kCylinderCylinder, Feature::kCylinderOther,   Feature::kJointRange,       Feature::kJointSpring};
    // Dantzig's solver gives wrong answers to what a hinge that closes a loop says twice, without noticing.
    if (solver == LcpSolver::kPgs) info_.features.insert(Feature::kJointLoop);
    info_.settings = knobs_.rows();
  }

  const EngineInfo& info() const override { return info_; }

  std::unique_ptr<World> create(const Scenario& scenario, const Settings& settings) const override {
    DartKnobs knobs = knobs_.read(settings);
    knobs.solver = solver_;
    require_range(knobs);
    return make_dart_world(scenario, knobs);
  }

 private:
  LcpSolver solver_;
  KnobTable<DartKnobs> knobs_;
  EngineInfo info_;
};

}  // namespace

std::vector<std::unique_ptr<Engine>> make_engines() {
  std::vector<std::unique_ptr<Engine>> engines;
  engines.push_back(std::make_unique<DartEngine>(LcpSolver::kDantzig));
  engines.push_back(std::make_unique<DartEngine>(LcpSolver::kPgs));
  return engines;
}

}  // namespace plumbline
