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
std::uint64_t space_order(const std::uint16_t cell[3]) {
  std::uint64_t key = 0;
  for (int bit = 0; bit < 16; ++bit) {
    for (int axis = 0; axis < 3; ++axis) {
      key |= static_cast<std::uint64_t>(cell[axis] >> bit & 1) << (3 * bit + axis);
    }
  }
  return key;
}

}  // namespace

HardSphereGas::Machine::Machine(std::span<const Vec3> positions, std::span<const Vec3> velocities, double diameter,
                                const Vec3& box)
    : diameter_(diameter),
      box_(box),
      cells_(box.data(), diameter),
      spheres_(positions.size()),
      number_(positions.size()),
      calendar_(positions.size(), expected_rate(velocities, diameter, box)),
      at_rest_(mean_square(velocities) == 0) {
  std::iota(number_.begin(), number_.end(), std::size_t{0});
  for (std::size_t i = 0; i < positions.size(); ++i) place(static_cast<Id>(i), positions[i], velocities[i]);
  for (Id id = 0; id < static_cast<Id>(size()); ++id) find_crossing(id);
  tidy_up();
  for (Id id = 0; id < static_cast<Id>(size()); ++id) search(id);
}

void HardSphereGas::Machine::place(Id id, const Vec3& position, const Vec3& velocity) {
  GasSphere& sphere = spheres_[static_cast<std::size_t>(id)];
  for (int axis = 0; axis < 3; ++axis) {
    const double in_box = position[axis] - box_[axis] * std::floor(position[axis] / box_[axis]);
    const double width = cells_.width(axis);
    const int cell = std::clamp(static_cast<int>(in_box / width), 0, cells_.count(axis) - 1);
    sphere.cell[axis] = static_cast<std::uint16_t>(cell);
    sphere.p[axis] = in_box - (cell + 0.5) * width;
    sphere.v[axis] = velocity[axis];
  }
  sphere.time = 0;
}

// Sorts the spheres in storage and sets the clock back to 0. Nothing else changes: differences of times that are close
// to each other are exact.
void HardSphereGas::Machine::tidy_up() {
  const std::size_t n = size();
  std::vector<std::pair<std::uint64_t, std::size_t>> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = {space_order(spheres_[i].cell), i};
  std::sort(order.begin(), order.end());
  std::vector<Id> place_of(n);
  for (std::size_t i = 0; i < n; ++i) place_of[order[i].second] = static_cast<Id>(i);

  PagedVector<GasSphere> spheres(n);
  PagedVector<GasCalendar::Event> events(n);
  std::vector<std::size_t> number(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t old = order[i].second;
    spheres[i] = spheres_[old];
    spheres[i].time -= now_;
    number[i] = number_[old];
    GasCalendar::Event& event = events[i] = calendar_.events()[old];
    event.meet -= now_;
    event.cross -= now_;
    if (event.partner != kNobody) event.partner = place_of[static_cast<std::size_t>(event.partner)];
  }
  spheres_.swap(spheres);
  number_.swap(number);
  calendar_.events().swap(events);
  epoch_ += now_;
  now_ = 0;
  events_since_tidy_ = 0;

  cells_.clear();
  calendar_.restart();
  for (Id id = 0; id < static_cast<Id>(n); ++id) {
    if (!cells_.insert(id, spheres_[static_cast<std::size_t>(id)])) {
      throw std::invalid_argument("more than 8 spheres in one cell: they overlap; move them apart");
    }
    calendar_.insert(id);
  }
}

HardSphereCollision HardSphereGas::Machine::collide_next() {
  if (at_rest_) throw std::runtime_error("spheres at rest never collide: give them velocities");
  const std::uint64_t most = statistics_.crossings + kCrossingsWithoutCollision + 1000 * size();
  for (;;) {
    const Id id = calendar_.first();
    now_ = calendar_[id].due;
    const Id partner = calendar_[id].partner;
    if (wake(id)) {
      const auto a = number_[static_cast<std::size_t>(id)], b = number_[static_cast<std::size_t>(partner)];
      const HardSphereCollision result{time(), std::min(a, b), std::max(a, b)};
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
  if (event.cross < event.meet) {
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
  GasSphere &sa = spheres_[static_cast<std::size_t>(a)], &sb = spheres_[static_cast<std::size_t>(b)];
  fly(sa);
  fly(sb);
  const Vec3 r = separation(sa, sb);
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
  GasSphere& sphere = spheres_[static_cast<std::size_t>(id)];
  const int axis = calendar_[id].leaves_by;
  const bool up = sphere.v[axis] > 0;
  calendar_.remove(id);
  fly(sphere);
  cells_.remove(sphere, spheres_.data());
  const int last = cells_.count(axis) - 1, from = sphere.cell[axis];
  sphere.cell[axis] = static_cast<std::uint16_t>(up ? (from == last ? 0 : from + 1) : (from == 0 ? last : from - 1));
  sphere.p[axis] += up ? -cells_.width(axis) : cells_.width(axis);
  if (!cells_.insert(id, sphere)) throw std::logic_error("more than 8 spheres in one cell of a hard-sphere gas");
  find_crossing(id);

  const auto around = cells_.around(sphere.cell);
  static constexpr int kStride[3] = {1, 3, 9};
  const int stride = kStride[axis];
  near_.count = 0;
  for (int k = 0; k < kNeighbours; ++k) {
    if (k / stride % 3 == (up ? 2 : 0)) near_.append(cells_[around[static_cast<std::size_t>(k)]], k);
  }
  engage_best(id);
  calendar_.insert(id);
}

// Whom does it meet first? Asked when its flight has changed or its partner is gone.
void HardSphereGas::Machine::search(Id id) {
  ++statistics_.predictions;
  GasSphere& sphere = spheres_[static_cast<std::size_t>(id)];
  calendar_.remove(id);
  calendar_[id].meet = GasCalendar::kNever;
  fly(sphere);
  const auto around = cells_.around(sphere.cell);
  near_.count = 0;
  for (int k = 0; k < kNeighbours; ++k) near_.append(cells_[around[static_cast<std::size_t>(k)]], k);
  engage_best(id);
  calendar_.insert(id);
}

void HardSphereGas::Machine::engage_best(Id id) {
  find_meeting_times_(spheres_[static_cast<std::size_t>(id)], now_, diameter_ * diameter_, spheres_.data(),
                      cells_.shifts(), near_);
  Id partner = kNobody;
  double meet = calendar_[id].meet;
  for (int k = 0; k < near_.count; ++k) {
    if (near_.time[k] < meet && near_.time[k] < calendar_[near_.id[k]].meet) {
      meet = near_.time[k];
      partner = near_.id[k];
    }
  }
  if (partner == kNobody) return;
  leave_partner(id);
  leave_partner(partner);
  calendar_.remove(partner);
  calendar_[id].meet = calendar_[partner].meet = meet;
  calendar_[id].partner = partner;
  calendar_[partner].partner = id;
  calendar_.insert(partner);
}

// The one who is left looks for another at the time of the collision that is lost.
void HardSphereGas::Machine::leave_partner(Id id) {
  const Id left = calendar_[id].partner;
  if (left != kNobody) calendar_[left].partner = kNobody;
}

void HardSphereGas::Machine::fly(GasSphere& sphere) const {
  const double duration = now_ - sphere.time;
  for (int axis = 0; axis < 3; ++axis) sphere.p[axis] += sphere.v[axis] * duration;
  sphere.time = now_;
}

// From its place now: when, and through which side, it leaves its cell. Without a jump on the sign of the velocity,
// which is as good as random. Where v is 0 the quotient is infinite or, on the side itself, NaN, which is never less.
void HardSphereGas::Machine::find_crossing(Id id) {
  const GasSphere& sphere = spheres_[static_cast<std::size_t>(id)];
  double wait = GasCalendar::kNever;
  std::int32_t leaves_by = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double v = sphere.v[axis];
    const double way = 0.5 * cells_.width(axis) - std::copysign(1.0, v) * sphere.p[axis];
    const double until = way / std::abs(v);
    leaves_by = until < wait ? axis : leaves_by;
    wait = until < wait ? until : wait;
  }
  GasCalendar::Event& event = calendar_[id];
  event.cross = now_ + (wait < 0 ? 0.0 : wait);
  event.leaves_by = leaves_by;
}

// From a to b, at `now` of both clocks, the shortest way around the box.
Vec3 HardSphereGas::Machine::separation(const GasSphere& a, const GasSphere& b) const {
  Vec3 r;
  for (int axis = 0; axis < 3; ++axis) {
    int cells = b.cell[axis] - a.cell[axis];
    if (2 * cells > cells_.count(axis)) cells -= cells_.count(axis);
    if (2 * cells < -cells_.count(axis)) cells += cells_.count(axis);
    r[axis] = b.p[axis] + cells * cells_.width(axis) - a.p[axis];
  }
  return r;
}

std::vector<Vec3> HardSphereGas::Machine::positions() const {
  std::vector<Vec3> result(size());
  for (std::size_t i = 0; i < size(); ++i) {
    GasSphere sphere = spheres_[i];
    fly(sphere);
    for (int axis = 0; axis < 3; ++axis) {
      double p = sphere.p[axis] + (sphere.cell[axis] + 0.5) * cells_.width(axis);
      // Between two events a sphere may stand a rounding outside of its cell, and so of the box.
      if (p < 0) p += box_[axis];
      if (p >= box_[axis]) p -= box_[axis];
      result[number_[i]][axis] = p;
    }
  }
  return result;
}

std::vector<Vec3> HardSphereGas::Machine::velocities() const {
  std::vector<Vec3> result(size());
  for (std::size_t i = 0; i < size(); ++i)
    result[number_[i]] = Vec3(spheres_[i].v[0], spheres_[i].v[1], spheres_[i].v[2]);
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
  for (std::size_t i = 0; i < size(); ++i) {
    GasSphere a = spheres_[i];
    fly(a);
    const auto around = cells_.around(a.cell);
    near.count = 0;
    for (int k = 0; k < kNeighbours; ++k) near.append(cells_[around[static_cast<std::size_t>(k)]], k);
    for (int k = 0; k < near.count; ++k) {
      const auto j = static_cast<std::size_t>(near.id[k]);
      if (j == i) continue;
      GasSphere b = spheres_[j];
      fly(b);
      smallest = std::min(smallest, separation(a, b).norm() / diameter_ - 1);
    }
  }
  return smallest;
}

}  // namespace plumbline
