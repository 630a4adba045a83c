// Kepler's ellipse: a particle pulled to the origin by GM/r^2, exact at every time.
//
//   r'' = -GM r/|r|^3
//
// Derivation (Bate, Mueller and White, Fundamentals of Astrodynamics, chapter 4; Battin, Mathematics and Methods of
// Astrodynamics, section 4.3). With the semi-major axis a = 1/(2/r0 - v0^2/GM), the mean motion n = sqrt(GM/a^3) and x
// the eccentric anomaly passed since the start, Kepler's equation between two times reads
//
//   n t = x - (1 - r0/a) sin x + (r0.v0/sqrt(GM a)) (1 - cos x)
//
// and place and velocity are combinations of those at the start (Lagrange's f and g). No orbital element appears, so
// circles and every inclination are as good as the rest. The time is first reduced by whole periods.
//
// Kept by the motion: energy v^2/2 - GM/r, angular momentum r x v, and the Laplace-Runge-Lenz vector
// (v x (r x v))/GM - r/|r|, which points to the nearest place and has the length e.
#pragma once

#include "plumbline/core/spatial.hpp"

namespace plumbline {

struct OrbitState {
  Vec3 position = Vec3::Zero();  // from the centre [m]
  Vec3 velocity = Vec3::Zero();  // [m/s]
};

class KeplerOrbit {
 public:
  // `strength`: GM > 0 [m^3/s^2]; place and velocity at t = 0. Throws std::invalid_argument unless they give an
  // ellipse: bound (v0^2 < 2 GM/r0) and not straight through the centre.
  KeplerOrbit(double strength, const Vec3& position, const Vec3& velocity);

  // At time t [s], t < 0 included. The error is a few 1e-16 (1 + n |t|) a, stretched by up to 1/(1 - e)^2 at the
  // nearest place, where the particle is fastest.
  OrbitState at(double t) const;

  double semi_major_axis() const { return a_; }          // [m]
  double eccentricity() const { return eccentricity_; }  // in [0, 1)
  double mean_motion() const { return n_; }              // [rad/s]
  double period() const;                                 // [s]

 private:
  double anomaly_passed(double t) const;

  double strength_;
  Vec3 p0_, v0_;
  double r0_ = 0, a_ = 0, n_ = 0, eccentricity_ = 0;
  double cosine_ = 0, sine_ = 0;  // e cos and e sin of the eccentric anomaly at the start
};

}  // namespace plumbline
