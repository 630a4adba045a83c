// Course slide 17: every spatial index finds the pairs that brute force finds.
#include <gtest/gtest.h>

#include <algorithm>

#include "plumbline/core/broad_phase/broad_phase.hpp"
#include "scattered_boxes.hpp"

namespace plumbline {
namespace {

std::vector<std::unique_ptr<BroadPhase>> one_of_each() {
  std::vector<std::unique_ptr<BroadPhase>> methods;
  for (const BroadPhaseMethod& method : broad_phases()) methods.push_back(method.make());
  return methods;
}

// The same objects go through all scenes: what an earlier scene left in their memory must not matter.
TEST(BroadPhaseAgreement, HoldsInTenThousandRandomScenes) {
  const auto methods = one_of_each();
  ASSERT_EQ(methods.size(), 6u);
  Dice dice(17);
  std::vector<BodyPair> expected, found;
  std::vector<std::size_t> pairs_of_kind(kScatters, 0);
  for (int scene = 0; scene < 10000; ++scene) {
    const int kind = scene % kScatters;
    const std::size_t most = scene % 50 == 0 ? 400 : 60;
    const std::vector<Aabb> boxes = scattered_boxes(static_cast<Scatter>(kind), dice.below(most + 1), dice);
    methods[0]->pairs(boxes, expected);
    pairs_of_kind[static_cast<std::size_t>(kind)] += expected.size();
    for (const auto& method : methods) {
      method->pairs(boxes, found);
      ASSERT_EQ(found, expected) << method->name() << ", scene " << scene << ", kind " << kind << ", " << boxes.size()
                                 << " boxes";
    }
  }
  // A kind without pairs would show nothing; only the sparse one may have next to none.
  for (int kind = 0; kind + 1 < kScatters; ++kind)
    EXPECT_GT(pairs_of_kind[static_cast<std::size_t>(kind)], 200u) << kind;
}

TEST(BroadPhaseAgreement, HoldsForThousandsOfBoxesOfEachKind) {
  const auto methods = one_of_each();
  Dice dice(1717);
  std::vector<BodyPair> expected, found;
  for (int kind = 0; kind < kScatters; ++kind) {
    const bool dense =
        static_cast<Scatter>(kind) == Scatter::kOnePoint || static_cast<Scatter>(kind) == Scatter::kNested;
    const std::vector<Aabb> boxes = scattered_boxes(static_cast<Scatter>(kind), dense ? 300 : 3000, dice);
    methods[0]->pairs(boxes, expected);
    for (const auto& method : methods) {
      method->pairs(boxes, found);
      EXPECT_TRUE(found == expected) << method->name() << ", kind " << kind << ": " << found.size() << " pairs, not "
                                     << expected.size();
    }
  }
}

// k^3 unit cubes on a lattice touch their up to 26 neighbours. Counted by corners: along one axis there are 3k - 2
// ordered pairs (i, i') with |i - i'| <= 1, so ((3k - 2)^3 - k^3) / 2 unordered ones in space.
TEST(BroadPhaseAgreement, CountsTheTouchingCubesOfALattice) {
  for (const BroadPhaseMethod& method : broad_phases()) {
    const auto broad_phase = method.make();
    std::vector<BodyPair> pairs;
    for (std::size_t k = 1; k <= 9; ++k) {
      std::vector<Aabb> boxes;
      for (std::size_t i = 0; i < k * k * k; ++i) {
        const Vec3 at(static_cast<double>(i % k), static_cast<double>(i / k % k), static_cast<double>(i / k / k));
        boxes.push_back({at, at.array() + 1});
      }
      broad_phase->pairs(boxes, pairs);
      const std::size_t row = 3 * k - 2;
      EXPECT_EQ(pairs.size(), (row * row * row - k * k * k) / 2) << method.name << " " << k;
    }
  }
}

// Along a line, a box of length l at 0, 1, 2, ... meets those at distance <= l: sum of (n - d) for d = 1 ... floor(l).
TEST(BroadPhaseAgreement, CountsTheOverlapsOfARow) {
  constexpr std::size_t kCount = 500;
  for (const BroadPhaseMethod& method : broad_phases()) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      for (const std::size_t length : {0u, 1u, 2u, 7u, 100u}) {
        std::vector<Aabb> boxes;
        for (std::size_t i = 0; i < kCount; ++i) {
          Aabb box{Vec3::Zero(), Vec3::Ones()};
          box.min[axis] = static_cast<double>(i);
          box.max[axis] = static_cast<double>(i + length);
          boxes.push_back(box);
        }
        std::vector<BodyPair> pairs;
        method.make()->pairs(boxes, pairs);
        std::size_t expected = 0;
        for (std::size_t d = 1; d <= length; ++d) expected += kCount - d;
        EXPECT_EQ(pairs.size(), expected) << method.name << " " << length;
      }
    }
  }
}

// What the boxes are called must not matter, and neither must the unit of length: a power of two changes no digit.
TEST(BroadPhaseAgreement, IsBlindToOrderAndScale) {
  Dice dice(3);
  for (const BroadPhaseMethod& method : broad_phases()) {
    const auto broad_phase = method.make();
    for (int kind = 0; kind < kScatters; ++kind) {
      const std::vector<Aabb> boxes = scattered_boxes(static_cast<Scatter>(kind), 150, dice);
      std::vector<std::uint32_t> order(boxes.size());
      for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
      for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[dice.below(i)]);
      std::vector<Aabb> shuffled;
      for (const std::uint32_t i : order) shuffled.push_back({0x1p-60 * boxes[i].min, 0x1p-60 * boxes[i].max});
      std::vector<BodyPair> expected, found;
      broad_phase->pairs(boxes, expected);
      broad_phase->pairs(shuffled, found);
      for (BodyPair& pair : found) pair = ordered(order[pair.first], order[pair.second]);
      std::sort(found.begin(), found.end());
      EXPECT_TRUE(found == expected) << method.name << ", kind " << kind;
    }
  }
}

// Boxes that move a little between calls: the order kept from the last call (sweep and prune) must not leave any out.
TEST(BroadPhaseAgreement, HoldsWhileBoxesMove) {
  const auto methods = one_of_each();
  Dice dice(4);
  std::vector<Aabb> boxes = scattered_boxes(Scatter::kUniform, 300, dice);
  std::vector<Vec3> velocities;
  for (std::size_t i = 0; i < boxes.size(); ++i) velocities.push_back(dice.vector(0.2));
  std::vector<BodyPair> expected, found;
  std::size_t changes = 0;
  for (int step = 0; step < 60; ++step) {
    const std::vector<BodyPair> before = expected;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      boxes[i] = {boxes[i].min + velocities[i], boxes[i].max + velocities[i]};
    }
    methods[0]->pairs(boxes, expected);
    changes += expected == before ? 0 : 1;
    for (const auto& method : methods) {
      method->pairs(boxes, found);
      ASSERT_TRUE(found == expected) << method->name() << ", step " << step;
    }
  }
  EXPECT_GT(changes, 50u);
}

}  // namespace
}  // namespace plumbline
