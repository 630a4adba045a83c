// The conformance kit: what every adapter is asked, one small question at a time. docs/conformance.md lists them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "plumbline/core/conformance_result.hpp"
#include "plumbline/core/engine.hpp"

namespace plumbline {

// Every check, by theme, in the order in which they are reported.
const std::vector<ConformanceCheck>& conformance_checks();
const ConformanceCheck* find_conformance_check(std::string_view name);  // nullptr when there is none

struct ConformanceAnswer {
  enum class Kind { kHolds, kBroken, kNotAsked } kind = Kind::kHolds;
  std::string text;  // broken: what was seen and what was wanted; not asked: what the engine lacks
};

// How the kit gets its worlds: Engine::build(), unless a test of the kit stands in for it.
using WorldBuilder = std::function<std::unique_ptr<World>(const Engine&, const Scenario&, const Settings&)>;

// Asks in this process. Throws std::invalid_argument for a check that does not exist, and whatever the engine throws
// where the check does not expect it.
ConformanceAnswer ask(std::string_view check, const Engine& engine, Profile profile, const WorldBuilder& build = {});

}  // namespace plumbline
