// Integrated references against other integrations, published tables against an integration, and the time of validity.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "plumbline/core/integration/integrated_reference.hpp"
#include "plumbline/core/integration/integration_agreement.hpp"
#include "plumbline/core/integration/sensitivity.hpp"
#include "plumbline/core/metric.hpp"
#include "second_sources.hpp"

namespace plumbline {
namespace {

// Roundings of a double-precision integration: some hundred steps of a few roundings each, before the motion itself
// magnifies them.
constexpr double kDoublePrecision = 1e-13;
// As fine as files need to state it: growth is exponential, so that five percent of the time are far more of the
// growth.
constexpr double kValidityShare = 0.05;
constexpr int kGrowthSamples = 400;
// Growth asks for a dozen copies of the motion: seconds for a few bodies, minutes for a mechanism.
constexpr std::ptrdiff_t kFewBodies = 4;

// Where small errors have grown beyond use, or the duration; and by how much until a time before that. One run tells
// both.
struct Sensitivity {
  double valid_until = 0;  // [s]
  double growth = 1;       // at the end of what is compared
};

bool has_few_bodies(const Scenario& scenario) {
  return kFewBodies >=
         std::count_if(scenario.bodies.begin(), scenario.bodies.end(), [](const Body& body) { return !body.fixed; });
}

Sensitivity sensitivity_of(const Scenario& scenario) {
  std::vector<double> times;
  for (int k = 1; k <= kGrowthSamples; ++k) times.push_back(scenario.duration * k / kGrowthSamples);
  const std::vector<double> growth = error_growth(scenario, times);
  Sensitivity result{scenario.duration, 1};
  for (std::size_t k = 0; k < growth.size(); ++k) {
    if (!(growth[k] <= kGrowthOfValidity)) {
      result.valid_until = times[k] - 0.5 * times[0];
      break;
    }
  }
  for (std::size_t k = 0; k < growth.size() && times[k] <= compared_until(scenario) * (1 + 1e-12); ++k) {
    result.growth = max_or_nan(result.growth, growth[k]);
  }
  return result;
}

void check_valid_until(const Scenario& scenario, double computed, Certification& result) {
  const double stated = compared_until(scenario);
  result.rows.push_back(
      {"validity",
       "t_valid " + shortest(stated) + " s against " + shortest(computed) + " s, where small errors have grown by 1e5",
       std::abs(stated - computed) / computed,
       kValidityShare,
       false,
       {}});
}

void check_methods(const Scenario& scenario, const Reference& reference, Certification& result) {
  const Agreement agreement = integration_agreement(scenario);
  result.rows.push_back({"agreement",
                         "the same equations by a second method in extended precision",
                         agreement.second_method,
                         reference.uncertainty(),
                         false,
                         {}});
  // What is not computed is granted as far as a comparison makes sense at all.
  const bool computed = has_few_bodies(scenario) || compared_until(scenario) < scenario.duration;
  const Sensitivity sensitivity =
      computed ? sensitivity_of(scenario) : Sensitivity{scenario.duration, kGrowthOfValidity};
  result.rows.push_back({"agreement",
                         "the core's equations by a method of order 8 in double precision",
                         agreement.core_field,
                         reference.uncertainty() + kDoublePrecision * sensitivity.growth,
                         true,
                         {}});
  if (computed) check_valid_until(scenario, sensitivity.valid_until, result);
}

// Places only: what else a row states is known to the file alone.
void check_table(const Scenario& scenario, const Reference& reference, Certification& result) {
  const IntegratedReference integrated(scenario, "", reference.uncertainty());
  const Agreement agreement = integration_agreement(scenario);
  const double length = scenario.scales.length;
  const double bound = reference.uncertainty() + agreement.second_method + agreement.core_field;
  Worst worst;
  for (const double t : scenario.known_at) {
    double distance = 0;
    for (std::size_t b = 0; b < scenario.bodies.size(); ++b) {
      if (scenario.bodies[b].fixed) continue;
      distance = max_or_nan(distance, (integrated.at(b, t).p_WB - reference.at(b, t).p_WB).norm());
    }
    worst.offer(distance, bound * length, length, "places of the table against an integration, t = " + shortest(t));
  }
  result.rows.push_back({"agreement", worst.what, worst.figure, worst.bound, true, {}});
}

}  // namespace

void check_agreement(const Scenario& scenario, const Reference& reference, Certification& result) {
  if (!is_smooth(scenario)) {
    result.left_out.emplace_back("agreement: the motion is not smooth");
    return;
  }
  try {
    if (reference.kind() == "table") {
      check_table(scenario, reference, result);
    } else {
      check_methods(scenario, reference, result);
    }
  } catch (const std::exception& e) {
    result.left_out.push_back(std::string("agreement: ") + e.what());
  }
}

void check_validity(const Scenario& scenario, const Reference& reference, Certification& result) {
  if (reference.kind() == "ode") return;  // done with the agreement of its methods
  // Chaos does not come to motions of which a formula is known, unless their file says so.
  if (reference.kind() != "events" && compared_until(scenario) >= scenario.duration) return;
  try {
    check_valid_until(scenario, std::min(time_of_validity(scenario), scenario.duration), result);
  } catch (const std::exception& e) {
    result.left_out.push_back(std::string("validity: ") + e.what());
  }
}

}  // namespace plumbline
