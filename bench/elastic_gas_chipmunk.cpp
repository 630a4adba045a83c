// Chipmunk 7: spatial hash (faster here than its default, a tree of bounding boxes), 10 sweeps.
#include <chipmunk/chipmunk.h>

#include <vector>

#include "elastic_gas_peer.hpp"

namespace plumbline::bench {
namespace {

cpVect in_plane(const Vec3& v) { return {v.x(), v.y()}; }

class ChipmunkGas final : public GasWorld {
 public:
  explicit ChipmunkGas(const SphereBoxScene& scene) {
    const double radius = scene.spheres.front().radius;
    cpSpaceUseSpatialHash(space_, 2 * radius, static_cast<int>(10 * scene.spheres.size()));
    const Vec3 low = scene.lower_W, high = scene.upper_W;
    const Vec3 corners[] = {low, Vec3(high.x(), low.y(), 0), high, Vec3(low.x(), high.y(), 0)};
    for (int k = 0; k < 4; ++k) {
      add(cpSegmentShapeNew(cpSpaceGetStaticBody(space_), in_plane(corners[k]), in_plane(corners[(k + 1) % 4]), 0));
    }
    for (const SteppedSphere& s : scene.spheres) {
      cpBody* body = cpSpaceAddBody(space_, cpBodyNew(s.mass, cpMomentForCircle(s.mass, 0, s.radius, cpvzero)));
      cpBodySetPosition(body, in_plane(s.p_W));
      cpBodySetVelocity(body, in_plane(s.v_W));
      add(cpCircleShapeNew(body, s.radius, cpvzero));
      bodies_.push_back(body);
    }
  }
  ~ChipmunkGas() override {
    for (cpShape* shape : shapes_) {
      cpSpaceRemoveShape(space_, shape);
      cpShapeFree(shape);
    }
    for (cpBody* body : bodies_) {
      cpSpaceRemoveBody(space_, body);
      cpBodyFree(body);
    }
    cpSpaceFree(space_);
  }

  void step(double dt) override { cpSpaceStep(space_, dt); }
  void read(std::span<SteppedSphere> spheres) const override {
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      const cpVect p = cpBodyGetPosition(bodies_[i]), v = cpBodyGetVelocity(bodies_[i]);
      spheres[i].p_W = Vec3(p.x, p.y, 0);
      spheres[i].v_W = Vec3(v.x, v.y, 0);
    }
  }

 private:
  void add(cpShape* shape) {
    cpShapeSetElasticity(shape, 1);
    cpShapeSetFriction(shape, 0);
    shapes_.push_back(cpSpaceAddShape(space_, shape));
  }

  cpSpace* space_ = cpSpaceNew();
  std::vector<cpShape*> shapes_;
  std::vector<cpBody*> bodies_;
};

}  // namespace

std::unique_ptr<GasWorld> make_chipmunk_gas(const SphereBoxScene& scene) {
  return std::make_unique<ChipmunkGas>(scene);
}

}  // namespace plumbline::bench
