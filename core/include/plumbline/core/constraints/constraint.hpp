// A constraint: something that positions of particles must satisfy, with a violation that can be measured and undone
// (course slides 32-36).
//
// A constraint measures one quantity q of a few particles, a coordinate, a distance, an angle, a height above an
// obstacle, and wants low <= q <= high. Its violation C is what q has too much (C > 0) or too little (C < 0); 0 where
// the constraint is met. Units of q and C: [m], for angles [rad].
//
// Minimal motion (slide 36): of all displacements d_i that make C zero the one with the smallest sum m_i |d_i|^2.
// Lagrange's condition for it, with w_i = 1/m_i the inverse masses and one multiplier lambda, is
//
//   d_i = -lambda w_i dq/dp_i(p + d),    C(p + d) = 0.
//
// So heavy particles move little and fixed ones (w = 0) not at all. Where q does not change when all particles are
// moved or turned together, sum dq/dp_i = 0 and sum p_i x dq/dp_i = 0: the motion then leaves the centre of mass
// where it is and has no net rotation, sum m_i p_i x d_i = 0.
//
// Sources: course slides 32-36; Lanczos, The Variational Principles of Mechanics, ch. II (multipliers);
// Mueller et al., Position Based Dynamics, J. Vis. Commun. Image R. 18 (2007) 109 (mass-weighted form of slide 34).
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

#include "plumbline/core/spatial.hpp"

namespace plumbline {

// One vector for each particle of a constraint, in its order; entries beyond its particles are zero.
inline constexpr std::size_t kMostParticles = 3;
using PerParticle = std::array<Vec3, kMostParticles>;

struct MinimalMotion {
  PerParticle d_W = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  // [m]
  double multiplier = 0;                                         // lambda [kg m], for angles [kg m^2/rad]
};

// Every function takes the positions p_W [m] and inverse masses [1/kg] of the constraint's own particles, in the order
// of particles(). NaN in, NaN out.
class Constraint {
 public:
  virtual ~Constraint() = default;

  // Which particles of the whole: at most kMostParticles, all different.
  std::span<const std::size_t> particles() const { return {particles_.data(), count_}; }

  virtual double quantity(std::span<const Vec3> p_W) const = 0;  // q
  double violation(std::span<const Vec3> p_W) const;             // C
  // dq/dp_i. Of length 1 for distances and heights, 1/length for angles; defined also where the constraint is met.
  virtual PerParticle gradient(std::span<const Vec3> p_W) const = 0;
  // As above. Nothing moves when the constraint is met or when all its particles are fixed. The general form seeks the
  // motion by Newton's method; constraints that know better say so.
  virtual MinimalMotion minimal_motion(std::span<const Vec3> p_W, std::span<const double> inverse_masses) const;

 protected:
  // Throws std::invalid_argument for a particle that is named twice, for none or too many, and unless low <= high.
  Constraint(std::initializer_list<std::size_t> particles, double low, double high);
  double low() const { return low_; }
  double high() const { return high_; }

 private:
  std::array<std::size_t, kMostParticles> particles_{};
  std::size_t count_ = 0;
  double low_, high_;
};

// The motion to the violated end of the range along other directions than the gradient at its end: d_i = -lambda w_i
// direction_i. SHAKE moves along the gradients of the step's start (verlet_relaxation.hpp). Newton's method for the one
// unknown lambda.
MinimalMotion motion_along(const Constraint& constraint, const PerParticle& direction, std::span<const Vec3> p_W,
                           std::span<const double> inverse_masses);

// Constraints never change once made, so that copies of a list may share them.
class ConstraintList {
 public:
  template <class SomeConstraint>
  void add(SomeConstraint constraint) {
    items_.push_back(std::make_shared<const SomeConstraint>(std::move(constraint)));
  }
  std::size_t size() const { return items_.size(); }
  const Constraint& operator[](std::size_t k) const { return *items_[k]; }

 private:
  std::vector<std::shared_ptr<const Constraint>> items_;
};

}  // namespace plumbline
