#include "installation.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace plumbline {
namespace fs = std::filesystem;
namespace {

bool is_worker(const fs::path& file) {
  return file.filename().string().starts_with("plumbline-engine-") && file.extension().empty() &&
         access(file.c_str(), X_OK) == 0;
}

void add_workers(const fs::path& folder, std::vector<fs::path>& workers) {
  if (!fs::is_directory(folder)) return;
  std::vector<fs::path> here;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && is_worker(entry.path())) here.push_back(entry.path());
  }
  std::sort(here.begin(), here.end());
  workers.insert(workers.end(), here.begin(), here.end());
}

}  // namespace

Installation find_installation() {
  const fs::path root = fs::read_symlink("/proc/self/exe").parent_path().parent_path();
  Installation result;
  result.scenarios = root / "share/plumbline/scenarios";
  if (const char* extra = std::getenv("PLUMBLINE_ENGINE_PATH")) {
    std::istringstream folders(extra);
    for (std::string folder; std::getline(folders, folder, ':');) {
      if (!folder.empty()) add_workers(folder, result.workers);
    }
  }
  result.programs = root / "libexec/plumbline";
  add_workers(result.programs, result.workers);
  std::ifstream left_out(root / "share/plumbline/engines_left_out.tsv");
  for (std::string line; std::getline(left_out, line);) {
    const std::size_t tab = line.find('\t');  // a library may take several packages, with spaces between
    if (tab != std::string::npos) result.left_out.push_back({line.substr(0, tab), line.substr(tab + 1)});
  }
  return result;
}

}  // namespace plumbline
