// A BSP tree (Fuchs, Kedem and Naylor, On visible surface generation by a priori tree structures, SIGGRAPH 1980):
// planes in any direction. For walls one takes the planes of the walls; bodies have none, so here the plane stands
// across the direction in which their centres vary most (the principal axis of their covariance) and passes through
// their mean.
//
// What this buys over the kd-tree: bodies along a slope or a diagonal are cut across and not along. What it costs: a
// plane askew to the boxes cuts up to sqrt(3) times more of them. How the tree works: space_partition.hpp.
#include <Eigen/Eigenvalues>

#include "space_partition.hpp"

namespace plumbline {
namespace {

struct ObliquePlane {
  Vec3 normal;    // unit
  double offset;  // [m]

  // One order of evaluation for points and boxes alike: the promise of space_partition.hpp rests on it.
  double value(const Vec3& point) const {
    return normal.x() * point.x() + normal.y() * point.y() + normal.z() * point.z();
  }
  double low(const Aabb& box) const { return value((normal.array() > 0).select(box.min, box.max)); }
  double high(const Aabb& box) const { return value((normal.array() > 0).select(box.max, box.min)); }
};

class AcrossPrincipalAxis {
 public:
  ObliquePlane choose(std::span<const PartitionEntry> entries, int attempt) {
    if (attempt == 0) find_axes(entries);
    const Vec3 normal = axes_.col(2 - attempt);  // the eigenvalues come in increasing order
    return {normal, normal.dot(mean_)};
  }

 private:
  void find_axes(std::span<const PartitionEntry> entries) {
    const auto count = static_cast<double>(entries.size());
    mean_.setZero();
    for (const PartitionEntry& entry : entries) mean_ += centre(entry.box) / count;
    Mat3 covariance = Mat3::Zero();
    for (const PartitionEntry& entry : entries) {
      const Vec3 d = centre(entry.box) - mean_;
      covariance += d * d.transpose();
    }
    axes_ = Eigen::SelfAdjointEigenSolver<Mat3>().computeDirect(covariance).eigenvectors();
  }

  Vec3 mean_ = Vec3::Zero();
  Mat3 axes_ = Mat3::Identity();
};

class BspTree final : public SpacePartition<ObliquePlane, AcrossPrincipalAxis> {
 public:
  std::string_view name() const override { return "BSP tree"; }
};

}  // namespace

std::unique_ptr<BroadPhase> make_bsp_tree() { return std::make_unique<BspTree>(); }

}  // namespace plumbline
