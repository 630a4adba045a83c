// What changed between two results files, as a table for a terminal.
#pragma once

#include <iosfwd>
#include <vector>

#include "plumbline/core/run_change.hpp"
#include "plumbline/reports/console.hpp"

namespace plumbline {

// One row per run that is not the same: old and new value, their ratio, the change of verdict; worse runs first, in
// them the largest ratio first. Then a line with the counts of every kind.
void print_changes(const std::vector<RunChange>& changes, const ConsoleStyle& style, std::ostream& out);

}  // namespace plumbline
