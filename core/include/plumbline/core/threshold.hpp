// A yes/no question about a scenario whose answer changes at a known value of one parameter.
//
// The incline on which a box just stays, the speed at which a ball just passes a wall: not a motion is compared but the
// critical value that bisection finds in an engine with the one that the laws give.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "plumbline/core/trajectory.hpp"

namespace plumbline {

struct Scenario;

struct Threshold {
  std::string parameter;     // what is varied
  std::string question;      // what is asked, as written: "x > 0.01*a"
  double low = 0, high = 0;  // where it is sought; the answers there differ for the truth
  double exact = 0;          // where the answer changes
  double resolution = 0;     // the search ends with a bracket no wider than this
  bool exact_above = true;   // whether the true answer is yes above `exact`
  // The scenario with that value of the parameter; it has no threshold of its own.
  std::function<std::shared_ptr<const Scenario>(double value)> with;
  std::function<bool(const Trajectory&)> answer;
};

// What a search has found: the answer changes between two values. Both at one end of the range when it never does.
struct Bracket {
  double no = 0, yes = 0;
  double middle() const { return 0.5 * (no + yes); }
};

}  // namespace plumbline
