// Parameters of a scenario file: sweeps, replacements from outside, and names derived from them.
#pragma once

#include <vector>

#include "document.hpp"
#include "plumbline/scenarios/scenario_file.hpp"

namespace plumbline {

// One choice out of every sweep.
struct ParameterSet {
  Parameters values;  // [parameters], in the order of the file
  Parameters swept;   // those of them that the file or an override sweeps
};

// The product of the sweeps under [parameters], the first parameter slowest. One set when nothing is swept.
std::vector<ParameterSet> expand_sweeps(const Node& root, const Overrides& overrides);

// `parameters` followed by the values of [derived].
Parameters with_derived(const Node& root, const Parameters& parameters);

}  // namespace plumbline
