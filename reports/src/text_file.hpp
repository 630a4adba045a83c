// Writing a whole file, or saying why not.
#pragma once

#include <filesystem>
#include <string_view>

namespace plumbline::reports {

// Makes missing folders, writes in one go, throws std::runtime_error with path and cause.
void write_file(const std::filesystem::path& path, std::string_view text);

// The same through a temporary file beside it and a rename: readers see the old file or the new one, never a part.
void replace_file(const std::filesystem::path& path, std::string_view text);

}  // namespace plumbline::reports
