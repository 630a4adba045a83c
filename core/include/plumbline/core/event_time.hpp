// When did it happen? Times of impacts read out of a sampled trajectory.
#pragma once

#include <optional>
#include <vector>

#include "plumbline/core/metric.hpp"

namespace plumbline {

// For each event of the scenario, in order, the time [s] at which the trajectory shows it, or nothing.
//
// An impact is a jump of the two bodies' relative velocity along the direction in which the reference jumps. A jump
// counts when it is at least a quarter of the reference's; smaller consecutive jumps around it (an engine that
// brakes over several steps) belong to the same event. The time is where the flight before the jump and the
// motion after it, extended with the reference's accelerations before and after it, meet: it is not rounded to the
// sampling.
// Events of one pair are matched in order, each after the one before.
std::vector<std::optional<double>> event_times(const Comparison& comparison);

}  // namespace plumbline
