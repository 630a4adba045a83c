// The spheres of a periodic box, sorted into cells: who can be near whom.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "hard_sphere_gas_pages.hpp"

namespace plumbline {

// One sphere, exactly one line of the processor's cache: whoever looks at a neighbour fetches it once.
struct alignas(64) GasSphere {
  double p[3];            // position at `time`, from the middle of the own cell: never large, so never coarsely rounded
  double v[3];            // velocity
  double time;            // the own clock
  std::uint16_t cell[3];  // coordinates of the cell
  std::uint16_t slot;     // place within the cell
};
static_assert(sizeof(GasSphere) == 64);

// The neighbours of one cell: itself and the 26 around it, x fastest.
inline constexpr int kNeighbours = 27;

class GasCells {
 public:
  // Eight centres that keep a distance of one diameter fit into a cube with edges below 2/sqrt(3) = 1.1547 diameters,
  // nine do not (Schaer, Canad. Math. Bull. 9 (1966) 265), so a cell never overflows. No place is kept for a count:
  // the list ends at the first kNobody.
  static constexpr int kCapacity = 8;
  static constexpr std::int32_t kNobody = -1;
  struct alignas(32) Cell {
    std::int32_t id[kCapacity];
  };

  // Cells that are as small as they may be: strictly wider than the diameter, so that touching spheres are always in
  // neighbouring cells, whatever rounding does. From 8 diameters on that is below 8/7 diameters.
  GasCells(const double box[3], double diameter) {
    for (int axis = 0; axis < 3; ++axis) {
      double count = std::floor(box[axis] / diameter);
      if (box[axis] / count < diameter * (1 + 1e-9)) count -= 1;
      count_[axis] = static_cast<int>(count);
      width_[axis] = box[axis] / count;
    }
    cells_.resize(static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) *
                  static_cast<std::size_t>(count_[2]));
    clear();
    for (int k = 0; k < kNeighbours; ++k) {
      const int step[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
      for (int axis = 0; axis < 3; ++axis) {
        shift_[static_cast<std::size_t>(k)].by[axis] = step[axis] * width_[axis];
      }
    }
  }

  void clear() {
    for (Cell& cell : cells_) {
      for (std::int32_t& id : cell.id) id = kNobody;
    }
  }

  double width(int axis) const { return width_[axis]; }
  int count(int axis) const { return count_[axis]; }
  // From the middle of a cell to the middle of its k-th neighbour.
  struct alignas(64) Shift {
    double by[8];  // x, y, z and zeros
  };
  const Shift* shifts() const { return shift_.data(); }

  const Cell& operator[](std::int32_t cell) const { return cells_[static_cast<std::size_t>(cell)]; }
  std::int32_t index(const std::uint16_t cell[3]) const {
    return cell[0] + count_[0] * (cell[1] + count_[1] * cell[2]);
  }

  // The 27 cells around a cell. The box repeats: next to the last is the first.
  std::array<std::int32_t, kNeighbours> around(const std::uint16_t cell[3]) const {
    std::int32_t part[3][3];
    std::int32_t stride = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int32_t c = cell[axis], last = count_[axis] - 1;
      part[axis][0] = stride * (c == 0 ? last : c - 1);
      part[axis][1] = stride * c;
      part[axis][2] = stride * (c == last ? 0 : c + 1);
      stride *= count_[axis];
    }
    std::array<std::int32_t, kNeighbours> result;
    std::size_t k = 0;
    for (const std::int32_t z : part[2]) {
      for (const std::int32_t y : part[1]) {
        for (const std::int32_t x : part[0]) result[k++] = x + y + z;
      }
    }
    return result;
  }

  // False where the cell is full, which only overlapping spheres can bring about.
  bool insert(std::int32_t id, GasSphere& sphere) {
    std::int32_t* ids = cells_[static_cast<std::size_t>(index(sphere.cell))].id;
    for (std::uint16_t slot = 0; slot < kCapacity; ++slot) {
      if (ids[slot] != kNobody) continue;
      ids[slot] = id;
      sphere.slot = slot;
      return true;
    }
    return false;
  }

  // The last of the list takes the place that becomes free.
  void remove(const GasSphere& sphere, GasSphere* spheres) {
    std::int32_t* ids = cells_[static_cast<std::size_t>(index(sphere.cell))].id;
    int last = sphere.slot;
    while (last + 1 < kCapacity && ids[last + 1] != kNobody) ++last;
    if (last != sphere.slot) {
      ids[sphere.slot] = ids[last];
      spheres[ids[last]].slot = sphere.slot;
    }
    ids[last] = kNobody;
  }

 private:
  int count_[3] = {};
  double width_[3] = {};
  std::array<Shift, kNeighbours> shift_ = {};
  PagedVector<Cell> cells_;
};

}  // namespace plumbline
