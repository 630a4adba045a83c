#include "plumbline/core/kinetics/sphere_stepper.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace plumbline {
namespace {

// Spheres this fraction of their size apart touch, as in SimulatorOptions.
constexpr double kContactTolerance = 1e-10;

// Cells a sphere, at most. More and smaller ones leave fewer neighbours to look at, but have to be counted and summed.
constexpr double kCellsPerSphere = 4;

void check(const SphereBoxScene& scene) {
  if (!scene.lower_W.allFinite() || !scene.upper_W.allFinite() || !((scene.upper_W - scene.lower_W).minCoeff() > 0)) {
    throw std::invalid_argument("the box is empty: its upper corner must lie above the lower one along every axis");
  }
  if (!(scene.restitution >= 0 && scene.restitution <= 1)) {
    throw std::invalid_argument("a restitution of " + std::to_string(scene.restitution) + ": it must be in [0, 1]");
  }
  if (!scene.gravity.allFinite()) throw std::invalid_argument("gravity is not finite");
  for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
    const SteppedSphere& s = scene.spheres[i];
    const std::string name = "sphere " + std::to_string(i);
    if (!(s.radius > 0) || !std::isfinite(s.radius)) throw std::invalid_argument(name + " needs a radius > 0");
    if (!(s.mass > 0) || !std::isfinite(s.mass)) throw std::invalid_argument(name + " needs a mass > 0");
    if (!s.v_W.allFinite()) throw std::invalid_argument(name + " has a velocity that is not finite");
    if (!((s.p_W - scene.lower_W).minCoeff() >= 0) || !((scene.upper_W - s.p_W).minCoeff() >= 0)) {
      throw std::invalid_argument(name + " has its centre outside of the box");
    }
  }
}

}  // namespace

void SphereStepper::Columns::resize(std::size_t n) {
  for (auto* column : {&x, &y, &z, &vx, &vy, &vz, &radius, &inverse_mass}) column->resize(n);
}

SphereStepper::SphereStepper(const SphereBoxScene& scene)
    : lower_(scene.lower_W), upper_(scene.upper_W), gravity_(scene.gravity), restitution_(scene.restitution) {
  check(scene);
  const std::size_t n = scene.spheres.size();
  now_.resize(n);
  sorted_.resize(n);
  number_.resize(n);
  sorted_number_.resize(n);
  cell_.resize(n);
  double largest_radius = 0;
  for (const SteppedSphere& s : scene.spheres) largest_radius = std::max(largest_radius, s.radius);
  choose_grid(largest_radius);
  for (std::size_t i = 0; i < n; ++i) {
    const SteppedSphere& s = scene.spheres[i];
    now_.x[i] = s.p_W.x();
    now_.y[i] = s.p_W.y();
    now_.z[i] = s.p_W.z();
    now_.vx[i] = s.v_W.x();
    now_.vy[i] = s.v_W.y();
    now_.vz[i] = s.v_W.z();
    now_.radius[i] = s.radius;
    now_.inverse_mass[i] = 1 / s.mass;
    number_[i] = static_cast<std::uint32_t>(i);
    cell_[i] = static_cast<std::uint32_t>(cell_of(now_.x[i], now_.y[i], now_.z[i]));
    ++begin_[cell_[i]];
  }
}

// Cells at least as wide as the largest sphere, so that whoever touches it is in a neighbouring one, and not many
// more of them than there are spheres.
void SphereStepper::choose_grid(double largest_radius) {
  const Vec3 edges = upper_ - lower_;
  double width = 2 * largest_radius * (1 + 2 * kContactTolerance);
  const double most = kCellsPerSphere * static_cast<double>(std::max<std::size_t>(number_.size(), 1));
  const auto count = [&](int axis) { return std::max(1.0, std::floor(edges[axis] / width)); };
  if (width == 0) width = edges.maxCoeff();
  while (count(0) * count(1) * count(2) > most) width *= 1.02;
  std::size_t cells = 1;
  for (int axis = 0; axis < 3; ++axis) {
    cells_[axis] = static_cast<int>(count(axis));
    per_length_[axis] = count(axis) / edges[axis];
    cells *= static_cast<std::size_t>(cells_[axis]);
  }
  begin_.assign(cells + 1, 0);
}

// Spheres that have sunk into a wall may have their centre outside: they belong to the cell at the wall.
std::size_t SphereStepper::cell_of(double x, double y, double z) const {
  const auto along = [&](double p, int axis) {
    const double c = (p - lower_[axis]) * per_length_[axis];
    const double last = cells_[axis] - 1;
    return static_cast<int>(c > 0 ? (c < last ? c : last) : 0.0);
  };
  return static_cast<std::size_t>(along(x, 0) + cells_[0] * (along(y, 1) + cells_[1] * along(z, 2)));
}

void SphereStepper::step(double dt) {
  if (!(dt > 0) || !std::isfinite(dt)) {
    throw std::invalid_argument("a step of " + std::to_string(dt) + " s: it must be > 0");
  }
  sort_and_kick(dt);
  meet_neighbours();
  meet_walls_and_move(dt);
}

// Counting sort. begin_ holds how many spheres each cell has; the sum up to a cell is where its last one ends, and
// going backwards each sphere takes the place before. What is moved gets its share of gravity on the way.
void SphereStepper::sort_and_kick(double dt) {
  std::uint32_t sum = 0;
  for (std::uint32_t& begin : begin_) begin = sum += begin;
  const Vec3 kick = gravity_ * dt;
  for (std::size_t i = size(); i-- > 0;) {
    const std::size_t to = --begin_[cell_[i]];
    sorted_.x[to] = now_.x[i];
    sorted_.y[to] = now_.y[i];
    sorted_.z[to] = now_.z[i];
    sorted_.vx[to] = now_.vx[i] + kick.x();
    sorted_.vy[to] = now_.vy[i] + kick.y();
    sorted_.vz[to] = now_.vz[i] + kick.z();
    sorted_.radius[to] = now_.radius[i];
    sorted_.inverse_mass[to] = now_.inverse_mass[i];
    sorted_number_[to] = number_[i];
  }
  std::swap(now_, sorted_);
  number_.swap(sorted_number_);
}

// Each pair of neighbouring cells once: a cell looks at itself and at those that come later in the order of cells. The
// three cells of a row lie behind each other in memory, so its spheres are one range: there are five ranges, not 14.
void SphereStepper::meet_neighbours() {
  const int nx = cells_[0], ny = cells_[1], nz = cells_[2];
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        const int cell = x + nx * (y + ny * z);
        const std::size_t first = begin_[static_cast<std::size_t>(cell)];
        const std::size_t last = begin_[static_cast<std::size_t>(cell) + 1];
        if (first == last) continue;
        const int left = x > 0 ? -1 : 0, right = x + 1 < nx ? 1 : 0;
        std::size_t from[5], to[5];
        int ranges = 0;
        for (const auto& [dy, dz] : {std::pair{1, 0}, {-1, 1}, {0, 1}, {1, 1}}) {
          if (y + dy < 0 || y + dy >= ny || z + dz >= nz) continue;
          const int row = cell + nx * (dy + ny * dz);
          from[ranges] = begin_[static_cast<std::size_t>(row + left)];
          to[ranges] = begin_[static_cast<std::size_t>(row + right + 1)];
          ranges += from[ranges] < to[ranges];
        }
        const std::size_t row_end = begin_[static_cast<std::size_t>(cell + right + 1)];
        for (std::size_t i = first; i < last; ++i) {
          meet(i, i + 1, row_end);
          for (int k = 0; k < ranges; ++k) meet(i, from[k], to[k]);
        }
      }
    }
  }
}

// Sphere i against a range of others.
inline void SphereStepper::meet(std::size_t i, std::size_t first, std::size_t last) {
  Columns& s = now_;
  const double x = s.x[i], y = s.y[i], z = s.z[i], radius = s.radius[i];
  for (std::size_t j = first; j < last; ++j) {
    const double dx = x - s.x[j], dy = y - s.y[j], dz = z - s.z[j];
    const double square = dx * dx + dy * dy + dz * dz;
    const double reach = (radius + s.radius[j]) * (1 + kContactTolerance);
    if (!(square <= reach * reach)) [[likely]]
      continue;
    // With d not made a unit vector, d.v and the impulse per d carry the |d| that is missing: no square root.
    const double along = dx * (s.vx[i] - s.vx[j]) + dy * (s.vy[i] - s.vy[j]) + dz * (s.vz[i] - s.vz[j]);
    if (!(along < 0)) continue;  // they part; or they have the same centre, and no direction to part along
    const double wi = s.inverse_mass[i], wj = s.inverse_mass[j];
    const double push = -(1 + restitution_) * along / (square * (wi + wj));
    s.vx[i] += push * wi * dx;
    s.vy[i] += push * wi * dy;
    s.vz[i] += push * wi * dz;
    s.vx[j] -= push * wj * dx;
    s.vy[j] -= push * wj * dy;
    s.vz[j] -= push * wj * dz;
    ++impacts_;
  }
}

// The walls, the motion, and already the count for the next sorting.
void SphereStepper::meet_walls_and_move(double dt) {
  std::fill(begin_.begin(), begin_.end(), 0u);
  std::vector<double>* const place[3] = {&now_.x, &now_.y, &now_.z};
  std::vector<double>* const velocity[3] = {&now_.vx, &now_.vy, &now_.vz};
  for (std::size_t i = 0; i < size(); ++i) {
    const double near = now_.radius[i] * (1 + 2 * kContactTolerance);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double &p = (*place[axis])[i], &v = (*velocity[axis])[i];
      const auto wall = static_cast<Eigen::Index>(axis);
      if ((p - near <= lower_[wall] && v < 0) || (p + near >= upper_[wall] && v > 0)) {
        const double resting = 2 * std::abs(gravity_[wall]) * dt;
        v *= std::abs(v) <= resting ? 0.0 : -restitution_;
        ++impacts_;
      }
      p += v * dt;
    }
    cell_[i] = static_cast<std::uint32_t>(cell_of(now_.x[i], now_.y[i], now_.z[i]));
    ++begin_[cell_[i]];
  }
}

double SphereStepper::kinetic_energy() const {
  double twice = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const double square = now_.vx[i] * now_.vx[i] + now_.vy[i] * now_.vy[i] + now_.vz[i] * now_.vz[i];
    twice += square / now_.inverse_mass[i];
  }
  return twice / 2;
}

std::vector<SteppedSphere> SphereStepper::spheres() const {
  std::vector<SteppedSphere> result(size());
  for (std::size_t i = 0; i < size(); ++i) {
    result[number_[i]] = {Vec3(now_.x[i], now_.y[i], now_.z[i]), Vec3(now_.vx[i], now_.vy[i], now_.vz[i]),
                          now_.radius[i], 1 / now_.inverse_mass[i]};
  }
  return result;
}

}  // namespace plumbline
