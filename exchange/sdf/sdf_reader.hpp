// SDF, and URDF, as libsdformat understands them, put into a draft.
#pragma once

#include "plumbline/exchange/import_program.hpp"

namespace plumbline {

// Throws std::invalid_argument with libsdformat's words and the line, for a file that it does not take.
WorldDraft read_sdf(const ImportRequest& request);

}  // namespace plumbline
