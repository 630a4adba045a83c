// What turns inside HardSphereGas: spheres, cells and calendar, and the three kinds of event.
//
// Why one event a sphere is enough. Let meet(i) be the time for which sphere i is engaged, to collide or to look again.
// For every two neighbours i and j whose flights would bring them together at t_ij, it always holds that
//
//   t_ij >= min(meet(i), meet(j))
//
// Searching for i takes the earliest t_ij for which j is not engaged before, so it holds afterwards for all j. Where j
// leaves an old partner k for i, meet(j) falls and meet(k) stays: k looks again at the time of the lost collision, and
// not before, since nothing earlier was open to it. So the earliest engagement of all is always a true collision.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hard_sphere_gas_calendar.hpp"
#include "hard_sphere_gas_cells.hpp"
#include "hard_sphere_gas_meeting.hpp"
#include "plumbline/core/events/hard_sphere_gas.hpp"

namespace plumbline {

class HardSphereGas::Machine {
 public:
  Machine(std::span<const Vec3> positions, std::span<const Vec3> velocities, double diameter, const Vec3& box);

  HardSphereCollision collide_next();
  void run_until(double t);

  double time() const { return epoch_ + now_; }
  std::size_t size() const { return number_.size() - 1; }
  const HardSphereStatistics& statistics() const { return statistics_; }
  std::vector<Vec3> positions() const;
  std::vector<Vec3> velocities() const;
  double velocity_square_sum() const;
  double smallest_gap() const;

 private:
  using Id = std::int32_t;  // place in storage, from 1 on; changes with every tidy_up
  static constexpr Id kNobody = GasCells::kNobody;

  Id last() const { return static_cast<Id>(size()); }
  GasSphere& sphere(Id id) { return spheres_[static_cast<std::size_t>(id)]; }
  const GasSphere& sphere(Id id) const { return spheres_[static_cast<std::size_t>(id)]; }
  std::size_t number(Id id) const { return number_[static_cast<std::size_t>(id)]; }

  void place(Id id, const Vec3& position, const Vec3& velocity);
  void tidy_up();

  bool wake(Id id);  // true where that was a collision
  void collide(Id a, Id b);
  void cross(Id id);
  void search(Id id);

  void fly(GasSphere& sphere) const;
  void find_crossing(Id id);
  void engage_best(Id id);
  void leave_partner(Id id);
  void enter(Id id);
  Vec3 separation(Id a, Id b) const;

  double diameter_;
  Vec3 box_;
  GasCells cells_;
  PagedVector<GasSphere> spheres_;   // the first is nobody
  std::vector<std::size_t> number_;  // by which the outside knows the sphere
  GasCalendar calendar_;
  GasCandidates near_;
  FindMeetingTimes find_meeting_times_ = meeting_times_by(widest_lanes());
  double epoch_ = 0;  // when the clock was last set back
  double now_ = 0;    // since then
  std::uint64_t events_since_tidy_ = 0;
  bool at_rest_ = false;  // nothing moves
  HardSphereStatistics statistics_;
};

}  // namespace plumbline
