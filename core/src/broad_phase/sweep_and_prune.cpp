// Sweep and prune (Baraff 1992; Cohen, Lin, Manocha and Ponamgi, I-COLLIDE, 1995), along one axis.
//
// Sort the boxes by where they begin along an axis. A box can only overlap those that begin before it ends: they follow
// it in the sorted list, and the first one that begins later ends the search. The axis is the one along which the boxes
// are spread most. In a cube of n boxes each still meets the n^(2/3) that lie beside it: n^(5/3) in all; a long row of
// boxes costs n log n.
//
// Temporal coherence: between two steps few boxes overtake each other. The order of the last call is the start of the
// next one, and insertion sort repairs it with one move for each overtaking.
#include <algorithm>
#include <numeric>

#include "plumbline/core/broad_phase/broad_phase.hpp"

namespace plumbline {
namespace {

// The axis along which the centres vary most.
Eigen::Index widest_axis(std::span<const Aabb> boxes) {
  Vec3 mean = Vec3::Zero(), variance = Vec3::Zero();
  for (const Aabb& box : boxes) mean += centre(box) / static_cast<double>(boxes.size());
  for (const Aabb& box : boxes) variance += (centre(box) - mean).cwiseAbs2();
  Eigen::Index axis = 0;
  variance.maxCoeff(&axis);
  return axis;
}

class SweepAndPrune final : public BroadPhase {
 public:
  std::string_view name() const override { return "sweep and prune"; }

 private:
  struct Entry {
    Aabb box;
    std::uint32_t body;
  };

  void find(std::span<const Aabb> boxes, std::vector<BodyPair>& pairs) override {
    if (boxes.empty()) return;
    axis_ = widest_axis(boxes);
    if (sweep_.size() != boxes.size()) {
      sweep_.resize(boxes.size());
      for (std::uint32_t i = 0; i < boxes.size(); ++i) sweep_[i].body = i;
    }
    for (Entry& entry : sweep_) entry.box = boxes[entry.body];
    sort();
    for (auto a = sweep_.begin(); a != sweep_.end(); ++a) {
      const double end = a->box.max[axis_];
      for (auto b = a + 1; b != sweep_.end() && b->box.min[axis_] <= end; ++b) {
        if (overlap(a->box, b->box)) pairs.push_back(ordered(a->body, b->body));
      }
    }
  }

  // Insertion sort, for as long as it pays: an order that is new to it would cost n^2 moves.
  void sort() {
    const auto before = [this](const Entry& a, const Entry& b) { return a.box.min[axis_] < b.box.min[axis_]; };
    std::size_t moves_left = 8 * sweep_.size();
    for (std::size_t k = 1; k < sweep_.size(); ++k) {
      if (!before(sweep_[k], sweep_[k - 1])) continue;
      const Entry entry = sweep_[k];
      std::size_t hole = k;
      while (hole > 0 && moves_left > 0 && before(entry, sweep_[hole - 1])) {
        sweep_[hole] = sweep_[hole - 1];
        --hole;
        --moves_left;
      }
      sweep_[hole] = entry;
      if (moves_left == 0) {
        std::sort(sweep_.begin(), sweep_.end(), before);
        return;
      }
    }
  }

  Eigen::Index axis_ = 0;
  std::vector<Entry> sweep_;
};

}  // namespace

std::unique_ptr<BroadPhase> make_sweep_and_prune() { return std::make_unique<SweepAndPrune>(); }

}  // namespace plumbline
