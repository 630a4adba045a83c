// The coefficients against the order conditions: one equation for each rooted tree.
//
// A method has order p when for every rooted tree tau with up to p nodes
//
//   sum_i b_i g_i(tau) = 1/gamma(tau),   g_i(tau) = prod over subtrees s of (sum_j a_ij g_j(s)),
//   gamma(tau) = nodes(tau) prod gamma(s)
//
// (Butcher, Math. Comp. 18 (1964) 50; Hairer, Norsett, Wanner, Solving ODEs I, section II.2.) The trees are made here,
// none is written down: 1, 1, 2, 4, 9, 20, 48, 115, 286 of them with 1 to 9 nodes (OEIS A000081).
#include "plumbline/core/integration/dormand_prince_tableau.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace plumbline {
namespace {

using namespace dormand_prince_tableau;
using Stages = std::array<long double, kStages>;

struct Tree {
  std::size_t nodes = 1;
  long double gamma = 1;
  Stages g{};     // g_i
  Stages size{};  // the same with |a_ij|: what rounding errors are relative to
};

// Grafts the trees of `forest` with index up to `last` and `left` nodes in all on one root, in every way.
void graft(const std::vector<Tree>& forest, std::size_t last, std::size_t left, const Tree& so_far,
           std::vector<Tree>& out) {
  if (left == 0) {
    out.push_back(so_far);
    out.back().gamma *= static_cast<long double>(so_far.nodes);
    return;
  }
  for (std::size_t n = 0; n <= last && n < forest.size(); ++n) {
    const Tree& sub = forest[n];
    if (sub.nodes > left) continue;
    Tree grown = so_far;
    grown.nodes += sub.nodes;
    grown.gamma *= sub.gamma;
    for (std::size_t i = 0; i < kStages; ++i) {
      long double sum = 0, size = 0;
      for (std::size_t j = 0; j < i; ++j) {
        sum += kA[i][j] * sub.g[j];
        size += std::abs(kA[i][j]) * sub.size[j];
      }
      grown.g[i] *= sum;
      grown.size[i] *= size;
    }
    graft(forest, n, left - sub.nodes, grown, out);
  }
}

// All rooted trees with up to that many nodes, smallest first.
std::vector<Tree> trees(std::size_t most) {
  Tree root;
  root.g.fill(1);
  root.size.fill(1);
  std::vector<Tree> forest;
  for (std::size_t nodes = 1; nodes <= most; ++nodes) {
    std::vector<Tree> next;
    graft(forest, forest.size(), nodes - 1, root, next);
    forest.insert(forest.end(), next.begin(), next.end());
  }
  return forest;
}

struct Defect {
  long double value = 0;     // |sum b g - 1/gamma|
  long double rounding = 0;  // what coefficients of double precision may leave of it
};

Defect defect(const Weights& weights, const Tree& tree, bool consistent) {
  long double sum = 0, size = 0;
  for (std::size_t i = 0; i < kStages; ++i) {
    sum += weights[i] * tree.g[i];
    size += std::abs(weights[i]) * tree.size[i];
  }
  // Each product holds one coefficient a node, each wrong by half a unit in the last place.
  const long double unit = std::numeric_limits<double>::epsilon() / 2;
  return {std::abs(sum - (consistent ? 1 / tree.gamma : 0)), static_cast<long double>(tree.nodes) * unit * size};
}

// The order that the weights reach; for a difference of weights, the order up to which both formulas agree.
std::size_t order(const Weights& weights, bool consistent) {
  std::size_t order = 9;
  for (const Tree& tree : trees(9)) {
    const Defect d = defect(weights, tree, consistent);
    if (!(d.value <= d.rounding)) order = std::min(order, tree.nodes - 1);
  }
  return order;
}

TEST(DormandPrinceTableau, IsHeldAgainstAllTrees) {
  const std::vector<Tree> forest = trees(9);
  const std::size_t counts[] = {1, 1, 2, 4, 9, 20, 48, 115, 286};
  for (std::size_t n = 1; n <= 9; ++n) {
    EXPECT_EQ(std::count_if(forest.begin(), forest.end(), [&](const Tree& t) { return t.nodes == n; }),
              static_cast<std::ptrdiff_t>(counts[n - 1]));
  }
  // The tall tree of n nodes has gamma n!, the bush n: the ends of each list.
  EXPECT_EQ(forest[3].gamma * forest[2].gamma, 6 * 3);
}

TEST(DormandPrinceTableau, MeetsAll200ConditionsOfOrderEightAndNoMore) {
  EXPECT_EQ(trees(8).size(), 200u);
  EXPECT_EQ(order(kB, true), 8u);
}

TEST(DormandPrinceTableau, ComparesWithFormulasOfOrderFiveAndThree) {
  EXPECT_EQ(order(kE5, false), 5u);
  EXPECT_EQ(order(kE3, false), 3u);
  EXPECT_EQ(order(kB3, true), 3u);
}

TEST(DormandPrinceTableau, PutsStagesWhereTheirRowsSumTo) {
  for (std::size_t i = 0; i < kStages; ++i) {
    long double sum = 0, size = 0;
    for (const double a : kA[i]) {
      sum += a;
      size += std::abs(a);
    }
    EXPECT_NEAR(static_cast<double>(sum), kC[i], static_cast<double>(size) * std::numeric_limits<double>::epsilon());
  }
}

TEST(DormandPrinceTableau, IsCaughtWithAWrongDigit) {
  Weights wrong = kB;
  wrong[6] *= 1 + 1e-13;
  EXPECT_EQ(order(wrong, true), 0u);
}

}  // namespace
}  // namespace plumbline
