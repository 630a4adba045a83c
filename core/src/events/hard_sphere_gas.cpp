#include "plumbline/core/events/hard_sphere_gas.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "hard_sphere_gas_machine.hpp"

namespace plumbline {
namespace {

constexpr double kOverlapAllowed = 1e-9;  // of the diameter
constexpr double kFewestDiameters = 4;    // of an edge: see GasCells
constexpr double kMostCells = 1 << 28;    // of 4 bytes each

void check(std::span<const Vec3> positions, std::span<const Vec3> velocities, double diameter, const Vec3& box) {
  if (positions.size() != velocities.size()) {
    throw std::invalid_argument(std::to_string(positions.size()) + " positions and " +
                                std::to_string(velocities.size()) + " velocities: give one of each for every sphere");
  }
  if (!(diameter > 0) || !std::isfinite(diameter)) {
    throw std::invalid_argument("a diameter of " + std::to_string(diameter) + " m: it must be > 0");
  }
  if (!box.allFinite() || !(box.minCoeff() >= kFewestDiameters * diameter)) {
    throw std::invalid_argument(
        "an edge of the box is shorter than 4 diameters: take more spheres, or the event-driven simulator for few");
  }
  if (!((box / diameter).prod() < kMostCells) || !((box / diameter).maxCoeff() < 65535)) {
    throw std::invalid_argument("the box has more than 2^28 diameters cubed: too many empty cells; take a smaller one");
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (positions[i].allFinite() && velocities[i].allFinite()) continue;
    throw std::invalid_argument("sphere " + std::to_string(i) + " has a position or velocity that is not finite");
  }
}

}  // namespace

HardSphereGas::HardSphereGas(std::span<const Vec3> positions, std::span<const Vec3> velocities, double diameter,
                             const Vec3& box) {
  check(positions, velocities, diameter, box);
  machine_ = std::make_unique<Machine>(positions, velocities, diameter, box);
  if (!(machine_->smallest_gap() >= -kOverlapAllowed)) {
    throw std::invalid_argument("spheres overlap: move them apart, or take a smaller diameter");
  }
}
HardSphereGas::~HardSphereGas() = default;
HardSphereGas::HardSphereGas(HardSphereGas&&) noexcept = default;
HardSphereGas& HardSphereGas::operator=(HardSphereGas&&) noexcept = default;

HardSphereCollision HardSphereGas::collide_next() { return machine_->collide_next(); }
void HardSphereGas::run_events(std::uint64_t collisions) {
  for (std::uint64_t k = 0; k < collisions; ++k) machine_->collide_next();
}
void HardSphereGas::run_until(double t) {
  if (!(t >= time()) || !std::isfinite(t)) {
    throw std::invalid_argument("run until " + std::to_string(t) + " s from " + std::to_string(time()) +
                                " s: time only goes forward");
  }
  machine_->run_until(t);
}

double HardSphereGas::time() const { return machine_->time(); }
std::size_t HardSphereGas::size() const { return machine_->size(); }
const HardSphereStatistics& HardSphereGas::statistics() const { return machine_->statistics(); }
double HardSphereGas::compressibility() const {
  const double squares = velocity_square_sum(), t = time();
  return t > 0 && squares > 0 ? 1 + statistics().virial / (squares * t) : 1;
}
std::vector<Vec3> HardSphereGas::positions() const { return machine_->positions(); }
std::vector<Vec3> HardSphereGas::velocities() const { return machine_->velocities(); }
double HardSphereGas::velocity_square_sum() const { return machine_->velocity_square_sum(); }
double HardSphereGas::smallest_gap() const { return machine_->smallest_gap(); }

}  // namespace plumbline
