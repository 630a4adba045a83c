// Random poses and trees, and a few known mechanisms, for the tests of the joints.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "plumbline/core/joints/joint.hpp"

namespace plumbline::jointed {

inline constexpr double kEps = 2.220446049250313e-16;

// The same numbers on every platform: std's distributions differ between libraries.
class Random {
 public:
  explicit Random(unsigned long long seed) : engine_(seed) {}
  double in(double low, double high) { return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(in(0, static_cast<double>(n))); }
  Vec3 vector(double size) { return {in(-size, size), in(-size, size), in(-size, size)}; }
  Quat attitude() { return rotation_by(vector(3)); }

 private:
  std::mt19937_64 engine_;
};

inline BodyInertia random_inertia(Random& random) {
  // Moments that obey the triangle inequality: sums of the second moments of a body.
  const Vec3 second(random.in(0.02, 0.2), random.in(0.02, 0.2), random.in(0.02, 0.2));
  const Mat3 R = random.attitude().toRotationMatrix();
  const Vec3 moments(second.y() + second.z(), second.z() + second.x(), second.x() + second.y());
  return {random.in(0.5, 2), R * moments.asDiagonal() * R.transpose()};
}

inline JointFrame random_frame(Random& random) { return {random.vector(0.5), random.attitude()}; }

// Hinges and sliders, and one fixed joint in five, each on the world or an earlier body.
inline ArticulatedBody random_tree(Random& random, std::size_t bodies) {
  ArticulatedBody tree;
  tree.gravity_W = random.vector(9);
  for (std::size_t k = 0; k < bodies; ++k) {
    tree.bodies.push_back(random_inertia(random));
    const std::size_t draw = random.below(5);
    const JointKind kind = draw < 3 ? JointKind::kHinge : draw == 3 || k == 0 ? JointKind::kSlider : JointKind::kFixed;
    const std::size_t parent = random.below(k + 1);
    tree.joints.push_back(
        {kind, parent == k ? kWorld : parent, k, random_frame(random), random_frame(random), std::nullopt, 0, {}});
  }
  return tree;
}

// A planar chain that hangs from the origin along -z and swings about y; the angles of its hinges are relative. Body k
// has its centre of mass d[k] below its upper hinge, and the next hinge at l[k].
inline ArticulatedBody planar_chain(const std::vector<double>& m, const std::vector<double>& d,
                                    const std::vector<double>& l, const std::vector<double>& inertia, double g = 9.81) {
  ArticulatedBody chain;
  chain.gravity_W = Vec3(0, 0, -g);
  // z of the frames along -y of the bodies: positive angles swing towards +x.
  for (std::size_t k = 0; k < m.size(); ++k) {
    chain.bodies.push_back({m[k], inertia[k] * Mat3::Identity()});
    const Vec3 on_parent = k == 0 ? Vec3::Zero() : Vec3(0, 0, d[k - 1] - l[k - 1]);
    chain.joints.push_back({JointKind::kHinge,
                            k == 0 ? kWorld : k - 1,
                            k,
                            frame_along(on_parent, -Vec3::UnitY()),
                            frame_along(Vec3(0, 0, d[k]), -Vec3::UnitY()),
                            std::nullopt,
                            0,
                            {}});
  }
  return chain;
}

// n point masses of 1 kg on rods of 1 m: for reduced coordinates only, since it has no moments of inertia.
inline ArticulatedBody point_chain(std::size_t n, double g = 9.81) {
  return planar_chain(std::vector<double>(n, 1), std::vector<double>(n, 1), std::vector<double>(n, 1),
                      std::vector<double>(n, 0), g);
}

// Two real bodies that move exactly as two point masses of 1 kg on rods of 1 m. The plane double pendulum knows its
// bodies only through I1 + m1 d1^2 + m2 l1^2 = 2, I2 + m2 d2^2 = 1, m2 d2 l1 = 1, m1 d1 + m2 l1 = 2, m2 d2 = 1.
inline ArticulatedBody equimomental_double_pendulum(double g = 9.81) {
  return planar_chain({1, 1.5}, {0.5, 2.0 / 3}, {1, 1}, {0.25, 1.0 / 3}, g);
}

}  // namespace plumbline::jointed
