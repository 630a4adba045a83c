// Vectors, matrices and rotations: the alphabet of every other header.
//
// Conventions (docs/conventions.md): SI units, world frame W right-handed with z up, quaternions unit and
// written w x y z wherever a person or a file sees them.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace plumbline {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

// Not over-aligned, so that a BodyState is exactly 13 contiguous doubles and a trajectory one plain block.
using Quat = Eigen::Quaternion<double, Eigen::DontAlign>;

// Angle [rad] in [0, pi] of the rotation that carries attitude `a` into attitude `b` (the geodesic distance on SO(3)).
// q and -q are the same attitude. Evaluated as 2 atan2(|vec|, |w|), which keeps full relative accuracy for
// small angles, where the textbook 2 acos|<a,b>| loses half of the digits. NaN in, NaN out.
double geodesic_angle(const Quat& a, const Quat& b);

// The rotation exp([phi]x) by the vector phi [rad]. Exact for every length; phi = 0 gives the identity.
Quat rotation_by(const Vec3& phi);

// The matrix [r]x of the cross product: [r]x v = r x v.
Mat3 cross_matrix(const Vec3& r);

}  // namespace plumbline
