#include "plumbline/harness/change.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace plumbline {
namespace {

using Key = std::tuple<std::string, std::string, Profile, double>;
Key key(const RunResult& run) { return {run.case_name, run.engine, run.profile, run.dt}; }

// How a number changed, as log(new/old) of the magnitudes: 0 the same, > 0 worse. NaN counts as the worst value.
double growth(double before, double after) {
  if (std::isnan(before) && std::isnan(after)) return 0;
  if (std::isnan(after)) return std::numeric_limits<double>::infinity();
  if (std::isnan(before)) return -std::numeric_limits<double>::infinity();
  before = std::abs(before);
  after = std::abs(after);
  return before == after ? 0 : std::log(after / before);
}

// The metric that a gate watches and that changed most; without gates, position.max. Ungated numbers drift in the
// last digits from machine to machine and are no reason to call a run worse.
void add_metric(RunChange& change, const RunResult& before, const RunResult& after) {
  double largest = -1;
  for (const GateResult& gate : after.gates) {
    const double old_value = before.metric(gate.metric), new_value = after.metric(gate.metric);
    // Far below its limit a number is rounding noise, which differs between machines.
    const double noise = 1e-6 * gate.limit;
    if (within(old_value, noise) && within(new_value, noise)) continue;
    const double g = std::abs(growth(old_value, new_value));
    if (g > largest) {
      largest = g;
      change.metric = gate.metric;
      change.old_value = old_value;
      change.new_value = new_value;
    }
  }
  if (largest < 0 && after.gates.empty() && !before.metrics.empty() && !after.metrics.empty()) {
    change.metric = "position.max";
    change.old_value = before.metric("position.max");
    change.new_value = after.metric("position.max");
  }
}

RunChange::Kind kind_of(const RunChange& change, double tolerance) {
  const int old_badness = row_of(change.old_verdict).badness, new_badness = row_of(change.new_verdict).badness;
  if (new_badness != old_badness) return new_badness > old_badness ? RunChange::Kind::kWorse : RunChange::Kind::kBetter;
  if (change.old_verdict != change.new_verdict) return RunChange::Kind::kChanged;
  if (change.metric.empty()) return RunChange::Kind::kSame;
  const double g = growth(change.old_value, change.new_value);
  const double counts = std::log1p(tolerance);
  if (g > counts) return RunChange::Kind::kWorse;
  if (g < -counts) return RunChange::Kind::kBetter;
  return RunChange::Kind::kSame;
}

int rank(RunChange::Kind kind) {
  using Kind = RunChange::Kind;
  constexpr Kind kOrder[] = {Kind::kWorse, Kind::kRemoved, Kind::kChanged, Kind::kBetter, Kind::kAdded, Kind::kSame};
  return static_cast<int>(std::find(std::begin(kOrder), std::end(kOrder), kind) - std::begin(kOrder));
}

}  // namespace

std::vector<RunChange> changes(const Report& before, const Report& after, double tolerance) {
  std::map<Key, std::pair<const RunResult*, const RunResult*>> pairs;
  for (const RunResult& run : before.runs) pairs[key(run)].first = &run;
  for (const RunResult& run : after.runs) pairs[key(run)].second = &run;

  std::vector<RunChange> result;
  for (const auto& [k, runs] : pairs) {
    const auto [old_run, new_run] = runs;
    RunChange change;
    std::tie(change.case_name, change.engine, change.profile, change.dt) = k;
    change.old_value = change.new_value = std::numeric_limits<double>::quiet_NaN();
    if (old_run != nullptr) change.old_verdict = old_run->verdict;
    if (new_run != nullptr) change.new_verdict = new_run->verdict;
    if (old_run == nullptr) {
      change.kind = RunChange::Kind::kAdded;
    } else if (new_run == nullptr) {
      change.kind = RunChange::Kind::kRemoved;
    } else {
      add_metric(change, *old_run, *new_run);
      change.kind = kind_of(change, tolerance);
    }
    result.push_back(std::move(change));
  }
  std::stable_sort(result.begin(), result.end(), [](const RunChange& a, const RunChange& b) {
    if (rank(a.kind) != rank(b.kind)) return rank(a.kind) < rank(b.kind);
    return growth(a.old_value, a.new_value) > growth(b.old_value, b.new_value);
  });
  return result;
}

}  // namespace plumbline
