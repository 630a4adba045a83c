// Known deviations: where an engine is known to miss a gate, why, and by how much at most.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plumbline/core/engine.hpp"
#include "plumbline/core/gate.hpp"
#include "plumbline/core/scenario.hpp"
#include "plumbline/core/verdict.hpp"

namespace plumbline {

// Matches a run when every condition that is stated holds; what is not stated holds for all.
struct Deviation {
  std::vector<std::string> engines;  // rows; empty: every row of the adapter
  std::string scenario;              // id
  Parameters parameters;             // the parameters of the case that must have these values
  std::optional<Profile> profile;
  std::vector<double> dt;  // [s]
  std::string metric;      // empty when `ends` is given
  double limit = 0;        // the failure is expected only while |metric| <= limit; infinity: however large
  // Instead of a gate that is missed: the run ends with this verdict, before there is anything to gate.
  std::optional<Verdict> ends = std::nullopt;
  std::string why;   // the cause
  std::string link;  // issue, manual page or minimal reproduction; may be empty
  SourcePlace place;

  // Whether this entry speaks of that case, engine row, profile and dt.
  bool covers(const Scenario& scenario, const std::string& engine, Profile profile, double dt) const;
};

}  // namespace plumbline
