// What the motion itself makes of errors in the initial state, and how long it can be compared point by point.
//
// Copies of the scenario start a small distance away, in independent directions that the joints allow: places and
// velocities are projected back onto them. As long as the distances stay small they are linear in the initial ones, so
// that the copies tell what becomes of every combination of their directions. With D(t) the matrix of all distances,
// one column a copy,
//
//   growth(t) = max over c of |D(t) c| / |D(0) c|
//
// places counting over the length scale, velocities over the velocity scale, attitudes as angles, angular velocities
// times the time scale. All directions are taken where there are few, else twelve of them, chosen once and for all.
#pragma once

#include <span>
#include <vector>

#include "plumbline/core/scenario.hpp"

namespace plumbline {

// An initial rounding of single precision, 6e-8 of the length, is by then worth a hundredth of it.
inline constexpr double kGrowthOfValidity = 1e5;

// growth at those times [s], which must not fall. Smooth scenarios by integration; ones with contact by the
// event-driven simulator, as far as it can (event_reference.hpp). Beyond 1e7 the distances are no longer small, and it
// only tells that much. Throws std::invalid_argument for a scenario that neither solves.
std::vector<double> error_growth(const Scenario& scenario, std::span<const double> times);

// The first time [s] at which growth exceeds kGrowthOfValidity, to a thousandth of the duration, or the duration: what
// a scenario file states as `t_valid`. Does not look at what the scenario states.
double time_of_validity(const Scenario& scenario);

}  // namespace plumbline
