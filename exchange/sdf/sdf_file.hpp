// A file loaded by libsdformat, which is kept quiet, and what libsdformat leaves unread or drops.
#pragma once

#include <map>
#include <sdf/sdf.hh>
#include <string>
#include <vector>

#include "plumbline/exchange/import_program.hpp"

namespace plumbline {

// A link in the recorded state of a world.
struct RecordedLink {
  Vec3 v_W = Vec3::Zero(), w_W = Vec3::Zero();  // of the link's own origin [m/s], [rad/s]
  std::optional<Vec3> place;                    // where it was recorded [m]
};

struct SdfFile {
  sdf::Root root;
  // "model::link" -> what <state> says, which libsdformat reads but does not offer.
  std::map<std::string, RecordedLink> recorded;
};

// Appends what libsdformat complains of to `draft`. Throws std::invalid_argument when nothing of the file is left.
SdfFile load_sdf(const ImportRequest& request, WorldDraft& draft);

}  // namespace plumbline
