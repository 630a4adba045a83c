// What the outside sees of a gas, brought to the present and to the order of the constructor.
#include <algorithm>
#include <limits>

#include "hard_sphere_gas_machine.hpp"

namespace plumbline {

std::vector<Vec3> HardSphereGas::Machine::positions() const {
  std::vector<Vec3> result(size());
  for (Id id = 1; id <= last(); ++id) {
    GasSphere s = sphere(id);
    fly(s);
    for (int axis = 0; axis < 3; ++axis) {
      double p = s.p[axis] + (calendar_[id].cell.at[axis] + 0.5) * cells_.width(axis);
      // Between two events a sphere may stand a rounding outside of its cell, and so of the box.
      if (p < 0) p += box_[axis];
      if (p >= box_[axis]) p -= box_[axis];
      result[number(id)][axis] = p;
    }
  }
  return result;
}

std::vector<Vec3> HardSphereGas::Machine::velocities() const {
  std::vector<Vec3> result(size());
  for (Id id = 1; id <= last(); ++id) result[number(id)] = Vec3(sphere(id).v[0], sphere(id).v[1], sphere(id).v[2]);
  return result;
}

double HardSphereGas::Machine::velocity_square_sum() const {
  double sum = 0;
  for (const GasSphere& s : spheres_) sum += s.v[0] * s.v[0] + s.v[1] * s.v[1] + s.v[2] * s.v[2];
  return sum;
}

double HardSphereGas::Machine::smallest_gap() const {
  double smallest = std::numeric_limits<double>::infinity();
  GasCandidates near;
  for (Id a = 1; a <= last(); ++a) {
    const auto around = cells_.around(calendar_[a].cell);
    near.count = 0;
    for (int k = 0; k < kNeighbours; ++k) cells_.append(around, k, near);
    for (int k = 0; k < near.count; ++k) {
      if (near.id[k] != a) smallest = std::min(smallest, separation(a, near.id[k]).norm() / diameter_ - 1);
    }
  }
  return smallest;
}

// From a to b at this moment, the shortest way around the box.
Vec3 HardSphereGas::Machine::separation(Id a, Id b) const {
  GasSphere sa = sphere(a), sb = sphere(b);
  fly(sa);
  fly(sb);
  Vec3 r;
  for (int axis = 0; axis < 3; ++axis) {
    int cells = calendar_[b].cell.at[axis] - calendar_[a].cell.at[axis];
    if (2 * cells > cells_.count(axis)) cells -= cells_.count(axis);
    if (2 * cells < -cells_.count(axis)) cells += cells_.count(axis);
    r[axis] = sb.p[axis] + cells * cells_.width(axis) - sa.p[axis];
  }
  return r;
}

}  // namespace plumbline
