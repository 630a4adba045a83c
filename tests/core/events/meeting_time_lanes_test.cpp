// The innermost loop of the fast gas: the same bits whatever the processor can do at once.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <vector>

#include "hard_sphere_gas_meeting.hpp"
#include "hard_sphere_scene.hpp"

namespace plumbline {
namespace {

class MeetingTimeLanes : public testing::Test {
 protected:
  // A sphere at the origin and others around it, with all that can happen: far, near, overlapping, at rest, engaged.
  void SetUp() override {
    gas::Normal random(21);
    spheres_.resize(400);
    for (GasSphere& s : spheres_) {
      for (int axis = 0; axis < 3; ++axis) {
        s.p[axis] = 0.6 * random();
        s.v[axis] = random.uniform() < 0.1 ? 0.0 : random();
      }
      s.time = -random.uniform();
      s.meet = random.uniform() < 0.5 ? std::numeric_limits<double>::infinity() : 2 * random.uniform();
    }
    spheres_[0] = {{0, 0, 0}, {0.3, -0.2, 0.1}, 0, 0};
  }

  GasCandidates candidates(int first, int count) const {
    GasCandidates near;
    for (int k = 0; k < count; ++k) {
      near.id[near.count] = first + k;
      near.neighbour[near.count++] = k % kNeighbours;
    }
    return near;
  }

  const double box_[3] = {8, 9, 10};
  const GasCells cells_{box_, 1, 0};
  std::vector<GasSphere> spheres_;
};

TEST_F(MeetingTimeLanes, AllGiveTheSameBits) {
  int meetings = 0;
  for (int lanes = 4; lanes <= widest_lanes(); lanes *= 2) {
    for (int count = 0; count <= 40; ++count) {
      GasCandidates two = candidates(1 + 7 * count, count), many = two;
      meeting_times_by(2)(spheres_[0], 0.25, 1, spheres_.data(), cells_.shifts(), two);
      meeting_times_by(lanes)(spheres_[0], 0.25, 1, spheres_.data(), cells_.shifts(), many);
      for (int k = 0; k < count; ++k) {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(two.time[k]), std::bit_cast<std::uint64_t>(many.time[k]))
            << lanes << " lanes, " << count << " candidates, number " << k;
        meetings += std::isfinite(two.time[k]);
      }
    }
  }
  EXPECT_TRUE(widest_lanes() == 2 || meetings > 50);
}

// Checked by going there: at the time found the distance is the diameter and shrinks, and it was larger before.
TEST_F(MeetingTimeLanes, AreTimesAtWhichSpheresTouchAndApproach) {
  const double now = 0.25;
  GasCandidates near = candidates(1, 300);
  meeting_times_by(widest_lanes())(spheres_[0], now, 1, spheres_.data(), cells_.shifts(), near);
  const auto state = [&](int k, double t, Vec3& r, Vec3& v) {
    const GasSphere &a = spheres_[0], &b = spheres_[static_cast<std::size_t>(near.id[k])];
    for (int axis = 0; axis < 3; ++axis) {
      v[axis] = b.v[axis] - a.v[axis];
      // The clock of the first shows `now` whatever it says.
      r[axis] = b.p[axis] + b.v[axis] * (t - b.time) + cells_.shifts()[near.neighbour[k]].by[axis] -
                (a.p[axis] + a.v[axis] * (t - now));
    }
  };
  int checked = 0;
  for (int k = 0; k < near.count; ++k) {
    Vec3 r, v;
    state(k, now, r, v);
    const bool engaged_before = spheres_[static_cast<std::size_t>(near.id[k])].meet <= near.time[k];
    if (std::isfinite(near.time[k])) {
      ++checked;
      EXPECT_FALSE(engaged_before);
      EXPECT_LT(r.dot(v), 0);
      if (r.norm() < 1) {
        EXPECT_EQ(near.time[k], now);
      } else {
        state(k, near.time[k], r, v);
        // d(|r|)/dt <= |v| < 8, times within 4 s are good to some 1e-15 over the sine of a grazing angle.
        EXPECT_NEAR(r.norm(), 1, 1e-13);
        EXPECT_LE(r.dot(v), 1e-12);
      }
    } else if (spheres_[static_cast<std::size_t>(near.id[k])].meet == std::numeric_limits<double>::infinity() &&
               r.dot(v) < 0) {
      // Not engaged, coming nearer and yet no meeting: it must pass at a distance of more than a diameter.
      EXPECT_GT((r - r.dot(v) / v.squaredNorm() * v).norm(), 1);
    }
  }
  EXPECT_GT(checked, 10);
}

}  // namespace
}  // namespace plumbline
