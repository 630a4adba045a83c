// What the interface of the broad phases promises beside the right pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

#include "counted_allocations.hpp"
#include "plumbline/core/broad_phase/broad_phase.hpp"
#include "scattered_boxes.hpp"

namespace plumbline {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class BroadPhaseContract : public testing::TestWithParam<std::size_t> {
 protected:
  std::vector<BodyPair> pairs_of(const std::vector<Aabb>& boxes) {
    std::vector<BodyPair> pairs{{7, 9}};  // must be gone afterwards
    broad_phase_->pairs(boxes, pairs);
    return pairs;
  }
  // The text of the refusal, or nothing.
  std::string refusal(const std::vector<Aabb>& boxes) {
    try {
      pairs_of(boxes);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }
  std::unique_ptr<BroadPhase> broad_phase_ = broad_phases()[GetParam()].make();
};

Aabb unit_box(double x, double y = 0, double z = 0) { return {Vec3(x, y, z), Vec3(x + 1, y + 1, z + 1)}; }

TEST_P(BroadPhaseContract, NamesItselfAsTheTableDoes) {
  EXPECT_EQ(broad_phase_->name(), broad_phases()[GetParam()].name);
}

TEST_P(BroadPhaseContract, HasNoPairsWithoutTwoBoxes) {
  EXPECT_TRUE(pairs_of({}).empty());
  EXPECT_TRUE(pairs_of({unit_box(0)}).empty());
}

TEST_P(BroadPhaseContract, TakesTouchingForOverlapAndAGapOfOneRoundingForNone) {
  const std::vector<BodyPair> one{{0, 1}};
  for (int k = 1; k < 27; ++k) {  // across a face, an edge, a corner
    const double x = k % 3 - 1, y = k / 3 % 3 - 1, z = k / 9 - 1;
    EXPECT_EQ(pairs_of({unit_box(0), unit_box(x, y, z)}), one) << k;
  }
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    Aabb apart = unit_box(0);
    apart.min[axis] = std::nextafter(1.0, 2.0);
    apart.max[axis] = 2;
    EXPECT_TRUE(pairs_of({unit_box(0), apart}).empty());
    EXPECT_TRUE(pairs_of({apart, unit_box(0)}).empty());
  }
}

TEST_P(BroadPhaseContract, SortsPairsWithTheSmallerIndexFirst) {
  Dice dice(1);
  const std::vector<BodyPair> pairs = pairs_of(scattered_boxes(Scatter::kUniform, 500, dice));
  ASSERT_GT(pairs.size(), 100u);
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
  EXPECT_EQ(std::adjacent_find(pairs.begin(), pairs.end()), pairs.end());
  EXPECT_TRUE(std::all_of(pairs.begin(), pairs.end(), [](BodyPair p) { return p.first < p.second; }));
}

TEST_P(BroadPhaseContract, RefusesNanAndInvertedBoxesByIndex) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      std::vector<Aabb> boxes{unit_box(0), unit_box(0), unit_box(0), unit_box(0)};
      (upper ? boxes[2].max : boxes[2].min)[axis] = kNan;
      EXPECT_NE(refusal(boxes).find("box 2"), std::string::npos);
      EXPECT_NE(refusal(boxes).find(std::string("along ") + "xyz"[axis]), std::string::npos);
    }
    std::vector<Aabb> boxes{unit_box(0), unit_box(0)};
    boxes[1].max[axis] = std::nextafter(boxes[1].min[axis], -1.0);
    EXPECT_NE(refusal(boxes).find("box 1"), std::string::npos);
    boxes[1].max[axis] = boxes[1].min[axis];  // flat, which is fine
    EXPECT_EQ(refusal(boxes), "");
  }
}

TEST_P(BroadPhaseContract, TakesUnboundedBoxesAlong) {
  const Aabb floor{Vec3(-kInf, -kInf, -kInf), Vec3(kInf, kInf, 0)};
  const Aabb everywhere{Vec3::Constant(-kInf), Vec3::Constant(kInf)};
  const Aabb largest{Vec3::Constant(-std::numeric_limits<double>::max()),
                     Vec3::Constant(std::numeric_limits<double>::max())};
  EXPECT_EQ(pairs_of({unit_box(0, 0, 5), floor, unit_box(9, 9, -0.5)}), (std::vector<BodyPair>{{1, 2}}));
  EXPECT_EQ(pairs_of({everywhere, unit_box(0), floor, unit_box(0.5)}),
            (std::vector<BodyPair>{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}));
  EXPECT_EQ(pairs_of({largest, unit_box(0), largest}), (std::vector<BodyPair>{{0, 1}, {0, 2}, {1, 2}}));
}

TEST_P(BroadPhaseContract, WorksAtTheEndsOfTheNumberRange) {
  for (const double unit : {5e-324, 1e-300, 1e-30, 1e30, 4e99}) {
    std::vector<Aabb> boxes;
    for (int k = 0; k < 40;
         ++k) {  // (k mod 20, k mod 20 + 1) twice, along x: 19 neighbours in each row, 3 20 - 2 across
      const double x = k % 20 - 10;
      boxes.push_back({unit * Vec3(x, 0, 0), unit * Vec3(x + 1, 1, 1)});
    }
    EXPECT_EQ(pairs_of(boxes).size(), 19u + 19u + 58u) << unit;
  }
}

// One tiny box in every corner of a huge scene, and pairs of them that touch.
TEST_P(BroadPhaseContract, FindsTinyBoxesInAHugeScene) {
  std::vector<Aabb> boxes;
  for (int k = 0; k < 64; ++k) {
    const double far = 1e15;
    const Vec3 at((k & 1) != 0 ? far : -far, (k & 2) != 0 ? far : -far, (k & 4) != 0 ? far : -far);
    boxes.push_back({at, at.array() + 0.125 * (k / 8)});  // multiples of the spacing of doubles at 1e15
  }
  EXPECT_EQ(pairs_of(boxes).size(), 8u * (8 * 7 / 2));
}

TEST_P(BroadPhaseContract, AllocatesNothingOnceItsMemoryHasGrown) {
  Dice dice(2);
  for (int kind = 0; kind < kScatters; ++kind) {
    std::vector<Aabb> boxes = scattered_boxes(static_cast<Scatter>(kind), 200, dice);
    boxes.push_back({Vec3::Constant(-kInf), Vec3::Constant(kInf)});
    std::vector<BodyPair> pairs;
    broad_phase_->pairs(boxes, pairs);
    const std::size_t before = counted_allocations();
    broad_phase_->pairs(boxes, pairs);
    EXPECT_EQ(counted_allocations() - before, 0u) << kind;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, BroadPhaseContract, testing::Range<std::size_t>(0, 6), [](const auto& test) {
  std::string name(broad_phases()[test.param].name);
  std::erase_if(name, [](char c) { return c == ' ' || c == '-'; });
  return name;
});

TEST(BroadPhaseTable, NamesSixDifferentMethods) {
  std::set<std::string_view> names;
  for (const BroadPhaseMethod& method : broad_phases()) names.insert(method.name);
  EXPECT_EQ(names.size(), 6u);
  EXPECT_EQ(broad_phases()[0].name, "brute force");
}

}  // namespace
}  // namespace plumbline
