// A force at a point, its torque about any centre, and sums of them (course slides 3-4, 7 step 2b, 14).
//
//   M = r x F,   r from the centre of rotation to the point      right-hand rule: fingers from r to F, thumb along M
//
// A force and a torque together are a wrench; the same wrench about another centre has the torque
//
//   M' = M + (c - c') x F
//
// so sums are formed about one common centre, which need not be a centre of mass (slide 4). Source: Goldstein, section
// 1.2; Featherstone, Rigid Body Dynamics Algorithms, section 2.6. Exact but for rounding; NaN in, NaN out.
#pragma once

#include <span>

#include "plumbline/core/state.hpp"

namespace plumbline {

struct PointForce {
  Vec3 f_W = Vec3::Zero();  // [N]
  Vec3 p_W = Vec3::Zero();  // where it acts [m]
};

// M = (p - centre) x F [N m].
Vec3 torque_about(const Vec3& centre_W, const PointForce& force);

// The wrench of one force, and of many, about `centre_W`. About a body's centre of mass it is what acts on that body.
Wrench wrench_about(const Vec3& centre_W, const PointForce& force);
Wrench wrench_about(const Vec3& centre_W, std::span<const PointForce> forces);

// A wrench known about `from_W`, about `to_W`.
Wrench moved_wrench(const Wrench& wrench, const Vec3& from_W, const Vec3& to_W);

Wrench operator+(const Wrench& a, const Wrench& b);  // both about the same centre

}  // namespace plumbline
