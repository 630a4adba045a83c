// Metrics: numbers that say how far a trajectory is from another one. Definitions: docs/metrics.md.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "plumbline/core/scenario.hpp"
#include "plumbline/core/trajectory.hpp"

namespace plumbline {

// What every metric looks at. `expected` has at least as many samples as `actual`.
struct Comparison {
  const Scenario& scenario;
  const Trajectory& actual;
  const Trajectory& expected;
  // A planar engine that runs the projection of a spatial scenario is measured in the x-z plane only.
  bool in_plane = false;
  // For a scenario with a threshold: where the engine's answer changes.
  std::optional<Bracket> critical = std::nullopt;
};

struct Metric {
  std::string_view name;  // "quantity.statistic"
  std::string_view unit;  // "m", "1" for a pure number
  std::string_view about;
  double (*measure)(const Comparison&);
  // Whether the metric means something for that scenario; one that does not is left out of the results.
  bool (*applies)(const Scenario&);
};

// The whole table, in the order in which reports show it.
std::span<const Metric> metrics();
// nullptr when there is no such metric.
const Metric* find_metric(std::string_view name);

// Largest distance [m] between two trajectories over bodies and common samples; NaN when one holds a NaN.
double position_distance(const Trajectory& a, const Trajectory& b, bool in_plane = false);
// Distance [m] at one sample, the largest over bodies. NaN sticks.
double position_distance_at(const Trajectory& a, const Trajectory& b, std::size_t sample, bool in_plane = false);

// The larger of two numbers, or NaN as soon as one of them is (std::max would drop it).
double max_or_nan(double a, double b);

}  // namespace plumbline
