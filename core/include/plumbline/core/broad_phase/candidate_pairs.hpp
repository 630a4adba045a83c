// From a scene to the few pairs of bodies that need an exact test (course slide 17).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "plumbline/core/broad_phase/broad_phase.hpp"
#include "plumbline/core/broad_phase/swept_bounds.hpp"

namespace plumbline {

// Which bodies may meet within a step: those whose swept boxes (swept_bounds.hpp) overlap. Pairs of two fixed bodies
// are left out. Half-spaces have no box that would save anything: each is compared with the swept box of every body
// that moves, which is one dot product. No pair that meets within the step is ever left out, so that exact tests on the
// candidates find what exact tests on all pairs would.
class CandidatePairs {
 public:
  explicit CandidatePairs(std::unique_ptr<BroadPhase> broad_phase = make_uniform_grid());

  // motions[i] is that of bodies[i] for the next `duration` [s]; fixed bodies stay where their motion starts. Boxes are
  // grown by margin/2 [m] all round: so bodies that come as close as the margin along every axis are candidates too,
  // which a solver with a contact tolerance needs. The pairs are in order, and valid until the next call.
  // Throws std::invalid_argument for another number of motions than bodies, a margin < 0, or a motion that
  // is not finite.
  std::span<const BodyPair> find(std::span<const Body> bodies, std::span<const Motion> motions, double duration,
                                 double margin = 0);

 private:
  std::unique_ptr<BroadPhase> broad_phase_;
  std::vector<Aabb> boxes_;
  std::vector<std::uint32_t> names_, half_spaces_;  // the body of each box; bodies without a box
  std::vector<BodyPair> pairs_;
};

}  // namespace plumbline
