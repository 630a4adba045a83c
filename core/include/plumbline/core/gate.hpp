// Gates: limits on metrics, each with its reason.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace plumbline {

// Where in a file something was written; line 0 when it was not read from a file.
struct SourcePlace {
  std::string file;
  int line = 0, column = 0;
};

// What a limit may depend on besides the scenario's parameters.
struct GateContext {
  double dt = 0;             // [s]
  double steps = 0;          // number of steps of the run
  double unit_roundoff = 0;  // of the engine's arithmetic: 2^-24 or 2^-53
};

// |metric| <= limit passes; everything else fails, NaN included.
struct Gate {
  std::string metric;
  std::function<double(const GateContext&)> limit;  // in the metric's unit
  std::string limit_text;                           // the expression as written
  std::string reason;                               // mandatory: why this limit and no other
  SourcePlace place;
};

struct GateResult {
  std::string metric;
  double value = 0;
  double limit = 0;
  bool passed = false;
  std::string reason;     // the gate's
  std::string deviation;  // why a known deviation allows the failure; empty when none does
  SourcePlace place;
};

// The one comparison of the suite: true only when |value| <= limit. NaN on either side is false.
bool within(double value, double limit);

}  // namespace plumbline
