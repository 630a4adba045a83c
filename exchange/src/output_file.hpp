// Files that are written in full or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace plumbline::exchange {

// Makes missing folders. Throws std::runtime_error that names the file.
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace plumbline::exchange
