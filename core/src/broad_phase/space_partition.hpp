// Cutting space in two, again and again: what the kd-tree and the BSP tree have in common.
//
// A plane divides the boxes of a node: those on its near side, those on its far side, and those that it cuts, which go
// to both. When no plane saves enough, the node is a leaf and compares its boxes with each other. Nothing outlives its
// turn: the tree is the tree of calls, and the path from the root is all that is kept.
//
// A pair of boxes that were both cut meets in several leaves, but is reported in one: where the lower corner of its
// intersection lies. Every point belongs to one leaf, since value(p) < offset on the near side and >= on the far one;
// and a box that holds p gets there, since low(box) <= value(p) <= high(box) holds in floating point too: rounding
// never turns the order of two numbers round, so that a sum of products that grow only grows.
#pragma once

#include <algorithm>
#include <optional>

#include "plumbline/core/broad_phase/broad_phase.hpp"

namespace plumbline {

struct PartitionEntry {
  Aabb box;
  std::uint32_t body;
};

// A Plane offers value(point), low(box), high(box) and a member `offset`. A Chooser makes one for some entries:
// choose(entries, attempt), where the attempts 0, 1, 2 are its three best ideas.
template <typename Plane, typename Chooser>
class SpacePartition : public BroadPhase {
 private:
  static constexpr std::size_t kLeafSize = 24;
  static constexpr int kAttempts = 3;
  static constexpr double kWorthwhile = 0.75;  // of the tests before: with more than that left, the plane is not used

  struct Side {
    Plane plane;
    bool far;
  };

  void find(std::span<const Aabb> boxes, std::vector<BodyPair>& pairs) override {
    stack_.clear();
    path_.clear();
    for (std::uint32_t i = 0; i < boxes.size(); ++i) stack_.push_back({boxes[i], i});
    divide(0, stack_.size(), pairs);
  }

  // The entries [begin, end) of the stack; what it puts on the stack it takes off again.
  void divide(std::size_t begin, std::size_t end, std::vector<BodyPair>& pairs) {
    const std::optional<Plane> plane = end - begin > kLeafSize ? split(begin, end) : std::nullopt;
    if (!plane) return compare(begin, end, pairs);
    for (const bool far : {false, true}) {
      for (std::size_t k = begin; k < end; ++k) {
        const PartitionEntry entry = stack_[k];  // a copy: the stack may move when it grows
        if (reaches(*plane, far, entry.box)) stack_.push_back(entry);
      }
      path_.push_back({*plane, far});
      divide(end, stack_.size(), pairs);
      path_.pop_back();
      stack_.resize(end);
    }
  }

  std::optional<Plane> split(std::size_t begin, std::size_t end) {
    const std::span<const PartitionEntry> entries(stack_.data() + begin, end - begin);
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const Plane plane = chooser_.choose(entries, attempt);
      double near = 0, far = 0;
      for (const PartitionEntry& entry : entries) {
        near += reaches(plane, false, entry.box) ? 1 : 0;
        far += reaches(plane, true, entry.box) ? 1 : 0;
      }
      const auto all = static_cast<double>(entries.size());
      if (near * near + far * far <= kWorthwhile * all * all) return plane;
    }
    return std::nullopt;
  }

  // Written so that a plane of NaN cuts everything, and is therefore never used.
  static bool reaches(const Plane& plane, bool far, const Aabb& box) {
    return far ? !(plane.high(box) < plane.offset) : !(plane.low(box) >= plane.offset);
  }

  void compare(std::size_t begin, std::size_t end, std::vector<BodyPair>& pairs) {
    for (std::size_t a = begin; a < end; ++a) {
      for (std::size_t b = a + 1; b < end; ++b) {
        if (overlap(stack_[a].box, stack_[b].box) && is_here(stack_[a].box.min.cwiseMax(stack_[b].box.min))) {
          pairs.push_back(ordered(stack_[a].body, stack_[b].body));
        }
      }
    }
  }

  bool is_here(const Vec3& point) const {
    return std::all_of(path_.rbegin(), path_.rend(),
                       [&](const Side& side) { return side.far == (side.plane.value(point) >= side.plane.offset); });
  }

  Chooser chooser_;
  std::vector<PartitionEntry> stack_;
  std::vector<Side> path_;
};

}  // namespace plumbline
