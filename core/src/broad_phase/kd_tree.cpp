// A kd-tree (Bentley, Multidimensional binary search trees used for associative searching, CACM 18, 1975): planes
// across the axes of the world, each through the median of the centres, so that half of the boxes are on either side.
// First tried is the axis along which the centres reach furthest, then the next. How the tree works:
// space_partition.hpp.
#include <array>

#include "space_partition.hpp"

namespace plumbline {
namespace {

struct AxisPlane {
  int axis;
  double offset;  // [m]
  double value(const Vec3& point) const { return point[axis]; }
  double low(const Aabb& box) const { return box.min[axis]; }
  double high(const Aabb& box) const { return box.max[axis]; }
};

class MedianAlongAxis {
 public:
  AxisPlane choose(std::span<const PartitionEntry> entries, int attempt) {
    if (attempt == 0) sort_axes(entries);
    const int axis = axes_[static_cast<std::size_t>(attempt)];
    values_.clear();
    for (const PartitionEntry& entry : entries) values_.push_back(centre(entry.box)[axis]);
    const auto middle = values_.begin() + static_cast<std::ptrdiff_t>(values_.size() / 2);
    std::nth_element(values_.begin(), middle, values_.end());
    return {axis, *middle};
  }

 private:
  void sort_axes(std::span<const PartitionEntry> entries) {
    Aabb centres{centre(entries[0].box), centre(entries[0].box)};
    for (const PartitionEntry& entry : entries) centres = merged(centres, {centre(entry.box), centre(entry.box)});
    const Vec3 spread = centres.max - centres.min;
    axes_ = {0, 1, 2};
    std::sort(axes_.begin(), axes_.end(), [&](int a, int b) { return spread[a] > spread[b]; });
  }

  std::array<int, 3> axes_{};
  std::vector<double> values_;
};

class KdTree final : public SpacePartition<AxisPlane, MedianAlongAxis> {
 public:
  std::string_view name() const override { return "kd-tree"; }
};

}  // namespace

std::unique_ptr<BroadPhase> make_kd_tree() { return std::make_unique<KdTree>(); }

}  // namespace plumbline
