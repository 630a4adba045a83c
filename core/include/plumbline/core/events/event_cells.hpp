// A grid of cells that says who is near whom (course slide 17), for bodies that tell it when they cross a face.
//
// Cells are at least as wide as the largest diameter, so two spheres that touch are in the same cell or in neighbouring
// ones, and a body needs to look at 27 cells only. In which cell a body is, is a matter of record, not of its rounded
// position: it changes at a crossing and then by one.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "plumbline/core/spatial.hpp"

namespace plumbline {

class EventCells {
 public:
  static constexpr int kNobody = -1;

  EventCells() = default;
  // Covers the box from low to high [m] with cells of at least that width, at most about four for each body. In a
  // periodic box the faces low and high are the same; otherwise the outer cells reach to infinity. A periodic box must
  // hold three cells along each axis, or neighbours would be met twice: throws std::invalid_argument.
  EventCells(const Vec3& low, const Vec3& high, double least_width, int bodies, bool periodic);

  // Puts a body into the cell around p [m]. Once for each body, before anything else.
  void insert(int body, const Vec3& p);
  // Across a face of its cell, downwards or upwards along the axis. Returns how far p jumps [m]: an edge of the box if
  // the face was a side of a periodic one, else 0.
  double cross(int body, int axis, bool upwards);

  // The faces of the body's cell along the axis [m]; infinite at the edge of an open grid.
  double lower_face(int body, int axis) const { return face(axis, place(body)[axis]); }
  double upper_face(int body, int axis) const { return face(axis, place(body)[axis] + 1); }

  // Calls visit(j, shift) for every other body j in the 27 cells around the body; p_j + shift is its image that is
  // near.
  template <typename Visit>
  void visit_near(int body, const Visit& visit) const {
    const Eigen::Vector3i centre = place(body);
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          Eigen::Vector3i cell = centre + Eigen::Vector3i(x, y, z);
          Vec3 shift = Vec3::Zero();
          if (!wrap(cell, shift)) continue;
          for (int j = first_[index(cell)]; j != kNobody; j = next_[static_cast<std::size_t>(j)]) {
            if (j != body) visit(j, shift);
          }
        }
      }
    }
  }

  const Eigen::Vector3i& counts() const { return counts_; }  // cells along each axis

 private:
  const Eigen::Vector3i& place(int body) const { return places_[static_cast<std::size_t>(body)]; }
  std::size_t index(const Eigen::Vector3i& cell) const {
    return static_cast<std::size_t>((cell.z() * counts_.y() + cell.y()) * counts_.x() + cell.x());
  }
  double face(int axis, int k) const {
    if (!periodic_ && k <= 0) return -std::numeric_limits<double>::infinity();
    if (!periodic_ && k >= counts_[axis]) return std::numeric_limits<double>::infinity();
    return low_[axis] + k * width_[axis];
  }
  // Brings a cell just outside of a periodic grid back into it; false for one outside of an open grid.
  bool wrap(Eigen::Vector3i& cell, Vec3& shift) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (cell[axis] >= 0 && cell[axis] < counts_[axis]) continue;
      if (!periodic_) return false;
      const int turn = cell[axis] < 0 ? -1 : 1;
      cell[axis] -= turn * counts_[axis];
      shift[axis] = turn * edge_[axis];
    }
    return true;
  }
  void link(int body);
  void unlink(int body);

  Vec3 low_ = Vec3::Zero(), edge_ = Vec3::Zero(), width_ = Vec3::Zero();  // [m]
  Eigen::Vector3i counts_ = Eigen::Vector3i::Zero();
  bool periodic_ = false;
  std::vector<Eigen::Vector3i> places_;  // of each body
  std::vector<int> first_;               // of each cell: the head of its list of bodies
  std::vector<int> next_, previous_;     // of each body in that list
};

}  // namespace plumbline
