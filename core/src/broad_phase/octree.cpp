// A loose octree (Ulrich, Loose Octrees, in Game Programming Gems, 2000).
//
// The root is a cube around all centres; a cube with many boxes is cut into eight. A box goes down into the child that
// holds its centre as long as its longest edge is at most the child's; so it never has to choose between two children,
// it may stick out of its cube by half an edge, and large boxes stay high up. What a subtree really covers is written
// into its node: the box around all that is in it.
//
// Pairs: those within a node, those of a node's own boxes with all below it, and those of two nodes side by side. A
// pair of subtrees whose boxes are apart is left out at once.
#include <algorithm>
#include <array>

#include "plumbline/core/broad_phase/broad_phase.hpp"

namespace plumbline {
namespace {

constexpr std::uint32_t kLeafSize = 8;  // fewer are compared with each other faster than they are divided
constexpr int kMaxDepth = 48;           // boxes without size at one place would be divided for ever

class Octree final : public BroadPhase {
 public:
  std::string_view name() const override { return "octree"; }

 private:
  struct Entry {
    Aabb box;
    std::uint32_t body;
  };

  // The entries of a subtree are neighbours: first the node's own ones, then child after child.
  struct Node {
    Aabb bounds;
    std::uint32_t begin, own_end;
    std::array<std::uint32_t, 8> children;
    std::uint32_t child_count = 0;
  };

  struct Cube {
    Vec3 min;
    double edge;
  };

  void find(std::span<const Aabb> boxes, std::vector<BodyPair>& pairs) override {
    if (boxes.empty()) return;
    entries_.resize(boxes.size());
    sorted_.resize(boxes.size());
    nodes_.clear();
    Aabb centres{centre(boxes[0]), centre(boxes[0])};
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      entries_[i] = {boxes[i], i};
      const Vec3 c = centre(boxes[i]);
      centres = merged(centres, {c, c});
    }
    const double edge = (centres.max - centres.min).maxCoeff();
    pairs_ = &pairs;
    within(build(0, static_cast<std::uint32_t>(boxes.size()), {centres.min, edge}, 0));
  }

  std::uint32_t build(std::uint32_t begin, std::uint32_t end, const Cube& cube, int depth) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({entries_[begin].box, begin, end, {}});
    for (std::uint32_t k = begin; k < end; ++k) nodes_[index].bounds = merged(nodes_[index].bounds, entries_[k].box);
    if (end - begin <= kLeafSize || depth == kMaxDepth) return index;

    // Counting sort into nine bins: 0 for what stays, 1 to 8 for the children.
    const double edge = 0.5 * cube.edge;
    const Vec3 middle = cube.min.array() + edge;
    std::array<std::uint32_t, 10> starts{};
    for (std::uint32_t k = begin; k < end; ++k) ++starts[bin(entries_[k].box, middle, edge) + 1];
    starts[0] = begin;
    for (std::size_t b = 1; b < starts.size(); ++b) starts[b] += starts[b - 1];
    auto next = starts;
    for (std::uint32_t k = begin; k < end; ++k) sorted_[next[bin(entries_[k].box, middle, edge)]++] = entries_[k];
    std::copy(sorted_.begin() + begin, sorted_.begin() + end, entries_.begin() + begin);

    nodes_[index].own_end = starts[1];
    for (std::uint32_t c = 0; c < 8; ++c) {
      if (starts[c + 1] == starts[c + 2]) continue;
      const Vec3 upper((c & 1) != 0 ? edge : 0, (c & 2) != 0 ? edge : 0, (c & 4) != 0 ? edge : 0);
      const std::uint32_t child = build(starts[c + 1], starts[c + 2], {cube.min + upper, edge}, depth + 1);
      Node& node = nodes_[index];  // only now: building the child may have moved the nodes
      node.children[node.child_count++] = child;
    }
    return index;
  }

  static std::size_t bin(const Aabb& box, const Vec3& middle, double edge) {
    if ((box.max - box.min).maxCoeff() > edge) return 0;
    const Vec3 c = centre(box);
    return 1u + (c.x() >= middle.x() ? 1u : 0u) + (c.y() >= middle.y() ? 2u : 0u) + (c.z() >= middle.z() ? 4u : 0u);
  }

  // All pairs of one subtree.
  void within(std::uint32_t index) {
    const Node& node = nodes_[index];
    for (std::uint32_t a = node.begin; a < node.own_end; ++a) {
      for (std::uint32_t b = a + 1; b < node.own_end; ++b) test(entries_[a], entries_[b]);
      for (std::uint32_t c = 0; c < node.child_count; ++c) against(entries_[a], node.children[c]);
    }
    for (std::uint32_t c = 0; c < node.child_count; ++c) {
      within(node.children[c]);
      for (std::uint32_t d = c + 1; d < node.child_count; ++d) between(node.children[c], node.children[d]);
    }
  }

  // All pairs of a box outside a subtree with those inside.
  void against(const Entry& entry, std::uint32_t index) {
    const Node& node = nodes_[index];
    if (!overlap(entry.box, node.bounds)) return;
    for (std::uint32_t k = node.begin; k < node.own_end; ++k) test(entry, entries_[k]);
    for (std::uint32_t c = 0; c < node.child_count; ++c) against(entry, node.children[c]);
  }

  // All pairs of one subtree with another.
  void between(std::uint32_t one, std::uint32_t other) {
    const Node &a = nodes_[one], &b = nodes_[other];
    if (!overlap(a.bounds, b.bounds)) return;
    for (std::uint32_t k = a.begin; k < a.own_end; ++k) against(entries_[k], other);
    for (std::uint32_t c = 0; c < a.child_count; ++c) {
      for (std::uint32_t k = b.begin; k < b.own_end; ++k) against(entries_[k], a.children[c]);
      for (std::uint32_t d = 0; d < b.child_count; ++d) between(a.children[c], b.children[d]);
    }
  }

  void test(const Entry& a, const Entry& b) {
    if (overlap(a.box, b.box)) pairs_->push_back(ordered(a.body, b.body));
  }

  std::vector<Node> nodes_;
  std::vector<Entry> entries_, sorted_;
  std::vector<BodyPair>* pairs_ = nullptr;  // of the call in progress
};

}  // namespace

std::unique_ptr<BroadPhase> make_octree() { return std::make_unique<Octree>(); }

}  // namespace plumbline
