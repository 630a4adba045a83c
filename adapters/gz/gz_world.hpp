// A scenario in Gazebo's physics layer.
#pragma once

#include <memory>
#include <string>

#include "plumbline/core/engine.hpp"

namespace plumbline {

struct GzKnobs {
  std::string detector, solver;
};

std::unique_ptr<World> make_gz_world(const Scenario& scenario, const GzKnobs& knobs);

}  // namespace plumbline
