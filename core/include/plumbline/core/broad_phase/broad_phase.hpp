// Broad phase: which of n bodies may touch at all? (course slide 17: "use a spatial index to reduce the number of
// intersecting pairs that need to be tested").
//
// There are n (n-1) / 2 pairs, and all but a few are far apart. Every method below finds the same pairs, those whose
// boxes overlap, and they differ only in how they avoid to look at the others:
//
//   brute force      looks at all of them                                               n^2
//   sweep and prune  sorts along one axis; looks at those that overlap there            n^(5/3) in space, less if flat
//   uniform grid     cells as large as the boxes, one grid for each factor 2 of size    n
//   octree           cubes in cubes; a box stays in the one whose size fits             n log n
//   kd-tree          halves by a plane across an axis; a box goes to every side it is on   n log n
//   BSP tree         the same with planes in any direction                              n log n
//
// (for boxes that each overlap a few others). docs/course/spatial_index.md shows measured costs and who wins where.
// Source: Ericson, Real-Time Collision Detection (2005), chapters 7 and 8.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "plumbline/core/broad_phase/bounding_volume.hpp"

namespace plumbline {

// Two bodies by their index, first < second. Pairs are sorted by first, then by second.
struct BodyPair {
  std::uint32_t first, second;
  friend auto operator<=>(const BodyPair&, const BodyPair&) = default;
};

// The boxes that touch everything in sight are few (the floor is one), and no spatial index likes them: a box that
// reaches beyond this distance from the origin [m], or to infinity, is compared with all others instead.
inline constexpr double kUnboundedReach = 1e100;

class BroadPhase {
 public:
  virtual ~BroadPhase() = default;
  virtual std::string_view name() const = 0;

  // All pairs of overlapping boxes, each once, in order; what `pairs` held before is gone. Boxes are closed: sharing
  // one point of their surfaces is enough. The result depends on the boxes alone, not on the method and not on earlier
  // calls. An object keeps its memory from call to call: as long as nothing grows, a call allocates nothing. Not for
  // two threads at once.
  // Throws std::invalid_argument, naming the box, for a NaN and for min > max; and for 2^32 boxes or more.
  void pairs(std::span<const Aabb> boxes, std::vector<BodyPair>& pairs);

 private:
  // Appends each overlapping pair exactly once, in any order. The boxes are valid and within kUnboundedReach.
  virtual void find(std::span<const Aabb> boxes, std::vector<BodyPair>& pairs) = 0;

  void find_all(std::span<const Aabb> boxes, std::vector<BodyPair>& pairs);
  void sort(std::size_t bodies, std::vector<BodyPair>& pairs);

  std::vector<Aabb> bounded_;                     // when there are unbounded ones: the others,
  std::vector<std::uint32_t> names_, unbounded_;  // the index they came with, and the index of the unbounded ones
  std::vector<std::uint32_t> starts_, seconds_;   // for sorting
};

// One method: how it is called and how to make one.
struct BroadPhaseMethod {
  std::string_view name;  // "uniform grid"
  std::unique_ptr<BroadPhase> (*make)();
};

// All methods, brute force first.
std::span<const BroadPhaseMethod> broad_phases();

std::unique_ptr<BroadPhase> make_brute_force();
std::unique_ptr<BroadPhase> make_sweep_and_prune();
std::unique_ptr<BroadPhase> make_uniform_grid();
std::unique_ptr<BroadPhase> make_octree();
std::unique_ptr<BroadPhase> make_kd_tree();
std::unique_ptr<BroadPhase> make_bsp_tree();

// The pair (i, j) with the smaller index first.
inline BodyPair ordered(std::uint32_t i, std::uint32_t j) { return i < j ? BodyPair{i, j} : BodyPair{j, i}; }

}  // namespace plumbline
