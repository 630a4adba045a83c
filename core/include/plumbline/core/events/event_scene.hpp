// What an event-driven simulation is about: balls, walls, gravity, and the rules for what has no exact answer.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "plumbline/core/collision/time_of_impact.hpp"
#include "plumbline/core/events/hard_sphere_state.hpp"

namespace plumbline {

// A smooth sphere: impulses pass through its centre, so it does not spin.
struct Ball {
  Vec3 p_WB = Vec3::Zero();  // centre [m]
  Vec3 v_WB = Vec3::Zero();  // [m/s]
  double radius = 0.5;       // > 0 [m]
  double mass = 1;           // > 0 [kg]; infinite for an obstacle that never moves (its velocity must be 0)
};

// Balls stay on the side of the plane to which its unit normal points.
struct Wall {
  Plane plane;
  double restitution = 1;  // Newton's e in [0, 1]: rebound speed over approach speed
};

// Gravity acts on every ball alike: two that fly have no acceleration relative to each other.
struct EventScene {
  std::vector<Ball> balls;
  std::vector<Wall> walls;
  Vec3 gravity_W = Vec3::Zero();  // [m/s^2]
  double restitution = 1;         // Newton's e in [0, 1] of ball against ball
  // Edges of a periodic box [0, x) x [0, y) x [0, z) [m]: who leaves on one side enters on the other. Each edge must be
  // more than 3.1 times the largest diameter; there can be no walls then.
  std::optional<Vec3> period;
};

// Six walls around the box between two corners [m], seen from inside.
std::vector<Wall> box_walls(const Vec3& low, const Vec3& high, double restitution = 1);

// The hard-sphere gas as a scene: mass 1, periodic, elastic.
EventScene hard_sphere_scene(const HardSphereState& state);

// Infinitely many impacts can happen in a finite time. These are the rules that end them; event_driven_simulator.hpp
// says what each is for and what it costs. Times in [s].
struct EventRules {
  // A ball that bounces on a wall under gravity, with all its remaining bounces done within this time and nobody in
  // the way, is no longer followed bounce by bounce: the sum of the geometric series says where it is and when it
  // stops. Exact, whatever the value; 0 follows every bounce.
  double train_time = 1e-3;
  // Two balls that meet again later than `cascade_time` and earlier than `collapse_time` after their last impact are
  // taken to be in lasting contact: for that long, their impacts (on anything) lose no energy. So does a ball with more
  // than `collapse_impacts` impacts on balls in a row, none later than collapse_time after the one before.
  double collapse_time = 1e-5;
  double cascade_time = 1e-9;
  int collapse_impacts = 50;
  // More impacts than this at one and the same time are an error (std::runtime_error).
  long max_impacts_at_once = 1'000'000;
};

}  // namespace plumbline
