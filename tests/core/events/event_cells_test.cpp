#include "plumbline/core/events/event_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "plumbline/core/events/event_queue.hpp"

namespace plumbline {
namespace {

double uniform(std::mt19937_64& bits) { return static_cast<double>(bits() >> 11) * 0x1p-53; }

TEST(EventCells, ShowEveryoneWithinACellWidthOnce) {
  for (const bool periodic : {false, true}) {
    std::mt19937_64 bits(3);
    const int n = 400;
    const double width = 1.3;
    const Vec3 edge(7, 5, 9);
    EventCells cells(Vec3::Zero(), edge, width, n, periodic);
    std::vector<Vec3> p;
    for (int k = 0; k < n; ++k) {
      // In an open grid some are outside: they belong to its outer cells.
      const double spread = periodic ? 1 : 1.4;
      p.push_back(edge.cwiseProduct(Vec3(uniform(bits), uniform(bits), uniform(bits))) * spread);
      cells.insert(k, p.back());
    }
    int near_pairs = 0;
    for (int i = 0; i < n; ++i) {
      std::set<int> seen;
      cells.visit_near(i, [&](int j, const Vec3& shift) {
        EXPECT_TRUE(seen.insert(j).second);
        const Vec3 d = p[static_cast<std::size_t>(j)] - p[static_cast<std::size_t>(i)];
        if (!periodic) {
          EXPECT_EQ(shift, Vec3::Zero());
        }
        // The image shown is one within two cells.
        if (periodic) {
          EXPECT_LE((d + shift).cwiseAbs().maxCoeff(), 2 * 9.0 / 3);
        }
      });
      for (int j = 0; j < n; ++j) {
        Vec3 d = p[static_cast<std::size_t>(j)] - p[static_cast<std::size_t>(i)];
        if (periodic) d -= d.cwiseQuotient(edge).array().round().matrix().cwiseProduct(edge);
        if (i == j || d.norm() >= width) continue;
        ++near_pairs;
        EXPECT_TRUE(seen.contains(j)) << i << " does not see " << j;
      }
    }
    EXPECT_GT(near_pairs, n);
  }
}

TEST(EventCells, FollowABodyAcrossFacesAndRoundThePeriodicBox) {
  EventCells cells(Vec3::Zero(), Vec3(4, 4, 4), 1, 2, true);
  cells.insert(0, Vec3(3.5, 0.5, 0.5));
  cells.insert(1, Vec3(2.5, 0.5, 0.5));
  const double width = cells.upper_face(0, 0) - cells.lower_face(0, 0);
  EXPECT_NEAR(width * cells.counts().x(), 4, 1e-15);
  double jumps = 0;
  for (int k = 0; k < cells.counts().x(); ++k) jumps += cells.cross(0, 0, true);
  EXPECT_EQ(jumps, -4);
  EXPECT_EQ(cells.cross(0, 1, false), 4);
  EventCells open(Vec3::Zero(), Vec3(4, 4, 4), 1, 2, false);
  open.insert(0, Vec3(99, -99, 0.5));
  EXPECT_EQ(open.upper_face(0, 0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(open.lower_face(0, 1), -std::numeric_limits<double>::infinity());
}

TEST(EventQueue, AlwaysKnowsTheFirst) {
  std::mt19937_64 bits(11);
  for (const int n : {1, 2, 3, 37}) {
    EventQueue queue(n);
    EXPECT_EQ(queue.first(), 0);
    std::vector<double> times(static_cast<std::size_t>(n), std::numeric_limits<double>::infinity());
    for (int k = 0; k < 2000; ++k) {
      const auto body = static_cast<std::size_t>(bits() % static_cast<std::uint64_t>(n));
      // Few different values, so that many are equal: the smaller index goes first.
      times[body] = std::floor(10 * uniform(bits));
      queue.set(static_cast<int>(body), times[body]);
      ASSERT_EQ(queue.first(), std::min_element(times.begin(), times.end()) - times.begin());
    }
  }
}

}  // namespace
}  // namespace plumbline
