#include "hard_sphere_gas_machine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace plumbline {
namespace {

// Events a sphere after which storage is sorted and the clock set back. Spheres drift about a diameter in that time.
constexpr std::uint64_t kTidyInterval = 24;

// Collisions become rare in a thin gas, but not that rare.
constexpr std::uint64_t kCrossingsWithoutCollision = 100'000'000;

double mean_square(std::span<const Vec3> velocities) {
  double sum = 0;
  for (const Vec3& v : velocities) sum += v.squaredNorm();
  return velocities.empty() ? 0 : sum / static_cast<double>(velocities.size());
}

// Events a sphere and unit of time: crossings of cells about one diameter wide, and collisions by Enskog's theory with
// Carnahan and Starling's value at contact. Only speed depends on it.
double expected_rate(std::span<const Vec3> velocities, double diameter, const Vec3& box) {
  const double thermal = std::sqrt(mean_square(velocities) / 3);
  const double density = static_cast<double>(velocities.size()) * std::pow(diameter, 3) / box.prod();
  const double packing = std::min(std::numbers::pi / 6 * density, 0.6);
  const double contact = (1 - packing / 2) / std::pow(1 - packing, 3);
  const double crossings = 3 * std::sqrt(2 / std::numbers::pi);
  const double collisions = 4 * std::sqrt(std::numbers::pi) * density * contact;
  return thermal / diameter * (crossings + collisions);
}

// Bits of x, y and z taken in turn (Morton's order): what is near in space is near in storage, along all three axes.
std::uint64_t space_order(const GasCell& cell) {
  std::uint64_t key = 0;
  for (int bit = 0; bit < 16; ++bit) {
    for (int axis = 0; axis < 3; ++axis) {
      key |= static_cast<std::uint64_t>(cell.at[axis] >> bit & 1) << (3 * bit + axis);
    }
  }
  return key;
}

}  // namespace

HardSphereGas::Machine::Machine(std::span<const Vec3> positions, std::span<const Vec3> velocities, double diameter,
                                const Vec3& box)
    : diameter_(diameter),
      box_(box),
      cells_(box.data(), diameter, positions.size()),
      spheres_(positions.size() + 1),
      number_(positions.size() + 1),
      calendar_(positions.size(), expected_rate(velocities, diameter, box)),
      at_rest_(mean_square(velocities) == 0) {
  // Nobody: stands nowhere and is never to be had.
  spheres_[0] = {};
  for (Id id = 1; id <= last(); ++id) {
    const auto i = static_cast<std::size_t>(id) - 1;
    number_[i + 1] = i;
    place(id, positions[i], velocities[i]);
    find_crossing(id);
  }
  tidy_up();
  for (Id id = 1; id <= last(); ++id) search(id);
}

void HardSphereGas::Machine::place(Id id, const Vec3& position, const Vec3& velocity) {
  GasSphere& s = sphere(id);
  for (int axis = 0; axis < 3; ++axis) {
    const double in_box = position[axis] - box_[axis] * std::floor(position[axis] / box_[axis]);
    const double width = cells_.width(axis);
    const int cell = std::clamp(static_cast<int>(in_box / width), 0, cells_.count(axis) - 1);
    calendar_[id].cell.at[axis] = static_cast<std::uint16_t>(cell);
    s.p[axis] = in_box - (cell + 0.5) * width;
    s.v[axis] = velocity[axis];
  }
  s.time = 0;
  s.meet = GasCalendar::kNever;
}

// Sorts the spheres in storage and sets the clock back to 0. Nothing else changes: differences of times that are close
// to each other are exact.
void HardSphereGas::Machine::tidy_up() {
  std::vector<std::pair<std::uint64_t, Id>> order;
  order.reserve(size());
  for (Id id = 1; id <= last(); ++id) order.emplace_back(space_order(calendar_[id].cell), id);
  std::sort(order.begin(), order.end());
  std::vector<Id> place_of(size() + 1, kNobody);
  Id next = 0;
  for (const auto& [key, old] : order) place_of[static_cast<std::size_t>(old)] = ++next;

  PagedVector<GasSphere> spheres(spheres_.size());
  PagedVector<GasCalendar::Event> events(spheres_.size());
  std::vector<std::size_t> number(spheres_.size());
  spheres[0] = spheres_[0];
  for (Id old = 1; old <= last(); ++old) {
    const auto i = static_cast<std::size_t>(place_of[static_cast<std::size_t>(old)]);
    number[i] = this->number(old);
    spheres[i] = sphere(old);
    spheres[i].time -= now_;
    spheres[i].meet -= now_;
    events[i] = calendar_[old];
    events[i].cross -= now_;
    events[i].partner = place_of[static_cast<std::size_t>(events[i].partner)];
  }
  spheres_.swap(spheres);
  number_.swap(number);
  calendar_.events().swap(events);
  epoch_ += now_;
  now_ = 0;
  events_since_tidy_ = 0;

  cells_.clear();
  calendar_.restart();
  for (Id id = 1; id <= last(); ++id) {
    cells_.insert(id, calendar_[id].cell);
    enter(id);
  }
}

HardSphereCollision HardSphereGas::Machine::collide_next() {
  if (at_rest_) throw std::runtime_error("spheres at rest never collide: give them velocities");
  const std::uint64_t most = statistics_.crossings + kCrossingsWithoutCollision + 1000 * size();
  for (;;) {
    const Id id = calendar_.first(), partner = calendar_[id].partner;
    now_ = calendar_[id].due;
    if (wake(id)) {
      const HardSphereCollision result{time(), std::min(number(id), number(partner)),
                                       std::max(number(id), number(partner))};
      if (events_since_tidy_ > kTidyInterval * size()) tidy_up();
      return result;
    }
    if (statistics_.crossings > most) {
      throw std::runtime_error("no collision in " + std::to_string(kCrossingsWithoutCollision) +
                               " crossings of cells: these spheres never meet");
    }
  }
}

void HardSphereGas::Machine::run_until(double t) {
  while (!at_rest_) {
    const Id id = calendar_.first();
    if (epoch_ + calendar_[id].due > t) break;
    now_ = calendar_[id].due;
    wake(id);
    if (events_since_tidy_ > kTidyInterval * size()) tidy_up();
  }
  now_ = t - epoch_;
}

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

// From a to b at this moment, the shortest way around the box.
Vec3 HardSphereGas::Machine::separation(Id a, Id b) const {
  GasSphere sa = sphere(a), sb = sphere(b);
  fly(sa);
  fly(sb);
  Vec3 r;
  for (int axis = 0; axis < 3; ++axis) {
    int cells = calendar_[b].cell.at[axis] - calendar_[a].cell.at[axis];
    if (2 * cells > cells_.count(axis)) cells -= cells_.count(axis);
    if (2 * cells < -cells_.count(axis)) cells += cells_.count(axis);
    r[axis] = sb.p[axis] + cells * cells_.width(axis) - sa.p[axis];
  }
  return r;
}

std::vector<Vec3> HardSphereGas::Machine::positions() const {
  std::vector<Vec3> result(size());
  for (Id id = 1; id <= last(); ++id) {
    GasSphere s = sphere(id);
    fly(s);
    for (int axis = 0; axis < 3; ++axis) {
      double p = s.p[axis] + (calendar_[id].cell.at[axis] + 0.5) * cells_.width(axis);
      // Between two events a sphere may stand a rounding outside of its cell, and so of the box.
      if (p < 0) p += box_[axis];
      if (p >= box_[axis]) p -= box_[axis];
      result[number(id)][axis] = p;
    }
  }
  return result;
}

std::vector<Vec3> HardSphereGas::Machine::velocities() const {
  std::vector<Vec3> result(size());
  for (Id id = 1; id <= last(); ++id) result[number(id)] = Vec3(sphere(id).v[0], sphere(id).v[1], sphere(id).v[2]);
  return result;
}

double HardSphereGas::Machine::velocity_square_sum() const {
  double sum = 0;
  for (const GasSphere& s : spheres_) sum += s.v[0] * s.v[0] + s.v[1] * s.v[1] + s.v[2] * s.v[2];
  return sum;
}

double HardSphereGas::Machine::smallest_gap() const {
  double smallest = std::numeric_limits<double>::infinity();
  GasCandidates near;
  for (Id a = 1; a <= last(); ++a) {
    const auto around = cells_.around(calendar_[a].cell);
    near.count = 0;
    for (int k = 0; k < kNeighbours; ++k) cells_.append(around, k, near);
    for (int k = 0; k < near.count; ++k) {
      if (near.id[k] != a) smallest = std::min(smallest, separation(a, near.id[k]).norm() / diameter_ - 1);
    }
  }
  return smallest;
}

}  // namespace plumbline
