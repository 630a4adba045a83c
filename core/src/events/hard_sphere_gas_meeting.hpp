// When does one sphere meet each of its neighbours? The innermost loop of the gas.
#pragma once

#include <cstdint>

#include "hard_sphere_gas_cells.hpp"

namespace plumbline {

// Fills near.time: the first time >= now at which the candidate and `me`, whose own clock shows `now`, are one
// diameter apart and approach each other. With the distance r and the relative velocity v at `now`:
//
//   |r + v s| = d   =>   s = (r^2 - d^2) / (-r.v + sqrt((r.v)^2 - v^2 (r^2 - d^2)))      for r.v < 0
//
// the root at which they approach, written so that nothing cancels (course slide 16). A pair that rounding has let
// overlap and that approaches meets now. Only times before the candidate's own `meet` count: who is engaged before is
// not to be had.
using FindMeetingTimes = void (*)(const GasSphere& me, double now, double diameter_square, const GasSphere* spheres,
                                  const GasCells::Shift* shifts, GasCandidates& near);

// How many candidates this processor can treat at once: 2, 4 (AVX2) or 8 (AVX-512).
int widest_lanes();
// The function for that many, all with the same results; not more than widest_lanes().
FindMeetingTimes meeting_times_by(int lanes);

}  // namespace plumbline
