// Every box against every other: n (n-1) / 2 tests. The definition of the answer, and the fastest up to some dozen
// boxes.
#include "plumbline/core/broad_phase/broad_phase.hpp"

namespace plumbline {
namespace {

class BruteForce final : public BroadPhase {
 public:
  std::string_view name() const override { return "brute force"; }

 private:
  void find(std::span<const Aabb> boxes, std::vector<BodyPair>& pairs) override {
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
        if (overlap(boxes[i], boxes[j])) pairs.push_back({i, j});
      }
    }
  }
};

}  // namespace

std::unique_ptr<BroadPhase> make_brute_force() { return std::make_unique<BruteForce>(); }

}  // namespace plumbline
