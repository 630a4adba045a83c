// --set ENGINE.OPTION=VALUE[,VALUE...]: engine rows with some of their settings changed, each a row of its own.
#pragma once

#include <string>
#include <vector>

#include "inventory.hpp"

namespace plumbline {

struct SettingSweep {
  std::string argument;  // as given, for messages
  std::string engine;    // a row, or the part of its name before a '-', as for -e
  std::string option;
  std::vector<std::string> values;
};

// Throws UsageError for what is not of that form.
std::vector<SettingSweep> parse_settings(const std::vector<std::string>& arguments);

// Replaces every row that a sweep names by one row for each combination of values, called
// "bullet-f64@erp2=0.1,solver_iterations=50", in which both profiles have these values. Known deviations of the row
// stay known, but need not show: the list was not made for other settings. Rows without the option stay as they are.
// Throws UsageError when a sweep names no engine or none that has the option, and for a value of the wrong type.
void vary_settings(EngineInventory& engines, const std::vector<SettingSweep>& sweeps);

}  // namespace plumbline
