#include "plumbline/core/kinetics/scheme.hpp"

#include <algorithm>
#include <stdexcept>

namespace plumbline {

std::string_view name(Integrator integrator) {
  switch (integrator) {
    case Integrator::kSemiImplicitEuler:
      return "semi-implicit Euler";
    case Integrator::kExplicitEuler:
      return "explicit Euler";
    case Integrator::kVelocityVerlet:
      return "velocity Verlet";
    case Integrator::kPositionVerlet:
      return "position Verlet";
    case Integrator::kRungeKutta4:
      return "Runge-Kutta 4";
    case Integrator::kDormandPrince8:
      return "Dormand-Prince 8(5,3)";
  }
  return "unknown integrator";
}

namespace {

std::string_view impact_name(ImpactRule impact) {
  switch (impact) {
    case ImpactRule::kExactTime:
      return "impacts at their exact time";
    case ImpactRule::kStepStart:
      return "impacts at the start of the step";
    case ImpactRule::kStepStartBeforeForces:
      return "impacts at the start of the step with the speed before the forces";
  }
  return "unknown impact rule";
}

std::string assembled(const Scheme& scheme, bool with_gyroscopic_term, bool with_impacts) {
  std::string text(name(scheme.integrator));
  if (scheme.forces == ForceSampling::kFollowed) text += ", forces followed within the step";
  if (with_gyroscopic_term) text += ", " + std::string(name(scheme.gyroscopic));
  if (with_impacts) text += ", " + std::string(impact_name(scheme.impact));
  if (scheme.substeps != 1) text += ", " + std::to_string(scheme.substeps) + " substeps";
  return text;
}

// Whether the gyroscopic term can ever be other than zero: w x I w vanishes where all moments are the same, and where
// nothing turns the body.
bool gyroscopic_term_matters(const Scenario& scenario) {
  if (!scenario.joints.empty()) return false;  // require_possible: there is one way only
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    const Body& body = scenario.bodies[i];
    const Vec3& moments = body.inertia;
    if (body.fixed || (moments.x() == moments.y() && moments.y() == moments.z())) continue;
    const bool turned = std::any_of(scenario.forces.begin(), scenario.forces.end(),
                                    [i](const ForceLaw& law) { return law.body == i && law.has_torque; });
    if (scenario.contact || turned || !body.initial.w_WB.isZero(0)) return true;
  }
  return false;
}

}  // namespace

std::string name(const Scheme& scheme) { return assembled(scheme, true, true); }

std::string name(const Scheme& scheme, const Scenario& scenario) {
  return assembled(scheme, gyroscopic_term_matters(scenario), scenario.contact.has_value());
}

void require_possible(const Scheme& scheme, const Scenario& scenario) {
  const auto refuse = [&](const std::string& why) {
    throw std::invalid_argument(name(scheme) + " is not possible here: " + why);
  };
  const bool needs_followed_forces = scheme.integrator == Integrator::kPositionVerlet ||
                                     scheme.integrator == Integrator::kRungeKutta4 ||
                                     scheme.integrator == Integrator::kDormandPrince8;
  if (scheme.substeps < 1) refuse("a step has at least one substep");
  if (needs_followed_forces && scheme.forces == ForceSampling::kHeld) {
    refuse("this integrator asks for forces within the step; follow them, or take velocity Verlet");
  }
  if (scheme.forces == ForceSampling::kFollowed && scheme.gyroscopic != GyroscopicTerm::kExplicit &&
      scheme.gyroscopic != GyroscopicTerm::kNone) {
    refuse("an integrator that follows the forces follows the gyroscopic term as one of them; choose explicit or none");
  }
  if (!scenario.joints.empty()) {
    if (scenario.contact) refuse("joints and contact are not solved together; take one of them out");
    if (scheme.gyroscopic != GyroscopicTerm::kExplicit) {
      refuse("joints answer the gyroscopic term at once; choose the explicit one");
    }
    const bool ranges = std::any_of(scenario.joints.begin(), scenario.joints.end(),
                                    [](const Joint& joint) { return joint.range.has_value(); });
    if (ranges && scheme.integrator == Integrator::kPositionVerlet) {
      refuse("limits of joints cut the step, and this integrator needs the one before; take velocity Verlet");
    }
  }
  if (!scenario.contact) return;
  if (scheme.forces == ForceSampling::kFollowed) refuse("bodies can touch; hold the forces over the step");
  if (scheme.gyroscopic == GyroscopicTerm::kExact) {
    refuse("bodies can touch, and times of impact are sought along steady turns; choose another gyroscopic term");
  }
}

std::vector<Scheme> candidate_schemes(const Scenario& scenario) {
  using enum ImpactRule;
  using enum GyroscopicTerm;
  std::vector<ImpactRule> impacts = {kExactTime};
  if (scenario.contact) impacts = {kExactTime, kStepStart, kStepStartBeforeForces};
  std::vector<GyroscopicTerm> gyroscopic = {kExplicit};
  if (gyroscopic_term_matters(scenario)) gyroscopic = {kExplicit, kNone, kImplicit};

  std::vector<Scheme> schemes;
  for (const ImpactRule impact : impacts) {
    for (const GyroscopicTerm term : gyroscopic) {
      for (const Integrator integrator :
           {Integrator::kSemiImplicitEuler, Integrator::kExplicitEuler, Integrator::kVelocityVerlet}) {
        schemes.push_back({integrator, impact, term});
      }
    }
  }
  return schemes;
}

}  // namespace plumbline
