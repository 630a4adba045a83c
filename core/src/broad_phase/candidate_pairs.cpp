#include "plumbline/core/broad_phase/candidate_pairs.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace plumbline {

CandidatePairs::CandidatePairs(std::unique_ptr<BroadPhase> broad_phase) : broad_phase_(std::move(broad_phase)) {
  if (!broad_phase_) throw std::invalid_argument("candidate pairs without a broad phase: give it one");
}

std::span<const BodyPair> CandidatePairs::find(std::span<const Body> bodies, std::span<const Motion> motions,
                                               double duration, double margin) {
  if (bodies.size() != motions.size()) {
    throw std::invalid_argument(std::to_string(motions.size()) + " motions for " + std::to_string(bodies.size()) +
                                " bodies: one per body is needed");
  }
  if (!(margin >= 0)) throw std::invalid_argument("a margin of " + std::to_string(margin) + " m: it must be >= 0");
  boxes_.clear();
  names_.clear();
  half_spaces_.clear();
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    if (std::holds_alternative<HalfSpace>(bodies[i].shape)) {
      half_spaces_.push_back(i);
    } else {
      const double time = bodies[i].fixed ? 0 : duration;
      boxes_.push_back(grown(swept_box(bodies[i].shape, motions[i], time), 0.5 * margin));
      names_.push_back(i);
    }
  }
  broad_phase_->pairs(boxes_, pairs_);
  for (BodyPair& pair : pairs_) pair = {names_[pair.first], names_[pair.second]};  // names rise: the order stays
  std::erase_if(pairs_, [&](BodyPair pair) { return bodies[pair.first].fixed && bodies[pair.second].fixed; });
  if (half_spaces_.empty()) return pairs_;

  for (const std::uint32_t h : half_spaces_) {
    const auto& half_space = std::get<HalfSpace>(bodies[h].shape);
    const Vec3 surface = motions[h].start.p_WB + 0.5 * margin * half_space.normal;
    for (std::size_t k = 0; k < boxes_.size(); ++k) {
      if (!bodies[names_[k]].fixed && overlap(boxes_[k], half_space, surface)) pairs_.push_back(ordered(h, names_[k]));
    }
  }
  std::sort(pairs_.begin(), pairs_.end());
  return pairs_;
}

}  // namespace plumbline
