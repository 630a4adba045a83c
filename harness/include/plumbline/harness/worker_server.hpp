// The worker's side of the door: answers requests on stdin with runs of its engines.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "plumbline/core/engine.hpp"

namespace plumbline {

// Turns the text of a scenario file and one value per swept parameter into the one case that is meant. The
// harness knows no file format, so the worker's main brings this along.
using ScenarioSource = std::function<Scenario(const std::string& text, const std::string& file, const Parameters&)>;

// Serves until "exit" or end of file; returns the process's exit code. Standard output is kept for the protocol:
// whatever the engine prints there goes to standard error.
int serve(const std::vector<std::unique_ptr<Engine>>& engines, const ScenarioSource& source);

}  // namespace plumbline
