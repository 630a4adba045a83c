// Looks into a world file: which format is it, is it XML at all.
#pragma once

#include <filesystem>
#include <string>

#include "plumbline/exchange/world_export.hpp"

namespace plumbline {

// Told by the outermost element, not by the name. Throws std::invalid_argument, "file:line: what is wrong", for a file
// that cannot be read, is not well-formed, or is of none of the three formats.
WorldFormat format_of_world_file(const std::filesystem::path& file);

// The same, "file:line: text", for a line that is known.
std::string at_line(const std::filesystem::path& file, int line, const std::string& text);

}  // namespace plumbline
