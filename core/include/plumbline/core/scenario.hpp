// A scenario: the stated problem, complete and free of any engine.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "plumbline/core/body.hpp"
#include "plumbline/core/certificate.hpp"
#include "plumbline/core/force_element.hpp"
#include "plumbline/core/gate.hpp"
#include "plumbline/core/joints/joint.hpp"
#include "plumbline/core/threshold.hpp"

namespace plumbline {

class FeatureSet;

// What happens where two bodies touch. It is stated per pair: how an engine combines per-body coefficients
// (product, maximum, square root ...) is its adapter's business.
struct ContactMaterial {
  double restitution = 0;  // Newton's e in [0, 1]: v_n+ = -e v_n-
  double friction = 0;     // Coulomb's mu >= 0, the same for sticking and sliding
};

// A force law: what acts on one body as a function of time [s] and that body's own state.
struct ForceLaw {
  std::size_t body = 0;
  std::function<Wrench(double t, const BodyState&)> evaluate;
  // Whether motion within the x-z plane depends on y, vy or rotation out of the plane, and whether the law
  // itself turns the body out of the plane. A planar engine needs to know.
  bool couples_out_of_plane = false;
  bool has_torque = false;  // a torque is stated, or the force acts off the centre of mass
  std::string text;         // as written, for people
};

// Something that the reference says happens at an exact time: bodies a and b touch.
struct Event {
  std::string name;
  std::size_t body_a = 0, body_b = 0;
  double time = 0;  // [s]
};

// Characteristic magnitudes. Dividing by them makes every tolerance dimensionless.
struct Scales {
  double length = 1;  // [m]
  double time = 1;    // [s]
  double mass = 1;    // [kg]
  double velocity() const { return length / time; }
  double energy() const { return mass * velocity() * velocity(); }
  double momentum() const { return mass * velocity(); }
};

using Parameters = std::vector<std::pair<std::string, double>>;  // in the order of the file

// How long one is ready to wait. Every tier runs the cases of the tiers before it too; smoke takes the first of their
// steps only, one dt a case.
enum class Tier { kSmoke, kStandard, kFull };
std::string_view tier_name(Tier tier);  // "smoke", "standard", "full"

struct Scenario {
  std::string id;         // "family/case"
  std::string about;      // one line
  std::string source;     // citation: slide, paper, page
  Parameters parameters;  // the values of this case, all of them
  Parameters swept;       // the part of them that tells this case from its siblings

  Vec3 gravity = Vec3::Zero();  // [m/s^2]
  double duration = 0;          // [s]
  std::vector<double> steps;    // the dt to run [s]
  Scales scales;

  std::vector<Body> bodies;
  // A joint's b always moves; its a moves too or is kWorld, never a body that is fixed. The initial states hold every
  // joint, in place and in velocity. Bodies that a joint ties to each other do not collide.
  std::vector<Joint> joints;
  std::vector<ForceLaw> forces;
  std::vector<Spring> springs;
  std::vector<JointSpring> joint_springs;
  std::vector<JointDrive> drives;
  std::optional<ContactMaterial> contact;  // none: bodies pass through each other

  std::vector<Event> events;  // in order of time
  std::vector<Gate> gates;
  // Beyond it pointwise comparison means nothing (chaos) [s].
  double t_valid = std::numeric_limits<double>::infinity();
  // What the reference knows of the motion: false where only invariants are known (the expected states are then the
  // initial ones), and with times [s] where it is known at those alone.
  bool pointwise = true;
  std::vector<double> known_at;
  std::optional<Threshold> threshold;  // a yes/no question instead of a motion
  std::vector<Certificate> certificates;
  Tier tier = Tier::kStandard;  // the first that runs this case

  // "particle/drag_ship" or "collision/two_sphere/e=0.5,b=0": unique among all cases of all files.
  std::string case_name() const;
  // Number of whole steps of dt that fit into the duration (a step that misses by rounding counts).
  std::size_t step_count(double dt) const;
  std::size_t body_index(const std::string& name) const;  // throws std::out_of_range
};

// Whether a joint ties these two bodies to each other.
bool joined(const Scenario& scenario, std::size_t body, std::size_t other);

// Throws std::invalid_argument, naming body or joint and the way out, for a scenario that no engine can be asked to
// run: numbers that are not finite, moving bodies without mass or inertia, joints of bodies that do not exist, are
// fixed, or do not hold in the initial states.
void require_sound(const Scenario& scenario);

// The moving bodies and the joints as the core's own joint functions want them; fixed bodies get a unit mass, which
// matters to nobody since no joint leads to them.
ArticulatedBody articulated_body(const Scenario& scenario);

// Whether anything but gravity, joints and contact acts, apart from springs that `native` says the engine has itself.
bool has_forces(const Scenario& scenario, const FeatureSet& native);
// The sum of all force laws, springs and drives on each body at time t [s] and these states, but for the springs that
// are native; both spans hold one entry per body.
void evaluate_forces(const Scenario& scenario, double t, std::span<const BodyState> states, std::span<Wrench> wrenches,
                     const FeatureSet& native);
void evaluate_forces(const Scenario& scenario, double t, std::span<const BodyState> states, std::span<Wrench> wrenches);

// Shortest decimal that reads back as the same double: 0.02, 1e-09, 0.016666666666666666.
std::string shortest(double value);

}  // namespace plumbline
