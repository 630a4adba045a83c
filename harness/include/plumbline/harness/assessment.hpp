// From a recording to a result: metrics, gates, deviations, verdict.
#pragma once

#include <vector>

#include "plumbline/core/deviation.hpp"
#include "plumbline/core/metric.hpp"
#include "plumbline/core/run_result.hpp"

namespace plumbline {

// The part of a result that is known before the run: names, parameters, settings, notes about projection.
RunResult begin_result(const Scenario& scenario, const EngineInfo& engine, Profile profile, double dt);

// What an engine is known to miss, and whether a gate that holds although it is listed is an unexpected pass. It is
// not for parameters or steps that the list was not made for.
struct KnownDeviations {
  const std::vector<Deviation>& list;
  bool must_apply = true;
};

// Fills in metrics, gates, error curve, verdict and reason. `not_finite_at` as in Recording.
void assess(RunResult& result, const Comparison& comparison, const EngineInfo& engine,
            std::optional<std::size_t> not_finite_at, const KnownDeviations& deviations);

// True when that engine is measured in the x-z plane only: it is planar and the scenario is not.
bool measured_in_plane(const Scenario& scenario, const EngineInfo& engine);

}  // namespace plumbline
