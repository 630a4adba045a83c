// What one run and a whole comparison say: plain values that reporters print and nothing recomputes.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "plumbline/core/conformance_result.hpp"
#include "plumbline/core/engine.hpp"
#include "plumbline/core/gate.hpp"
#include "plumbline/core/scenario.hpp"
#include "plumbline/core/verdict.hpp"

namespace plumbline {

// Which numerical scheme the trajectory is closest to, and how much of the error it explains.
struct Explanation {
  std::string scheme;   // empty: nothing was compared
  double distance = 0;  // largest distance to the scheme's own trajectory [m]
  double share = 0;     // 1 - distance/position.max, in [0, 1]; 1 = all of the error is the scheme's
};

struct CurvePoint {
  double t;      // [s]
  double error;  // distance from the reference, the largest over bodies [m]
};

struct RunResult {
  std::string scenario;   // id
  std::string case_name;  // id and swept parameters
  Parameters parameters;
  std::string engine;
  Profile profile = Profile::kDefault;
  double dt = 0;  // [s]

  Verdict verdict = Verdict::kError;
  std::string reason;                                   // one line for people, empty for a plain pass
  std::vector<std::string> notes;                       // "planar projection", ...
  std::vector<std::pair<std::string, double>> metrics;  // in table order
  std::vector<GateResult> gates;
  Explanation explanation;
  Settings settings;
  double wall_seconds = 0;        // stepping and reading, without building the world
  std::string messages;           // what the engine printed
  std::string trajectory;         // path relative to the results file; empty when none was written
  std::vector<CurvePoint> curve;  // error against time, thinned for pictures, maxima kept

  double metric(std::string_view name) const;  // NaN when absent
};

// Observed order of convergence of one metric over the dt's of one engine, profile and case.
struct Convergence {
  std::string case_name, engine;
  Profile profile = Profile::kDefault;
  std::string metric;
  double order = 0;        // slope of log(error) against log(dt); NaN when it means nothing
  std::size_t points = 0;  // dt's that the fit used
  std::string note;        // why dt's were left out or there is no order
};

// Who agrees with whom: largest distance [m] between engines that ran the same case, profile and dt.
struct Divergence {
  std::string case_name;
  Profile profile = Profile::kDefault;
  double dt = 0;
  std::vector<std::string> engines;
  std::vector<double> distance;  // row-major engines x engines, symmetric, zero diagonal
};

struct ScenarioSummary {
  std::string id, about, source, file, reference_kind, citation;
  std::vector<std::string> cases;
  std::vector<double> steps;
};

struct MissingEngine {
  std::string name, reason;
};

struct Report {
  std::string tool_version;
  std::vector<std::pair<std::string, std::string>> environment;  // date, machine, compiler, flags, command
  std::vector<EngineInfo> engines;
  std::vector<MissingEngine> missing_engines;
  std::vector<ScenarioSummary> scenarios;
  std::vector<RunResult> runs;
  std::vector<Convergence> convergence;
  std::vector<Divergence> divergence;
  std::vector<ConformanceCheck> conformance_checks;  // those that were asked, in the order of the kit's table
  std::vector<ConformanceResult> conformance;        // by engine, profile and check
  double wall_seconds = 0;
  bool interrupted = false;
};

}  // namespace plumbline
