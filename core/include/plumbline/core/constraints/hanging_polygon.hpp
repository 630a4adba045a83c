// The exact shape of a hanging chain or bridge of straight links between two points: the discrete catenary.
//
// At rest every joint is in balance: the horizontal pull H is the same in all links, and the vertical pull S grows by
// the weight at each joint. With S_0 in the first link and S_k = S_0 + (weight of the first k joints), T_k = sqrt(H^2 +
// S_k^2) is the tension of link k, and (H, S_k)/T_k its direction (horizontal, up). The chain has to end where it is
// fixed:
//
//   sum l_k H/T_k = X,    sum l_k S_k/T_k = Z.
//
// These two equations say that the convex function sum l_k T_k - H X - S_0 Z of (H, S_0) has its minimum there, so
// Newton's method with step halving always finds the one solution. (Multipliers of the complementary energy; Timoshenko
// and Young, Theory of Structures, 2nd ed., ch. 1, funicular polygon.) Accurate to rounding unless the chain is taut:
// then T, not the shape, becomes ill-conditioned.
#pragma once

#include <span>
#include <vector>

#include "plumbline/core/spatial.hpp"

namespace plumbline {

struct HangingPolygon {
  std::vector<Vec3> p_W;         // of all joints, both fixed ends included [m]
  std::vector<double> tensions;  // of each link [N]
};

// From `first_W` to `last_W` by links of those lengths [m], with a weight >= 0 [N] at each joint between; gravity along
// -z. Throws std::invalid_argument unless there is one weight fewer than links, some weight, lengths > 0 that together
// exceed the distance of the ends, and a horizontal distance between them (a chain that hangs straight down and up
// again has a fold, which is not covered); and for a link so long that it would have to push: if the chain reaches with
// the links before it hanging straight down, those after it straight up, and that one slack.
HangingPolygon hanging_polygon(const Vec3& first_W, const Vec3& last_W, std::span<const double> lengths,
                               std::span<const double> weights);

}  // namespace plumbline
