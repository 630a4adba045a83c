#include "hard_sphere_gas_machine.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

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

}  // namespace plumbline
