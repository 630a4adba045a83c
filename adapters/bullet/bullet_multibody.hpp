// Bullet's second dynamics, Featherstone's articulated bodies, as a row of its own.
#pragma once

#include <memory>

#include "plumbline/core/engine.hpp"

namespace plumbline {

std::unique_ptr<Engine> make_bullet_multibody();

}  // namespace plumbline
