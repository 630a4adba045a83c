#include "plumbline/core/response/sphere_impact.hpp"

#include <cmath>
#include <stdexcept>

namespace plumbline {
namespace {

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

void check(const ImpactSphere& s) {
  require(s.radius > 0 && s.mass > 0 && s.moment > 0, "a sphere of an impact needs a radius, mass and moment > 0");
}

void check(const ContactMaterial& m) {
  require(m.restitution >= 0 && m.restitution <= 1, "restitution must lie in [0, 1]");
  require(m.friction >= 0, "friction must be >= 0");
}

// The impulse on the first body of a contact whose points have the relative velocity v.
SphereImpact impact(const Vec3& v, const Vec3& n, double reduced_mass, double mobility, const ContactMaterial& m) {
  const double v_n = n.dot(v);
  if (v_n >= 0) return {};
  const Vec3 v_t = v - v_n * n;
  const double slide = v_t.norm();
  const double along = -(1 + m.restitution) * reduced_mass * v_n;
  const bool grips = slide / mobility <= m.friction * along;
  const double across = grips ? slide / mobility : m.friction * along;

  SphereImpact result;
  result.regime = grips ? SphereImpact::Regime::kGrip : SphereImpact::Regime::kSlip;
  result.impulse_W = along * n;
  if (slide > 0) result.impulse_W -= across / slide * v_t;
  result.lost_along = 0.5 * (1 - m.restitution) * (1 + m.restitution) * reduced_mass * v_n * v_n;
  result.lost_across = across * (slide - 0.5 * mobility * across);
  return result;
}

// At the arm -side r n from the centre, side = +1 for the sphere that n points to and -1 for the other.
Vec3 surface_velocity(const ImpactSphere& s, const Vec3& n, double side) {
  return s.state.v_WB - side * s.radius * s.state.w_WB.cross(n);
}

// Linear impulse m dv = J, angular impulse I dw = r x J.
void receive(ImpactSphere& s, const Vec3& n, double side, const Vec3& impulse_W) {
  s.state.v_WB += side / s.mass * impulse_W;
  s.state.w_WB -= s.radius / s.moment * n.cross(impulse_W);  // (-side r n) x (side J): the same for both
}

}  // namespace

SphereImpact collide_spheres(ImpactSphere& first, ImpactSphere& second, const ContactMaterial& material) {
  check(first);
  check(second);
  check(material);
  const Vec3 line = first.state.p_WB - second.state.p_WB;
  require(line.norm() != 0, "spheres with the same centre have no line of contact; move one of them");
  const Vec3 n = line.normalized();
  const Vec3 v = surface_velocity(first, n, 1) - surface_velocity(second, n, -1);
  const double reduced_mass = first.mass * second.mass / (first.mass + second.mass);
  const double mobility = 1 / first.mass + 1 / second.mass + first.radius * first.radius / first.moment +
                          second.radius * second.radius / second.moment;
  const SphereImpact result = impact(v, n, reduced_mass, mobility, material);
  receive(first, n, 1, result.impulse_W);
  receive(second, n, -1, result.impulse_W);
  return result;
}

SphereImpact bounce_sphere(ImpactSphere& sphere, const Vec3& normal_W, const ContactMaterial& material) {
  check(sphere);
  check(material);
  const double mobility = 1 / sphere.mass + sphere.radius * sphere.radius / sphere.moment;
  const SphereImpact result = impact(surface_velocity(sphere, normal_W, 1), normal_W, sphere.mass, mobility, material);
  receive(sphere, normal_W, 1, result.impulse_W);
  return result;
}

}  // namespace plumbline
