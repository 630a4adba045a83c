// The three kinds of event: a collision, a search for a partner, a crossing into the next cell.
#include <algorithm>
#include <cmath>

#include "hard_sphere_gas_machine.hpp"

namespace plumbline {

bool HardSphereGas::Machine::wake(Id id) {
  ++events_since_tidy_;
  const GasCalendar::Event& event = calendar_[id];
  if (event.cross < sphere(id).meet) {
    cross(id);
    return false;
  }
  if (event.partner == kNobody) {
    search(id);
    return false;
  }
  collide(id, event.partner);
  return true;
}

// Equal masses: each takes the other's velocity along the line of centres. With r.r instead of the diameter squared
// energy is kept to rounding whatever the error of r.
void HardSphereGas::Machine::collide(Id a, Id b) {
  GasSphere &sa = sphere(a), &sb = sphere(b);
  fly(sa);
  fly(sb);
  const Vec3 r = separation(a, b);
  const double rv = r[0] * (sb.v[0] - sa.v[0]) + r[1] * (sb.v[1] - sa.v[1]) + r[2] * (sb.v[2] - sa.v[2]);
  const double rr = r.squaredNorm();
  for (int axis = 0; axis < 3; ++axis) {
    const double exchanged = rv / rr * r[axis];
    sa.v[axis] += exchanged;
    sb.v[axis] -= exchanged;
  }
  ++statistics_.collisions;
  statistics_.virial -= rv;
  statistics_.contact_error = std::max(statistics_.contact_error, std::abs(std::sqrt(rr) / diameter_ - 1));

  find_crossing(a);
  find_crossing(b);
  // Until its own search b is engaged now, so that a does not choose it on the strength of what it did before.
  calendar_[a].partner = calendar_[b].partner = kNobody;
  search(a);
  search(b);
}

// Through the side into the next cell. Whom it meets in the 18 cells that it could already see is known; nine are new.
void HardSphereGas::Machine::cross(Id id) {
  ++statistics_.crossings;
  GasSphere& s = sphere(id);
  GasCell& cell = calendar_[id].cell;
  const int axis = calendar_[id].leaves_by;
  const bool up = s.v[axis] > 0;
  calendar_.remove(id);
  cells_.remove(id, cell);
  fly(s);
  const int last = cells_.count(axis) - 1, from = cell.at[axis];
  cell.at[axis] = static_cast<std::uint16_t>(up ? (from == last ? 0 : from + 1) : (from == 0 ? last : from - 1));
  s.p[axis] += up ? -cells_.width(axis) : cells_.width(axis);
  cells_.insert(id, cell);
  find_crossing(id);

  static constexpr int kNew[3][9] = {{0, 3, 6, 9, 12, 15, 18, 21, 24},
                                     {0, 1, 2, 9, 10, 11, 18, 19, 20},
                                     {0, 1, 2, 3, 4, 5, 6, 7, 8}};  // on the lower side
  static constexpr int kAcross[3] = {2, 6, 18};
  const auto around = cells_.around(cell);
  near_.count = 0;
  for (const int k : kNew[axis]) cells_.append(around, up ? k + kAcross[axis] : k, near_);
  engage_best(id);
  enter(id);
}

// Whom does it meet first? Asked when its flight has changed or its partner is gone.
void HardSphereGas::Machine::search(Id id) {
  ++statistics_.predictions;
  calendar_.remove(id);
  sphere(id).meet = GasCalendar::kNever;
  fly(sphere(id));
  const auto around = cells_.around(calendar_[id].cell);
  near_.count = 0;
  for (int k = 0; k < kNeighbours; ++k) cells_.append(around, k, near_);
  engage_best(id);
  enter(id);
}

void HardSphereGas::Machine::engage_best(Id id) {
  GasSphere& s = sphere(id);
  find_meeting_times_(s, now_, diameter_ * diameter_, spheres_.data(), cells_.shifts(), near_);
  Id partner = kNobody;
  double meet = s.meet;
  for (int k = 0; k < near_.count; ++k) {
    const bool sooner = near_.time[k] < meet;
    meet = sooner ? near_.time[k] : meet;
    partner = sooner ? near_.id[k] : partner;
  }
  if (partner == kNobody) return;
  leave_partner(id);
  leave_partner(partner);
  s.meet = sphere(partner).meet = meet;
  calendar_[id].partner = partner;
  calendar_[partner].partner = id;
  calendar_.remove(partner);
  enter(partner);
}

// The one who is left looks for another at the time of the collision that is lost.
void HardSphereGas::Machine::leave_partner(Id id) {
  const Id left = calendar_[id].partner;
  if (left != kNobody) calendar_[left].partner = kNobody;
}

void HardSphereGas::Machine::enter(Id id) {
  const double meet = sphere(id).meet, cross = calendar_[id].cross;
  calendar_.insert(id, meet < cross ? meet : cross);
}

void HardSphereGas::Machine::fly(GasSphere& s) const {
  const double duration = now_ - s.time;
  for (int axis = 0; axis < 3; ++axis) s.p[axis] += s.v[axis] * duration;
  s.time = now_;
}

// From its place now: when, and through which side, it leaves its cell. Without a jump on the sign of the velocity,
// which is as good as random. Where v is 0 the quotient is infinite or, on the side itself, NaN, which is never less.
void HardSphereGas::Machine::find_crossing(Id id) {
  const GasSphere& s = sphere(id);
  double wait = GasCalendar::kNever;
  std::int32_t leaves_by = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double way = 0.5 * cells_.width(axis) - std::copysign(1.0, s.v[axis]) * s.p[axis];
    const double until = way / std::abs(s.v[axis]);
    leaves_by = until < wait ? axis : leaves_by;
    wait = until < wait ? until : wait;
  }
  calendar_[id].cross = now_ + (wait < 0 ? 0.0 : wait);
  calendar_[id].leaves_by = leaves_by;
}

}  // namespace plumbline
