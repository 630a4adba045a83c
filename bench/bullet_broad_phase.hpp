// Bullet's dynamic bounding-volume tree as a peer of the broad-phase benchmark.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "plumbline/core/broad_phase/bounding_volume.hpp"

class btDbvtBroadphase;
struct btBroadphaseProxy;

namespace plumbline {

class BulletBroadPhase {
 public:
  // Creates a proxy for each box. Unless deferred, Bullet looks for its partners at once, otherwise in find().
  BulletBroadPhase(std::span<const Aabb> boxes, bool deferred);
  ~BulletBroadPhase();
  void move(std::span<const Aabb> boxes);
  std::size_t find();  // the number of overlapping pairs
  void clear();

 private:
  std::unique_ptr<btDbvtBroadphase> broad_phase_;
  std::vector<btBroadphaseProxy*> proxies_;
};

}  // namespace plumbline
