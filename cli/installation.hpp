// Where the program's data and its engine workers are.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace plumbline {

struct LeftOutEngine {
  std::string name, package;  // the Debian package that brings its library
};

struct Installation {
  std::filesystem::path scenarios;             // folder of scenario files
  std::filesystem::path programs;              // folder of the small programs that the verbs call
  std::vector<std::filesystem::path> workers;  // programs plumbline-engine-*, sorted by name
  std::vector<LeftOutEngine> left_out;         // engines whose library was missing at build time
};

// Found from the place of the running program: ../share/plumbline, ../libexec/plumbline; further folders with
// workers, before these, in the environment variable PLUMBLINE_ENGINE_PATH (separated by ':').
Installation find_installation();

}  // namespace plumbline
