// Links of SDF: where they stand, what they weigh, what they are made of, and which of them collide.
#pragma once

#include <cstdint>
#include <sdf/sdf.hh>
#include <string>
#include <vector>

#include "plumbline/exchange/world_draft.hpp"

namespace plumbline {

struct SdfLink {
  std::string path;         // "model::link"
  std::uint64_t model = 0;  // the outermost model that it belongs to
  bool collides_inside = false;
  PlacedFrame frame;
  std::vector<std::size_t> tied_to;  // links at the other ends of its joints
  // Of its first shape that collides; mu and e of a pair are the smaller ones, as Gazebo's ODE has it.
  ContactMaterial material;
  std::uint16_t mask = 0;  // 0: nothing of it collides
};

Vec3 vec(const ignition::math::Vector3d& v);

// A pose that libsdformat resolves relative to `parent`; as written where it cannot.
PlacedFrame placed(const PlacedFrame& parent, const sdf::SemanticPose& pose, const ignition::math::Pose3d& raw);

// Appends the link to draft.links.
SdfLink read_link(const sdf::Link& link, const PlacedFrame& model, bool still, WorldDraft& draft);

void add_sdf_contacts(const std::vector<SdfLink>& links, WorldDraft& draft);

}  // namespace plumbline
