// What else must hold of a reference: the second source that certifies it.
//
// A closed form that was only copied is no reference. Besides the checks that need no words (the equation of motion,
// invariants, the same problem solved by another method) a scenario states published values and second derivations:
// quantities that must vanish on the reference, at one time or always.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "plumbline/core/gate.hpp"
#include "plumbline/core/reference.hpp"

namespace plumbline {

struct Certificate {
  std::string text;            // as written: "top_x = 0.60555056"
  std::string source;          // where it is published, or how it was derived
  std::optional<double> time;  // none: at all times [s]
  double within = 0;           // > 0, in the unit of the quantity
  std::function<double(const Reference&, double t)> difference;
  SourcePlace place;
};

}  // namespace plumbline
