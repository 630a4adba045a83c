// Reads an engine's list of known deviations (adapters/<engine>/deviations.toml).
#pragma once

#include <filesystem>
#include <vector>

#include "plumbline/core/conformance_result.hpp"
#include "plumbline/core/deviation.hpp"

namespace plumbline {

struct DeviationLists {
  std::vector<Deviation> deviations;         // gates that runs miss: one per entry of a [[deviation]]'s `limits` table
  std::vector<KnownFailure> known_failures;  // checks that fail: one per [[conformance]]
};

// An absent file is two empty lists. Throws UsageError with file, line and column.
DeviationLists read_deviations(const std::filesystem::path& file);

}  // namespace plumbline
