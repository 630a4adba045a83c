#include "plumbline/core/events/event_scene.hpp"

namespace plumbline {

std::vector<Wall> box_walls(const Vec3& low, const Vec3& high, double restitution) {
  std::vector<Wall> walls;
  for (int axis = 0; axis < 3; ++axis) {
    walls.push_back({{Vec3::Unit(axis), low[axis]}, restitution});
    walls.push_back({{-Vec3::Unit(axis), -high[axis]}, restitution});
  }
  return walls;
}

EventScene hard_sphere_scene(const HardSphereState& state) {
  EventScene scene;
  scene.period = Vec3::Constant(state.box_length);
  for (std::size_t k = 0; k < state.positions.size(); ++k) {
    scene.balls.push_back({state.positions[k], state.velocities[k], 0.5 * state.diameter, 1.0});
  }
  return scene;
}

}  // namespace plumbline
