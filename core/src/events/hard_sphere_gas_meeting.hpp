// When does one sphere meet each of its neighbours? The innermost loop of the gas.
#pragma once

#include <cstdint>

#include "hard_sphere_gas_cells.hpp"

namespace plumbline {

// The spheres in some of the cells around one.
struct GasCandidates {
  static constexpr int kMost = kNeighbours * GasCells::kCapacity;
  int count = 0;
  std::int32_t id[kMost + GasCells::kCapacity];
  std::int32_t neighbour[kMost + GasCells::kCapacity];   // which of the 27 cells it is in
  alignas(64) double time[kMost + GasCells::kCapacity];  // of the collision, infinity where there is none

  // Appends the spheres of a cell. Cells of one and two are nearly all there are, and whether a place is taken is as
  // good as random: so the first two are always copied and only the count depends on it, without a jump that the
  // processor would guess wrong half of the time.
  void append(const GasCells::Cell& cell, int which) {
    for (int slot = 0; slot < 2; ++slot) {
      id[count] = cell.id[slot];
      neighbour[count] = which;
      count += cell.id[slot] >= 0;
    }
    for (int slot = 2; slot < GasCells::kCapacity && cell.id[slot] >= 0; ++slot) {
      id[count] = cell.id[slot];
      neighbour[count++] = which;
    }
  }
};

// Fills near.time: the first time >= now at which the candidate and `me`, whose own clock shows `now`, are one
// diameter apart and approach each other. With the distance r and the relative velocity v at `now`:
//
//   |r + v s| = d   =>   s = (r^2 - d^2) / (-r.v + sqrt((r.v)^2 - v^2 (r^2 - d^2)))      for r.v < 0
//
// the root at which they approach, written so that nothing cancels (course slide 16). A pair that rounding has let
// overlap and that approaches meets now.
void find_meeting_times(const GasSphere& me, double now, double diameter_square, const GasSphere* spheres,
                        const GasCells::Shift* shifts, GasCandidates& near);

}  // namespace plumbline
