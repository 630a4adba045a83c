// The in-house simulator: a scenario moved forward by a stated scheme.
//
// It is two things at once: an engine like any other, and the scheme-exact second reference. Told which scheme an
// engine uses, it predicts that engine's trajectory to rounding, so that an error can be explained.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "plumbline/core/collision/contact.hpp"
#include "plumbline/core/collision/shape_impact.hpp"
#include "plumbline/core/feature.hpp"
#include "plumbline/core/kinetics/jointed_motion.hpp"
#include "plumbline/core/kinetics/scheme.hpp"
#include "plumbline/core/response/impulse.hpp"
#include "plumbline/core/trajectory.hpp"

namespace plumbline {

struct SimulatorOptions {
  // Impacts that one step may hold before the simulator gives up: bodies caught between others hit each other
  // without end. Only for ImpactRule::kExactTime.
  int max_events_per_step = 100;
  // Bodies closer than this fraction of their size touch. It must lie above the rounding of positions and of
  // kImpactTolerance, and far below any gap that matters.
  double contact_tolerance = 1e-10;
  // Whether the search for impulses may solve for many points at once (impulse.hpp). Sweeps alone let a box creep next
  // to the angle of friction, and stacks sag.
  Leaps leaps = Leaps::kAllowed;
};

// What a scenario may need for the simulator to run it: all but joints beside contact and contact of cylinders.
// Springs are held over a step like any force.
FeatureSet simulator_features();

// Impacts at their exact time (course slide 24, the simple motion simulator, with one correction: the slide resolves
// all collisions of a step in any order and then advances all bodies once; here the earliest impact comes first, all
// bodies advance to it, it is resolved, and what follows is computed anew).
//
// Within a step, Euler's schemes move bodies along straight lines, with the velocity of their kind, and Verlet along
// parabolas under the held acceleration; that is the motion along which times of impact are sought. After 8 impacts
// in one step Verlet goes through the rest of it like semi-implicit Euler: a box that rocks from corner to corner
// does so infinitely often in a finite time.
//
// Resting contact. A contact that touches and whose approach speed one step of free acceleration explains,
// u <= 2 |a_n| dt with a_n the relative acceleration along the normal without contacts, is at rest: its e is 0. (Bodies
// that are held up, by a fixed one or by others that are, do not fall: a_n is then the larger of the two alone.) So a
// box that lies stays where it is, and a bouncing ball comes to rest once its bounces take less than a few steps.
// The factor 2 leaves room for a contact that was noticed one step late. The rule holds for every ImpactRule.
// Where bodies rest, the impulse of the step acts like a force that is held over it. Of boxes that rest on a box,
// points that touch already stay in touch for the rest of the step, and those that do not may meet anew. Boxes that
// settle upon boxes rock from point to point without end: after 32 impacts in one step, from the first that is too slow
// to rebound, the rest of the step is one straight motion on which no point closes by more than its gap.
//
// Overlap, which ImpactRule::kStepStart produces by its nature, is never pushed out: engines differ in how they
// do that, and it belongs to them.
class Simulator {
 public:
  // Throws std::invalid_argument for a body without mass and for contacts that cannot be computed.
  Simulator(const Scenario& scenario, const Scheme& scheme, const SimulatorOptions& options = {});

  // One wrench per body for the next step only. Throws std::invalid_argument when their number differs.
  void apply(std::span<const Wrench> wrenches);
  // Advances by dt > 0 [s]. Throws std::runtime_error when there are more impacts in the step than the options allow.
  void step(double dt);
  std::span<const BodyState> states() const { return states_; }

 private:
  struct Acceleration {
    Vec3 linear = Vec3::Zero();   // [m/s^2], in W
    Vec3 angular = Vec3::Zero();  // [rad/s^2], in W
  };
  using Accelerations = std::vector<Acceleration>;

  Accelerations free_accelerations() const;
  std::vector<Inertness> inertness() const;
  double tolerance(Pair pair) const;
  double clearance(Pair pair) const;
  bool within_reach(Pair pair, const Accelerations& held, double horizon) const;
  std::vector<Contact> touching() const;

  double rounding_speed(const Contact& contact) const;
  std::vector<bool> held_up(std::span<const Contact> contacts) const;
  double resting_speed(const Contact& contact, const std::vector<bool>& held_up) const;
  bool rests(const Contact& contact) const;
  bool rests_on(Pair pair, std::span<const Contact> contacts) const;

  void step_exact_time(double dt);
  void step_from_start(double dt);
  void kick(double dt);
  void support(std::span<const Contact> contacts, std::span<BodyState> states) const;
  Accelerations supported_accelerations(double duration) const;
  void fly(double duration, bool accelerated);
  std::optional<double> first_impact(const Accelerations& held, double horizon) const;
  std::optional<double> pair_impact(Pair pair, const Accelerations& held, double horizon) const;
  std::optional<double> next_point_meets(Pair pair, std::span<const Contact> contacts, const Motion& a, const Motion& b,
                                         double horizon) const;
  Motion motion(std::size_t body, const Accelerations& held, double horizon) const;
  void move(const Accelerations& held, double horizon, double duration);
  bool resolve_impacts(bool chatter);
  void settle(double duration);

  Scheme scheme_;
  SimulatorOptions options_;
  Vec3 gravity_;
  std::vector<Body> bodies_;
  std::optional<ContactMaterial> material_;
  std::vector<Pair> pairs_;  // empty when bodies pass through each other
  std::vector<BodyState> states_;
  std::vector<Wrench> wrenches_;
  std::optional<JointedMotion> jointed_;  // when joints hold the bodies
  double dt_ = 0;                         // of the current step
  Accelerations free_;                    // of the current step, without contacts
};

// A whole run, initial state included: scenario.step_count(dt) steps, the force laws evaluated at the start of each
// on the states of that moment, or followed within it if the scheme says so. Throws as Simulator does.
Trajectory simulate(const Scenario& scenario, const Scheme& scheme, double dt, const SimulatorOptions& options = {});

}  // namespace plumbline
