// MJCF as MuJoCo itself understands it: the compiled model, at its start, put into a draft.
#pragma once

#include "plumbline/exchange/import_program.hpp"

namespace plumbline {

// Throws std::invalid_argument with MuJoCo's own words and the line, for a file that MuJoCo does not take.
WorldDraft read_mjcf(const ImportRequest& request);

}  // namespace plumbline
