// What the command line selects: names of runs, engines, time steps, parameters.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "plumbline/core/engine.hpp"
#include "plumbline/scenarios/scenario_file.hpp"

namespace plumbline {

// A decimal number or a fraction of two; NaN when it is neither.
double parse_number(std::string_view text);

// "0.02" or "1/240" [s]. Throws UsageError when it is no positive number.
double parse_step(std::string_view text);
std::vector<double> parse_steps(const std::vector<std::string>& texts);

// "v0=0,10,30", "e=1/2". Throws UsageError.
Overrides parse_parameters(const std::vector<std::string>& assignments);

// A predicate over run names. A pattern is a regular expression to be found in the name; one with a leading '-' must
// not be found. A name is selected when any of the former matches (or there is none) and none of the latter does.
// Throws UsageError for a pattern that is no regular expression.
std::function<bool(const std::string&)> name_filter(const std::vector<std::string>& patterns);

// "default", "matched" or "both".
std::vector<Profile> profiles_named(std::string_view word);

// Whether "bullet" or "bullet-f32" selects the row "bullet-f32": the whole name, or its part before a '-'.
bool selects_engine(std::string_view selector, std::string_view row);

// "a, b, c"
std::string joined(const std::vector<std::string>& words);

}  // namespace plumbline
