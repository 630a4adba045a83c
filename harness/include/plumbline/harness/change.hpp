// What changed between two reports.
#pragma once

#include <vector>

#include "plumbline/core/run_change.hpp"
#include "plumbline/core/run_result.hpp"

namespace plumbline {

// One entry per run of either report, worst first. A run got worse when its verdict did, or when the gated metric
// that changed most grew in magnitude by more than `tolerance` (relative). Ungated metrics are not judged.
std::vector<RunChange> changes(const Report& before, const Report& after, double tolerance = 0.01);

}  // namespace plumbline
