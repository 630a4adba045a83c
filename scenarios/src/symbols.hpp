// The names that expressions may read besides parameters, one list a context. docs/writing_a_scenario.md shows them.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "plumbline/core/state.hpp"

namespace plumbline {

// Forces: time and the state of the body that the force acts on, in this order.
inline constexpr std::array<std::string_view, 14> kForceSymbols = {"t",  "x",  "y",  "z",  "qw", "qx", "qy",
                                                                   "qz", "vx", "vy", "vz", "wx", "wy", "wz"};
// What a reference states of a body: the same without the time.
inline constexpr std::size_t kComponentCount = 13;
inline constexpr std::string_view component_name(std::size_t i) { return kForceSymbols[i + 1]; }

// Drives of joints: time, the joint's coordinate and its rate.
inline constexpr std::array<std::string_view, 3> kDriveSymbols = {"t", "q", "dq"};

// Limits of gates.
inline constexpr std::array<std::string_view, 3> kGateSymbols = {"dt", "steps", "unit_roundoff"};
inline constexpr std::array<std::string_view, 7> kGateConstants = {
    "duration", "length_scale", "time_scale", "mass_scale", "velocity_scale", "energy_scale", "momentum_scale"};

// Whether a parameter must not have that name: a symbol of any context, a function, or pi.
bool is_reserved(std::string_view name);

// A state as 13 numbers in the order of component_name, and back (the attitude is normalised).
std::array<double, kComponentCount> components_of(const BodyState& state);
BodyState state_of(const std::array<double, kComponentCount>& components);

}  // namespace plumbline
