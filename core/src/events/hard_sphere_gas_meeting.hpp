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

  // Appends the spheres of a cell. Cells of none, one and two are nearly all there are, and whether a place is taken
  // is as good as random: so the first two are always copied and only the count depends on it, without a jump that
  // the processor would guess wrong half of the time.
  void append(const GasCells::Cell& cell, int which) {
    int n = count;  // not the member, which the compiler would write and read each time
    for (int slot = 0; slot < 2; ++slot) {
      id[n] = cell.id[slot];
      neighbour[n] = which;
      n += cell.id[slot] >= 0;
    }
    if (cell.id[2] >= 0) [[unlikely]] {
      for (int slot = 2; slot < GasCells::kCapacity && cell.id[slot] >= 0; ++slot) {
        id[n] = cell.id[slot];
        neighbour[n++] = which;
      }
    }
    count = n;
  }
};

// Fills near.time: the first time >= now at which the candidate and `me`, whose own clock shows `now`, are one
// diameter apart and approach each other. With the distance r and the relative velocity v at `now`:
//
//   |r + v s| = d   =>   s = (r^2 - d^2) / (-r.v + sqrt((r.v)^2 - v^2 (r^2 - d^2)))      for r.v < 0
//
// the root at which they approach, written so that nothing cancels (course slide 16). A pair that rounding has let
// overlap and that approaches meets now.
using FindMeetingTimes = void (*)(const GasSphere& me, double now, double diameter_square, const GasSphere* spheres,
                                  const GasCells::Shift* shifts, GasCandidates& near);

// How many candidates this processor can treat at once: 2, 4 (AVX2) or 8 (AVX-512).
int widest_lanes();
// The function for that many, all with the same results; not more than widest_lanes().
FindMeetingTimes meeting_times_by(int lanes);

}  // namespace plumbline
