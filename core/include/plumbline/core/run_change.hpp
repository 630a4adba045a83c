// How one run of a comparison differs from the same run of another one.
#pragma once

#include <string>

#include "plumbline/core/engine.hpp"
#include "plumbline/core/verdict.hpp"

namespace plumbline {

struct RunChange {
  enum class Kind {
    kWorse,
    kBetter,
    kChanged,  // neither better nor worse, yet not the same: another verdict of the same weight
    kAdded,    // only in the new results: the old_ fields mean nothing
    kRemoved,  // only in the old results: the new_ fields mean nothing
    kSame,
  };

  std::string case_name, engine;
  Profile profile = Profile::kDefault;
  double dt = 0;  // [s]
  Kind kind = Kind::kSame;
  Verdict old_verdict = Verdict::kError, new_verdict = Verdict::kError;
  std::string metric;                   // the metric that changed most; empty when only the verdict is known
  double old_value = 0, new_value = 0;  // in the metric's unit; NaN when that run has no such number
};

}  // namespace plumbline
