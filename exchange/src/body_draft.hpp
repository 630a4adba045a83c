// Links of a draft as bodies of a scenario.
#pragma once

#include <set>

#include "plumbline/exchange/world_draft.hpp"

namespace plumbline {

// Names that are in use, and new ones that are not.
class NameList {
 public:
  // The name itself, or one with a number after it. Scenario files reserve a few words.
  std::string take(const std::string& wished);

 private:
  std::set<std::string, std::less<>> taken_;
};

// The bodies that a link becomes: one when it moves, one a shape when it stands still. `touches`: something in the
// world collides, so that shapes matter.
std::vector<Body> bodies_of(const DraftLink& link, bool touches, NameList& names, ImportedWorld& world);

}  // namespace plumbline
