// The gas against statistical mechanics: pressure and mean free time, with their statistical error.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "hard_sphere_scene.hpp"

namespace plumbline {
namespace {

// Mean of a quantity over blocks of a run, and the standard error of the mean.
struct Estimate {
  double mean, error;
};
Estimate estimate(const std::vector<double>& blocks) {
  double sum = 0, squares = 0;
  const double n = static_cast<double>(blocks.size());
  for (const double b : blocks) sum += b;
  for (const double b : blocks) squares += (b - sum / n) * (b - sum / n);
  return {sum / n, std::sqrt(squares / (n - 1) / n)};
}

struct GasAverages {
  Estimate compressibility;  // p V / (N kT)
  Estimate rate;             // collisions a sphere and unit of time, at kT/m = 1 and diameter 1
  double spheres;
};

// Blocks of 30 collisions a sphere: some ten times longer than the gas remembers.
GasAverages averages(int cells, double density, int blocks) {
  const gas::Scene scene = gas::lattice_gas(cells, cells, cells, density, 11);
  HardSphereGas run(scene.positions, scene.velocities, scene.diameter, scene.box);
  const std::uint64_t n = run.size(), collisions = 15 * n;
  run.run_events(2 * collisions);  // forget the lattice
  const double squares = run.velocity_square_sum();
  std::vector<double> z, rate;
  for (int k = 0; k < blocks; ++k) {
    const double t0 = run.time(), virial0 = run.statistics().virial;
    run.run_events(collisions);
    const double t = run.time() - t0;
    z.push_back(1 + (run.statistics().virial - virial0) / (squares * t));
    rate.push_back(2.0 * static_cast<double>(collisions) / (static_cast<double>(n) * t));
  }
  return {estimate(z), estimate(rate), static_cast<double>(n)};
}

// Carnahan and Starling, J. Chem. Phys. 51 (1969) 635, and Kolafa's refinement of it (Boublik and Nezbeda, Coll. Czech.
// Chem. Commun. 51 (1986) 2301), good to about 1e-4 of Z - 1 in the fluid. y: packing fraction.
double carnahan_starling(double y) { return (1 + y + y * y - y * y * y) / std::pow(1 - y, 3); }
double kolafa(double y) { return (1 + y + y * y - 2.0 / 3 * y * y * y * (1 + y)) / std::pow(1 - y, 3); }

// At density 0.5 the two are 3.2624 and 3.2695. A gas of N spheres without total momentum deviates by some Z/N. Three
// and a half standard errors are exceeded once in 2000.
TEST(HardSphereGasStatistics, PressureIsThatOfTheEquationOfState) {
  for (const double density : {0.2, 0.5, 0.8}) {
    const GasAverages gas = averages(6, density, 30);
    const double y = std::numbers::pi / 6 * density, z = gas.compressibility.mean;
    const double finite = 2 * z / gas.spheres;
    RecordProperty("z_at_" + std::to_string(density), std::to_string(z));
    RecordProperty("error_at_" + std::to_string(density), std::to_string(gas.compressibility.error));
    EXPECT_NEAR(z, kolafa(y), 3.5 * gas.compressibility.error + finite + 1e-3 * (z - 1)) << "density " << density;
    EXPECT_NEAR(z, carnahan_starling(y), 3.5 * gas.compressibility.error + finite + 5e-3 * (z - 1));
    EXPECT_LT(gas.compressibility.error, 0.01 * z);
  }
}

// Both are integrals over pairs in contact, so their ratio is free of any equation of state: with Maxwell's velocities
// collisions a sphere and time = (6/sqrt(pi)) (Z - 1) sqrt(kT/m)/d (Lue, J. Chem. Phys. 122 (2005) 044513, from
// Enskog's rate 4 sqrt(pi) n d^2 g and Z - 1 = (2 pi/3) n d^3 g). The mean free time is its inverse.
TEST(HardSphereGasStatistics, MeanFreeTimeBelongsToThePressure) {
  for (const double density : {0.2, 0.5, 0.8}) {
    const GasAverages gas = averages(6, density, 30);
    const double expected = 6 / std::sqrt(std::numbers::pi) * (gas.compressibility.mean - 1);
    const double error =
        std::hypot(gas.rate.error, expected / (gas.compressibility.mean - 1) * gas.compressibility.error);
    RecordProperty("rate_at_" + std::to_string(density), std::to_string(gas.rate.mean));
    EXPECT_NEAR(gas.rate.mean, expected, 3.5 * error + 2 * expected / gas.spheres) << "density " << density;
  }
}

// The same run from another start: the lattice is forgotten, and velocities became Maxwell's. Fourth moment of a
// component over the square of its second: 3; here from N = 1372 spheres at 40 times, correlated little.
TEST(HardSphereGasStatistics, VelocitiesBecomeMaxwells) {
  gas::Scene scene = gas::lattice_gas(7, 7, 7, 0.5, 12);
  gas::Normal random(13);
  for (Vec3& v : scene.velocities) {  // all of one speed: fourth moment 9/5
    v = Vec3(random(), random(), random()).normalized();
  }
  HardSphereGas run(scene.positions, scene.velocities, scene.diameter, scene.box);
  const auto kurtosis = [&] {
    double second = 0, fourth = 0;
    for (const Vec3& v : run.velocities()) {
      second += v.squaredNorm() / 3;
      fourth += v.array().pow(4).sum() / 3;
    }
    const double n = static_cast<double>(run.size());
    return fourth / n / std::pow(second / n, 2);
  };
  EXPECT_NEAR(kurtosis(), 1.8, 0.1);
  run.run_events(20 * run.size());
  std::vector<double> samples;
  for (int k = 0; k < 40; ++k) {
    run.run_events(4 * run.size());
    samples.push_back(kurtosis());
  }
  const Estimate mean = estimate(samples);
  // A closed gas: 3 (1 - 2/(3N + 2)), since its energy is fixed.
  EXPECT_NEAR(mean.mean, 3, 3.5 * mean.error + 6.0 / (3 * 1372));
  EXPECT_LT(mean.error, 0.05);
}

}  // namespace
}  // namespace plumbline
