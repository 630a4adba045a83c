// A motion in formats that other programs read. Each function throws std::runtime_error, naming the file, when it
// cannot be written in full.
#pragma once

#include "plumbline/exchange/motion.hpp"

namespace plumbline {

// The table that runs write, too: shortest decimals that read back as the same double.
void write_csv(const Motion& motion, const std::filesystem::path& file);

// numpy's archive: t (N), names (B), position (N, B, 3), attitude (N, B, 4; w x y z), velocity and angular_velocity
// (N, B, 3), all float64, as in the motion. Not compressed.
void write_npz(const Motion& motion, const std::filesystem::path& file);

// "t x y z qx qy qz qw" a line, as programs that compare trajectories of cameras read; velocities have no place in it.
// One file a body: `file` itself for a single body, else name.BODY.ext. Returns what was written.
std::vector<std::filesystem::path> write_tum(const Motion& motion, const std::filesystem::path& file);

// A C++17 header that needs nothing but itself: the samples as constexpr hexadecimal floats, bit for bit.
void write_cpp_header(const Motion& motion, const std::filesystem::path& file);

}  // namespace plumbline
