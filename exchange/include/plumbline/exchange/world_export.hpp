// A scenario's world in the formats that other programs read: MJCF (MuJoCo 2.2), SDF 1.9 (Gazebo), URDF.
//
// No format says everything that a scenario says. Whatever cannot be said is listed by name, and the list also stands
// as a comment in the file; docs/exchange.md has the tables. What a format leaves room for but gives no word to
// (duration, scales, in MJCF restitution) goes into its fields for the user's own data, which only the importer reads
// again.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "plumbline/core/scenario.hpp"

namespace plumbline {

enum class WorldFormat { kMjcf, kSdf, kUrdf };

struct ExportedWorld {
  std::string text;
  std::vector<std::string> losses;  // "force law on ship: dropped; ..."
};

// Throws std::invalid_argument for a scenario that is not sound (core's require_sound) or whose names the format cannot
// hold.
ExportedWorld export_world(const Scenario& scenario, WorldFormat format);

}  // namespace plumbline
