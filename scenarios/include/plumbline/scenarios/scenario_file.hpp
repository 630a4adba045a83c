// Reads scenario files (TOML with expressions) into plain Scenario values and their references.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "plumbline/core/reference.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

// One case: a scenario with every parameter fixed, and the truth about it.
struct Case {
  Scenario scenario;
  std::shared_ptr<const Reference> reference;
};

// A file that cannot be used. what() is the whole message for people: "file:line:col: /gate/0/limit: ..." and the
// way out.
class ScenarioError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Parameter values from outside (-P name=value,value): each replaces the file's value or sweep.
using Overrides = std::map<std::string, std::vector<double>, std::less<>>;

// Every case of the file: the product of its sweeps. `file` is only used in messages. Throws ScenarioError.
// Overrides of parameters that this file does not have are ignored here: they may belong to another file.
std::vector<Case> read_scenario(std::string_view text, const std::string& file, const Overrides& overrides = {});

// The same, from disk.
std::vector<Case> read_scenario_file(const std::filesystem::path& file, const Overrides& overrides = {});

// The one case that these parameter values single out, without its reference, gates and certificates: what an engine is
// asked to run. Throws ScenarioError, and std::invalid_argument when there are several cases.
Scenario read_problem(std::string_view text, const std::string& file, const Parameters& parameters);

// All scenario files of a folder (case.toml) and of the folders in it (family/case.toml), sorted by path.
std::vector<std::filesystem::path> find_scenario_files(const std::filesystem::path& folder);

}  // namespace plumbline
