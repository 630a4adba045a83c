#include "plumbline/core/kinetics/scheme.hpp"

namespace plumbline {
namespace {

using enum Integrator;
using enum ImpactRule;

// The first kIntegrators rows hold each integrator once.
constexpr std::size_t kIntegrators = 3;
constexpr Scheme kCandidates[] = {
    {kSemiImplicitEuler, kExactTime},
    {kExplicitEuler, kExactTime},
    {kVelocityVerlet, kExactTime},
    {kSemiImplicitEuler, kStepStart},
    {kExplicitEuler, kStepStart},
    {kVelocityVerlet, kStepStart},
    {kSemiImplicitEuler, kStepStartBeforeForces},
    {kExplicitEuler, kStepStartBeforeForces},
    {kVelocityVerlet, kStepStartBeforeForces},
};

std::string integrator_name(Integrator integrator) {
  switch (integrator) {
    case kSemiImplicitEuler:
      return "semi-implicit Euler";
    case kExplicitEuler:
      return "explicit Euler";
    case kVelocityVerlet:
      return "velocity Verlet";
  }
  return "unknown integrator";
}

std::string impact_name(ImpactRule impact) {
  switch (impact) {
    case kExactTime:
      return "impacts at their exact time";
    case kStepStart:
      return "impacts at the start of the step";
    case kStepStartBeforeForces:
      return "impacts at the start of the step with the speed before the forces";
  }
  return "unknown impact rule";
}

}  // namespace

std::string name(const Scheme& scheme) {
  return integrator_name(scheme.integrator) + ", " + impact_name(scheme.impact);
}

std::string name(const Scheme& scheme, const Scenario& scenario) {
  return scenario.contact ? name(scheme) : integrator_name(scheme.integrator);
}

std::span<const Scheme> candidate_schemes() { return kCandidates; }

std::span<const Scheme> candidate_schemes(const Scenario& scenario) {
  return scenario.contact ? candidate_schemes() : candidate_schemes().first(kIntegrators);
}

}  // namespace plumbline
