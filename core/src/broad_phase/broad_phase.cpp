#include "plumbline/core/broad_phase/broad_phase.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace plumbline {
namespace {

void validate(std::span<const Aabb> boxes) {
  if (boxes.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw std::invalid_argument(std::to_string(boxes.size()) + " boxes: a broad phase takes fewer than 2^32");
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double low = boxes[i].min[axis], high = boxes[i].max[axis];
      if (low <= high) continue;  // false for NaN
      throw std::invalid_argument("box " + std::to_string(i) + " reaches from " + std::to_string(low) + " to " +
                                  std::to_string(high) + " m along " + "xyz"[axis] +
                                  ": a box needs min <= max along every axis, and no NaN");
    }
  }
}

bool is_bounded(const Aabb& box) {
  return box.min.minCoeff() >= -kUnboundedReach && box.max.maxCoeff() <= kUnboundedReach;
}

}  // namespace

void BroadPhase::pairs(std::span<const Aabb> boxes, std::vector<BodyPair>& pairs) {
  pairs.clear();
  validate(boxes);
  if (std::all_of(boxes.begin(), boxes.end(), is_bounded)) {
    find(boxes, pairs);
  } else {
    find_all(boxes, pairs);
  }
  sort(boxes.size(), pairs);
}

void BroadPhase::find_all(std::span<const Aabb> boxes, std::vector<BodyPair>& pairs) {
  bounded_.clear();
  names_.clear();
  unbounded_.clear();
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (is_bounded(boxes[i])) {
      bounded_.push_back(boxes[i]);
      names_.push_back(i);
    } else {
      unbounded_.push_back(i);
    }
  }
  find(bounded_, pairs);
  for (BodyPair& pair : pairs) pair = ordered(names_[pair.first], names_[pair.second]);
  for (const std::uint32_t i : unbounded_) {
    for (std::uint32_t j = 0; j < boxes.size(); ++j) {
      if (j <= i && !is_bounded(boxes[j])) continue;  // itself, or two unbounded ones: found when it was their turn
      if (overlap(boxes[i], boxes[j])) pairs.push_back(ordered(i, j));
    }
  }
}

// Counting sort by the first body, then each body's few partners by comparison: linear where std::sort is n log n.
void BroadPhase::sort(std::size_t bodies, std::vector<BodyPair>& pairs) {
  if (pairs.size() > std::numeric_limits<std::uint32_t>::max()) {  // 32 GiB of them: then it does not matter
    std::sort(pairs.begin(), pairs.end());
    return;
  }
  starts_.assign(bodies + 1, 0);
  for (const BodyPair& pair : pairs) ++starts_[pair.first];
  std::uint32_t sum = 0;
  for (std::uint32_t& start : starts_) sum += std::exchange(start, sum);
  seconds_.resize(pairs.size());
  for (const BodyPair& pair : pairs) seconds_[starts_[pair.first]++] = pair.second;  // a start becomes an end
  std::size_t k = 0;
  for (std::uint32_t first = 0; first < bodies; ++first) {
    std::sort(seconds_.begin() + static_cast<std::ptrdiff_t>(k), seconds_.begin() + starts_[first]);
    for (; k < starts_[first]; ++k) pairs[k] = {first, seconds_[k]};
  }
}

std::span<const BroadPhaseMethod> broad_phases() {
  static constexpr std::array<BroadPhaseMethod, 6> kMethods{{{"brute force", make_brute_force},
                                                             {"sweep and prune", make_sweep_and_prune},
                                                             {"uniform grid", make_uniform_grid},
                                                             {"octree", make_octree},
                                                             {"kd-tree", make_kd_tree},
                                                             {"BSP tree", make_bsp_tree}}};
  return kMethods;
}

}  // namespace plumbline
