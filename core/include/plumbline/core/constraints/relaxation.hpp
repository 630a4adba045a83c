// Iterated local relaxation (course slide 36): go through the list of constraints, undo each violation by its minimal
// motion, and repeat, since undoing one may bring up another.
//
// How fast it converges. For a straight chain of N links of equal particles let c_k be what link k is too long. Undoing
// link k by its multiplier c_k/(w_k + w_k+1) makes its neighbours longer by half of c_k, so that relaxation is
// Gauss-Seidel (or Jacobi) on A lambda = c, A = G W G^T, tridiagonal: -w beside the diagonal, on it 2 w, or w for a
// link with a fixed end. D^-1 A, D its diagonal, is a random walk along the links, reflected at fixed ends and lost at
// free ones: Jacobi's sweep has the eigenvectors cos(k theta) with eigenvalues cos(theta), Gauss-Seidel's has their
// squares (Young, Iterative Solution of Large Linear Systems, 1971, ch. 5):
//
//   both ends fixed   theta = pi j/(N - 1):        residual falls by cos^2(pi/(N - 1)) a sweep
//   one end fixed     theta = pi (2j - 1)/(2N):    by cos^2(pi/(2N))
//
// about 1 - (pi/N)^2 and 1 - (pi/2N)^2: the number of sweeps for a digit grows with the square of the chain's length.
// With both ends fixed j = 0 stays for ever: all links pull alike, since only the distance of the ends can help them
// (no guarantees, says the slide). The largest j makes plain Jacobi swap signs for ever (cos pi = -1); with factor 1/2
// its slowest mode falls by cos^2(pi/(2N - 2)). Over-relaxation by omega = 2/(1 + sin theta), theta of j = 1, makes
// Gauss-Seidel fall by omega - 1 ~ 1 - 2 theta.
#pragma once

#include "plumbline/core/constraints/constraint.hpp"

namespace plumbline {

enum class SweepOrder {
  kGaussSeidel,  // each constraint sees the motions of those before it: the slide's
  kJacobi,       // all motions are computed first, then all are made: the order of the list does not matter
};

struct RelaxationOptions {
  int sweeps = 10;  // at most
  // Stop once no violation exceeds it [m or rad]. Below the rounding of positions, some 1e-15 of their size, no sweep
  // gets, and each goes on to add its roundings to the multipliers.
  double tolerance = 0;
  SweepOrder order = SweepOrder::kGaussSeidel;
  double factor = 1;  // of each minimal motion, in (0, 2); above 1 only for constraints that always hold (links)
};

struct RelaxationReport {
  // Largest |violation| of the list [m or rad] before the first sweep and after each.
  std::vector<double> residuals;
  // Sum of the multipliers of each constraint (constraint.hpp), in the order of the list.
  std::vector<double> multipliers;
  bool within_tolerance = false;
  int sweeps() const { return static_cast<int>(residuals.size()) - 1; }
};

// Moves the particles. If `start_W` is given, one position per particle, every constraint moves them along its gradient
// at those positions instead of by its minimal motion, if that can undo it (see verlet_relaxation.hpp).
// Throws std::invalid_argument when the numbers of positions and masses differ, a constraint names a particle that is
// not there, an inverse mass is negative or the options are outside their ranges. NaN in any position is NaN in the
// residuals.
RelaxationReport relax(const ConstraintList& constraints, std::span<const double> inverse_masses, std::span<Vec3> p_W,
                       const RelaxationOptions& options = {}, std::span<const Vec3> start_W = {});

// Largest |violation| of the list [m or rad].
double largest_violation(const ConstraintList& constraints, std::span<const Vec3> p_W);

}  // namespace plumbline
