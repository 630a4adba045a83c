#include "plumbline/core/deviation.hpp"

#include <algorithm>
#include <cmath>

namespace plumbline {
namespace {

// 1/60 written as 0.0166667 in a hand-written list still means 1/60.
bool same_number(double a, double b) { return std::abs(a - b) <= 1e-4 * std::max(std::abs(a), std::abs(b)); }

}  // namespace

bool Deviation::covers(const Scenario& run, const std::string& row, Profile p, double step) const {
  if (scenario != run.id) return false;
  if (!engines.empty() && std::find(engines.begin(), engines.end(), row) == engines.end()) return false;
  if (profile && *profile != p) return false;
  if (!dt.empty() && std::none_of(dt.begin(), dt.end(), [&](double d) { return same_number(d, step); })) return false;
  return std::all_of(parameters.begin(), parameters.end(), [&](const auto& wanted) {
    return std::any_of(run.parameters.begin(), run.parameters.end(), [&](const auto& has) {
      return has.first == wanted.first && same_number(has.second, wanted.second);
    });
  });
}

}  // namespace plumbline
