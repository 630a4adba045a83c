// The spheres of a periodic box, sorted into cells: who can be near whom.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "hard_sphere_gas_pages.hpp"

namespace plumbline {

// One sphere, exactly one line of the processor's cache: whoever looks at a neighbour fetches this line and no other.
struct alignas(64) GasSphere {
  double p[3];  // position at `time`, from the middle of the own cell: never large, so never coarsely rounded
  double v[3];  // velocity
  double time;  // the own clock
  double meet;  // the time for which it is engaged: nobody who would meet it later need ask
};
static_assert(sizeof(GasSphere) == 64);

// The neighbours of one cell: itself and the 26 around it, x fastest.
inline constexpr int kNeighbours = 27;

// Coordinates of a cell.
struct GasCell {
  std::uint16_t at[3];
};

// The spheres in some of the cells around one.
struct GasCandidates {
  // Centres that keep a distance of one diameter: at most 13 fit into a cube with edges below sqrt(2) diameters, where
  // the 14 of a face-centred lattice would.
  static constexpr int kMost = kNeighbours * 13;
  static constexpr int kSpare = 2 * kNeighbours + 8;  // for what is written ahead, and the last group of eight
  int count = 0;
  std::int32_t id[kMost + kSpare];
  std::int32_t neighbour[kMost + kSpare];   // which of the 27 cells it is in
  alignas(64) double time[kMost + kSpare];  // of the meeting, infinity where there is none
};

class GasCells {
 public:
  static constexpr std::int32_t kNobody = 0;  // spheres are numbered from 1: what nobody's list holds is nobody

  // Cells that are as small as they may be: strictly wider than the diameter, so that touching spheres are always in
  // neighbouring cells, whatever rounding does. From 4 diameters on there are three cells or more, below sqrt(2)
  // diameters wide.
  GasCells(const double box[3], double diameter, std::size_t spheres) : next_(spheres + 1, kNobody) {
    std::size_t cells = 1;
    for (int axis = 0; axis < 3; ++axis) {
      double count = std::floor(box[axis] / diameter);
      if (box[axis] / count < diameter * (1 + 1e-9)) count -= 1;
      count_[axis] = static_cast<int>(count);
      width_[axis] = box[axis] / count;
      cells *= static_cast<std::size_t>(count_[axis]);
    }
    first_.assign(cells, kNobody);
    for (int k = 0; k < kNeighbours; ++k) {
      const int step[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
      for (int axis = 0; axis < 3; ++axis) {
        shifts_[static_cast<std::size_t>(k)].by[axis] = step[axis] * width_[axis];
      }
    }
  }

  void clear() { first_.assign(first_.size(), kNobody); }

  double width(int axis) const { return width_[axis]; }
  int count(int axis) const { return count_[axis]; }

  // From the middle of a cell to the middle of its k-th neighbour; as long as a sphere, to be added to one.
  struct alignas(64) Shift {
    double by[8];
  };
  const Shift* shifts() const { return shifts_.data(); }

  // The 27 cells around a cell. The box repeats: next to the last is the first.
  using Around = std::array<std::int32_t, kNeighbours>;
  Around around(const GasCell& cell) const {
    std::int32_t part[3][3];
    std::int32_t stride = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int32_t c = cell.at[axis], last = count_[axis] - 1;
      part[axis][0] = stride * (c == 0 ? last : c - 1);
      part[axis][1] = stride * c;
      part[axis][2] = stride * (c == last ? 0 : c + 1);
      stride *= count_[axis];
    }
    Around result;
    std::size_t k = 0;
    for (const std::int32_t z : part[2]) {
      for (const std::int32_t y : part[1]) {
        for (const std::int32_t x : part[0]) result[k++] = x + y + z;
      }
    }
    return result;
  }

  // Appends the spheres of the k-th cell around. Cells of none, one and two are nearly all there are, and which of them
  // it is is as good as random: so the first two places are always copied and only the count depends on what is in
  // them, without a jump that the processor would guess wrong half of the time.
  void append(const Around& around, int k, GasCandidates& near) const {
    int n = near.count;  // not the member, which the compiler would write and read each time
    std::int32_t id = first_[static_cast<std::size_t>(around[static_cast<std::size_t>(k)])];
    for (int place = 0; place < 2; ++place) {
      near.id[n] = id;
      near.neighbour[n] = k;
      n += id != kNobody;
      id = next_[static_cast<std::size_t>(id)];
    }
    for (; id != kNobody; id = next_[static_cast<std::size_t>(id)]) {
      if (n >= GasCandidates::kMost) throw std::invalid_argument("spheres overlap: move them apart");
      near.id[n] = id;
      near.neighbour[n++] = k;
    }
    near.count = n;
  }

  void insert(std::int32_t id, const GasCell& cell) {
    std::int32_t& first = first_[index(cell)];
    next_[static_cast<std::size_t>(id)] = first;
    first = id;
  }

  void remove(std::int32_t id, const GasCell& cell) {
    std::int32_t* link = &first_[index(cell)];
    while (*link != id) link = &next_[static_cast<std::size_t>(*link)];
    *link = next_[static_cast<std::size_t>(id)];
  }

 private:
  std::size_t index(const GasCell& cell) const {
    return static_cast<std::size_t>(cell.at[0] + count_[0] * (cell.at[1] + count_[1] * cell.at[2]));
  }

  int count_[3] = {};
  double width_[3] = {};
  std::array<Shift, kNeighbours> shifts_ = {};
  // Lists of four bytes a cell and four a sphere, apart from the spheres: so small that they stay near the processor.
  PagedVector<std::int32_t> first_, next_;
};

}  // namespace plumbline
