// Runs a small program to its end and keeps what it said.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace plumbline {

struct ChildOutcome {
  int exit_code = -1;  // -1: it did not end by itself
  std::string output, messages;
  std::string trouble;  // how it ended when not by itself: "killed by signal 11", "took longer than 60 s"
};

// Throws std::runtime_error when the program cannot be started.
ChildOutcome run_child(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                       std::chrono::seconds limit);

}  // namespace plumbline
