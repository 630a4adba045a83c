// Reads an engine's list of known deviations (adapters/<engine>/deviations.toml).
#pragma once

#include <filesystem>
#include <vector>

#include "plumbline/core/deviation.hpp"

namespace plumbline {

// One [[deviation]] gives one Deviation per entry of its `limits` table. An absent file is an empty list.
// Throws UsageError with file, line and column.
std::vector<Deviation> read_deviations(const std::filesystem::path& file);

}  // namespace plumbline
