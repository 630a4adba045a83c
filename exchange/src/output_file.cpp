#include "output_file.hpp"

#include <fstream>
#include <stdexcept>
#include <string>

namespace plumbline::exchange {

void write_file(const std::filesystem::path& path, std::string_view content) {
  std::error_code ignored;  // the stream tells whether it worked
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), ignored);
  std::ofstream out(path, std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (!out) throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace plumbline::exchange
