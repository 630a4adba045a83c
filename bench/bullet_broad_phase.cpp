#include "bullet_broad_phase.hpp"

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>

namespace plumbline {
namespace {

btVector3 to_bullet(const Vec3& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

}  // namespace

BulletBroadPhase::BulletBroadPhase(std::span<const Aabb> boxes, bool deferred)
    : broad_phase_(std::make_unique<btDbvtBroadphase>()) {
  broad_phase_->m_deferedcollide = deferred;
  for (const Aabb& box : boxes) {
    proxies_.push_back(broad_phase_->createProxy(to_bullet(box.min), to_bullet(box.max), 0, nullptr, 1, 1, nullptr));
  }
}

BulletBroadPhase::~BulletBroadPhase() { clear(); }

void BulletBroadPhase::move(std::span<const Aabb> boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    broad_phase_->setAabb(proxies_[i], to_bullet(boxes[i].min), to_bullet(boxes[i].max), nullptr);
  }
}

std::size_t BulletBroadPhase::find() {
  broad_phase_->calculateOverlappingPairs(nullptr);
  return static_cast<std::size_t>(broad_phase_->getOverlappingPairCache()->getNumOverlappingPairs());
}

// destroyProxy() would go through all pairs for each proxy: what is left after the tree is only their memory.
void BulletBroadPhase::clear() {
  broad_phase_.reset();
  for (btBroadphaseProxy* proxy : proxies_) btAlignedFree(proxy);
  proxies_.clear();
}

}  // namespace plumbline
