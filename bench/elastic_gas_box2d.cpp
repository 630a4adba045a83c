// Box2D 2.4: dynamic tree, 8 velocity and 3 position sweeps; sleeping off, e = 1 at every speed.
#include <box2d/box2d.h>

#include <vector>

#include "elastic_gas_peer.hpp"

namespace plumbline::bench {
namespace {

b2Vec2 in_plane(const Vec3& v) { return {static_cast<float>(v.x()), static_cast<float>(v.y())}; }
Vec3 vec3(const b2Vec2& v) { return {double{v.x}, double{v.y}, 0}; }

class Box2dGas final : public GasWorld {
 public:
  explicit Box2dGas(const SphereBoxScene& scene) : world_(b2Vec2(0, 0)) {
    world_.SetAllowSleeping(false);
    const Vec3 low = scene.lower_W, high = scene.upper_W;
    const Vec3 corners[] = {low, Vec3(high.x(), low.y(), 0), high, Vec3(low.x(), high.y(), 0)};
    b2FixtureDef fixture;
    fixture.restitution = 1;
    fixture.restitutionThreshold = 0;
    fixture.friction = 0;
    fixture.density = 1;
    b2BodyDef def;
    b2Body* walls = world_.CreateBody(&def);
    for (int k = 0; k < 4; ++k) {
      b2EdgeShape edge;
      edge.SetTwoSided(in_plane(corners[k]), in_plane(corners[(k + 1) % 4]));
      fixture.shape = &edge;
      walls->CreateFixture(&fixture);
    }
    def.type = b2_dynamicBody;
    for (const SteppedSphere& s : scene.spheres) {
      def.position = in_plane(s.p_W);
      def.linearVelocity = in_plane(s.v_W);
      b2CircleShape circle;
      circle.m_radius = static_cast<float>(s.radius);
      fixture.shape = &circle;
      bodies_.push_back(world_.CreateBody(&def));
      bodies_.back()->CreateFixture(&fixture);
    }
  }

  void step(double dt) override { world_.Step(static_cast<float>(dt), 8, 3); }
  void read(std::span<SteppedSphere> spheres) const override {
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      spheres[i].p_W = vec3(bodies_[i]->GetPosition());
      spheres[i].v_W = vec3(bodies_[i]->GetLinearVelocity());
    }
  }

 private:
  b2World world_;
  std::vector<b2Body*> bodies_;
};

}  // namespace

std::unique_ptr<GasWorld> make_box2d_gas(const SphereBoxScene& scene) { return std::make_unique<Box2dGas>(scene); }

}  // namespace plumbline::bench
