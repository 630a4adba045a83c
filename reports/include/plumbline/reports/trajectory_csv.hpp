// A recorded motion as a table, for people and plotting programs.
//
// Header `t,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz`, then a row per sample and body, in that order: time [s], name
// of the body, position of the centre of mass [m], attitude, velocity [m/s] and angular velocity [rad/s] in the
// world frame. Numbers are the shortest decimals that read back as the same double; `nan`, `inf` and `-inf` are
// spelled so. A name with a comma, a quote or a line break is quoted as in RFC 4180.
#pragma once

#include <filesystem>

#include "plumbline/core/scenario.hpp"
#include "plumbline/core/trajectory.hpp"

namespace plumbline {

// Makes missing folders. Throws std::runtime_error that names the file when it cannot be written in full, and
// std::invalid_argument when the trajectory does not have the bodies of the scenario.
void write_trajectory(const Trajectory& trajectory, const Scenario& scenario, const std::filesystem::path& path);

}  // namespace plumbline
